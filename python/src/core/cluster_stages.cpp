// SPDX-License-Identifier: BSD-3-Clause
// Clusters of samples by their attributes, and projections that keep them apart.
#include "core/bindings.h"
#include "core/run_stage.h"
#include "pipeline/membership_surface.h"
#include <pcl_uvol/multivariate/cluster_membership.h>
#include <pcl_uvol/multivariate/density_clustering.h>
#include <pcl_uvol/multivariate/star_coordinates.h>

#include <array>
#include <pybind11/stl.h>
#include <string>
#include <vector>

namespace pcl_uvol::python {

namespace py = pybind11;

namespace {

py::dict
describeTree(const std::vector<ClusterNode>& tree)
{
  std::vector<std::int32_t> parents, labels;
  std::vector<double> births, deaths, stabilities;
  std::vector<std::uint32_t> sizes;
  for (const ClusterNode& node : tree) {
    parents.push_back(node.parent);
    labels.push_back(node.label);
    births.push_back(node.birth_density);
    deaths.push_back(node.death_density);
    stabilities.push_back(node.stability);
    sizes.push_back(node.size);
  }
  const auto count = static_cast<py::ssize_t>(tree.size());
  py::dict dict;
  dict["parent"] = toArray(std::move(parents), {count});
  dict["birth_density"] = toArray(std::move(births), {count});
  dict["death_density"] = toArray(std::move(deaths), {count});
  dict["size"] = toArray(std::move(sizes), {count});
  dict["stability"] = toArray(std::move(stabilities), {count});
  dict["label"] = toArray(std::move(labels), {count});
  return dict;
}

/** \return labels, probabilities, the tree, a copy of the points with the first two as
 * fields, and the report */
py::tuple
findClusters(const DatasetPtr& dataset,
             const std::string& parameters,
             unsigned threads,
             const py::object& progress)
{
  DensityClustering<Cloud> clustering;
  std::vector<int> labels;
  auto labelled = std::make_shared<Dataset>(*dataset);
  const py::dict report =
      runStage(clustering, dataset, parameters, threads, progress, [&] {
        clustering.compute(labels);
        setField(*labelled, "label", labels);
        setField(*labelled, "probability", clustering.getProbabilities());
      });
  const auto count = static_cast<py::ssize_t>(labels.size());
  return py::make_tuple(
      toArray(std::move(labels), {count}),
      toArray(std::vector<float>(clustering.getProbabilities()), {count}),
      describeTree(clustering.getTree()),
      labelled,
      report);
}

/** \param labels one per point; none: clusters are found */
py::tuple
projectPoints(const DatasetPtr& dataset,
              const Numbers& labels,
              const std::string& parameters,
              unsigned threads,
              const py::object& progress)
{
  StarCoordinates<Cloud> star;
  star.setLabels(toWholeNumbers(labels));
  pcl::PointCloud<pcl::PointXYZ> points;
  const py::dict report = runStage(
      star, dataset, parameters, threads, progress, [&] { star.compute(points); });
  const ProjectedPoints& found = star.getResult();
  std::vector<float> places;
  for (const auto& place : found.places)
    places.insert(places.end(), place.begin(), place.end());
  const auto count = static_cast<py::ssize_t>(found.places.size());
  py::dict projection;
  projection["names"] = found.projection.names;
  projection["mean"] = found.projection.mean;
  projection["offsets"] = found.projection.offsets;
  projection["units"] = found.projection.units;
  projection["rows"] = found.projection.rows;
  projection["smallest_ratio"] = found.smallest_ratio;
  return py::make_tuple(toArray(std::move(places), {count, 3}),
                        toArray(std::vector<int>(found.sources), {count}),
                        toArray(std::vector<int>(found.labels), {count}),
                        projection,
                        report);
}

/** The surface between the samples of a cluster and the others.
 * \param numbers of the clusters, one per point
 * \param parameters JSON of MembershipParameters */
py::tuple
separateCluster(const DatasetPtr& dataset,
                const Numbers& numbers,
                const std::array<float, 3>& scale,
                const std::array<double, 3>& rotation,
                const std::string& parameters,
                unsigned threads,
                const py::object& progress)
{
  ClusterMembership<Cloud> membership;
  membership.setLabels(toWholeNumbers(numbers));
  Dataset surface;
  Report report;
  const auto extract = [&] {
    std::vector<float> members;
    membership.compute(members);
    report = membership.getReport();
    surface = extractMembershipSurface(
        *dataset,
        members,
        {Eigen::Array3f(scale.data()), Eigen::Array3d(rotation.data())},
        !membership.getParameters().smoothing_length.empty(),
        threads,
        report);
  };
  const py::dict of_membership =
      runStage(membership, dataset, parameters, threads, progress, extract);
  py::dict entries = toDict(report);
  entries["parameters"] = of_membership["parameters"];
  return py::make_tuple(share(std::move(surface)), entries);
}

} // namespace

void
bindClusterStages(py::module_& module)
{
  module.def("find_clusters", &findClusters);
  module.def("project_points", &projectPoints);
  module.def("separate_cluster", &separateCluster);
}

} // namespace pcl_uvol::python
