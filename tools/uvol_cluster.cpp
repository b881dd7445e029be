// SPDX-License-Identifier: BSD-3-Clause
// Clusters of samples by their attributes, and surfaces around them (thesis 2.6).
#include "common/scalar_field.h"
#include "io/table_file.h"
#include "pipeline/membership_surface.h"
#include "shared/point_files.h"
#include "shared/progress_bar.h"
#include "uvol_cluster/cluster_options.h"
#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/io/dataset.h>
#include <pcl_uvol/isosurface/isosurface_extraction.h>
#include <pcl_uvol/multivariate/cluster_membership.h>
#include <pcl_uvol/multivariate/density_clustering.h>
#include <pcl_uvol/vtk/cluster_surface.h>

#include <vtkLogger.h>

#include <algorithm>
#include <map>
#include <sstream>

namespace {

using pcl_uvol::Dataset;
using pcl_uvol::Report;
using uvol_tools::Fact;
using uvol_tools::Facts;
using uvol_tools::Options;
using uvol_tools::UsageError;

using Arguments = uvol_tools::ClusterOptions;

void
writeTree(const std::string& path, const std::vector<pcl_uvol::ClusterNode>& tree)
{
  std::ostringstream table;
  table << "node,parent,birth_density,death_density,size,stability,label\n";
  for (std::size_t i = 0; i < tree.size(); ++i)
    table << i << ',' << tree[i].parent << ',' << tree[i].birth_density << ','
          << tree[i].death_density << ',' << tree[i].size << ',' << tree[i].stability
          << ',' << tree[i].label << '\n';
  pcl_uvol::saveTable(path, table.str());
}

/** Finds clusters and adds the fields label and probability.
 * \param tree set */
std::vector<std::int32_t>
findClusters(const Options& options,
             const Arguments& arguments,
             Dataset& dataset,
             std::vector<pcl_uvol::ClusterNode>& tree,
             Report& report)
{
  pcl_uvol::ClusteringParameters parameters;
  parameters.neighbors = arguments.k;
  parameters.min_cluster_size = arguments.min_size;
  parameters.allow_single_cluster = arguments.single;
  parameters.cut_distance = arguments.cut;
  auto found = arguments.attributes.cluster(options, dataset, parameters, report);
  pcl_uvol::setField(dataset, "label", found.labels);
  pcl_uvol::setField(dataset, "probability", found.probabilities);
  tree = std::move(found.tree);
  return found.labels;
}

std::vector<std::int32_t>
findLabels(const Options& options,
           const Arguments& arguments,
           Dataset& dataset,
           std::vector<pcl_uvol::ClusterNode>& tree,
           Report& report)
{
  if (arguments.attributes.areGiven())
    return findClusters(options, arguments, dataset, tree, report);
  const pcl_uvol::CloudView cloud = pcl_uvol::viewOf(dataset.cloud);
  const std::string field = uvol_tools::labelField(cloud, arguments.label);
  if (field.empty())
    throw UsageError("The input has no field label: find clusters by -attributes, or "
                     "name their field by -label.");
  return uvol_tools::readLabels(cloud, field);
}

/** How far every point belongs to the chosen cluster. */
std::vector<float>
computeMembership(const Options& options,
                  const Arguments& arguments,
                  const Dataset& dataset,
                  const std::vector<std::int32_t>& labels,
                  Report& report)
{
  pcl_uvol::ClusterMembership<pcl::PCLPointCloud2> membership;
  membership.setInputCloud(
      pcl::PCLPointCloud2::ConstPtr(&dataset.cloud, [](const void*) {}));
  pcl_uvol::MembershipParameters parameters;
  parameters.cluster = static_cast<int>(arguments.cluster[0]);
  parameters.probability = arguments.probability;
  parameters.smoothing_length = arguments.smoothing;
  membership.setParameters(parameters);
  membership.setLabels(labels);
  membership.setNumberOfThreads(options.threads());
  membership.setProgressCallback(report.progress);
  std::vector<float> values;
  membership.compute(values);
  report.merge(membership.getReport());
  return values;
}

pcl_uvol::ClusterSurface
enclose(const Options& options,
        const Arguments& arguments,
        const Dataset& dataset,
        const std::vector<std::uint32_t>& members,
        const pcl_uvol::detail::Stretch& stretch,
        Report& report)
{
  pcl_uvol::ClusterSurfaceGeneration<pcl::PCLPointCloud2> generation;
  generation.setInputCloud(
      pcl::PCLPointCloud2::ConstPtr(&dataset.cloud, [](const void*) {}));
  generation.setIndices(std::make_shared<pcl::Indices>(members.begin(), members.end()));
  pcl_uvol::ClusterSurfaceParameters parameters;
  fromWord(arguments.surface, parameters.kind);
  parameters.cells = static_cast<std::uint32_t>(arguments.grid);
  parameters.distance = arguments.distance;
  parameters.scale = stretch.scale;
  parameters.rotation = stretch.rotation;
  generation.setParameters(parameters);
  generation.setNumberOfThreads(options.threads());
  generation.setProgressCallback(report.progress);
  pcl_uvol::ClusterSurface surface;
  generation.compute(surface);
  report.merge(generation.getReport());
  return surface;
}

/** Vertices of hulls carry the fields of their points. */
Dataset
makeVertices(const Dataset& dataset, const pcl_uvol::ClusterSurface& surface)
{
  Dataset vertices = pcl_uvol::toDataset(surface.mesh);
  vertices.origin = dataset.origin;
  vertices.double_coordinates = dataset.double_coordinates;
  if (!surface.points.empty())
    pcl_uvol::copyFields(dataset.cloud, surface.points, vertices.cloud);
  return vertices;
}

/** Writes what is asked for of the chosen cluster. */
void
writeCluster(const Options& options,
             const Arguments& arguments,
             const Dataset& dataset,
             const std::vector<std::int32_t>& labels,
             Facts& facts,
             Report& report)
{
  pcl_uvol::SaveOptions save;
  save.ascii = arguments.ascii;
  const std::vector<float> membership =
      computeMembership(options, arguments, dataset, labels, report);
  std::vector<std::uint32_t> members;
  for (std::uint32_t i = 0; i < labels.size(); ++i)
    if (labels[i] == static_cast<std::int32_t>(arguments.cluster[0]))
      members.push_back(i);
  if (arguments.surface.empty()) {
    uvol_tools::savePoints(
        arguments.output, uvol_tools::takePoints(dataset, members), save, report);
    return;
  }
  if (!dataset.has_coordinates)
    throw pcl_uvol::InvalidArgument("no_coordinates_to_draw", {});
  Facts of_scale;
  const auto stretch = arguments.scale.resolve(
      pcl_uvol::viewOf(dataset.cloud), "", options.threads(), report, of_scale);
  uvol_tools::append(facts, of_scale);
  if (!arguments.isMesh()) {
    const Dataset surface =
        pcl_uvol::extractMembershipSurface(dataset,
                                           membership,
                                           stretch,
                                           !arguments.smoothing.empty(),
                                           options.threads(),
                                           report);
    uvol_tools::savePoints(arguments.output, surface, save, report);
    return;
  }
  const auto surface = enclose(options, arguments, dataset, members, stretch, report);
  facts.emplace_back("distance", surface.distance);
  const pcl_uvol::StepTimer timer(report, "write");
  pcl_uvol::saveMesh(
      arguments.output, makeVertices(dataset, surface), surface.mesh.triangles, save);
}

/** Points of each cluster, by label; negative labels are no clusters. */
std::map<std::int32_t, std::size_t>
countMembers(const std::vector<std::int32_t>& labels)
{
  std::map<std::int32_t, std::size_t> sizes;
  for (const std::int32_t label : labels)
    if (label >= 0)
      ++sizes[label];
  return sizes;
}

/** "0: 812, 1: 77". */
std::string
describeSizes(const std::map<std::int32_t, std::size_t>& sizes)
{
  constexpr std::size_t most = 12;
  std::ostringstream text;
  std::size_t listed = 0;
  for (const auto& [label, size] : sizes) {
    if (++listed > most) {
      text << ", ... (" << sizes.size() << " in all)";
      break;
    }
    text << (listed == 1 ? "" : ", ") << label << ": " << size;
  }
  return sizes.empty() ? "none" : text.str();
}

/** People read the first sizes, programs all of them. */
void
listSizes(const std::vector<std::int32_t>& labels, Facts& facts)
{
  const auto sizes = countMembers(labels);
  Fact::Numbers names, members;
  for (const auto& [label, size] : sizes) {
    names.push_back(label);
    members.push_back(static_cast<double>(size));
  }
  facts.emplace_back("clusters", describeSizes(sizes), members);
  facts.emplace_back("labels", "", names);
}

/** What a clustering tells is known of labels that are given, but for why points have
 * none. */
void
countLabels(const std::vector<std::int32_t>& labels, Report& report)
{
  const auto without =
      std::count_if(labels.begin(), labels.end(), [](auto label) { return label < 0; });
  report.count("points", labels.size());
  report.count("in_no_cluster", static_cast<std::uint64_t>(without));
}

int
run(int argc, char** argv)
{
  Arguments arguments;
  Options options("uvol_cluster",
                  "in.csv out.ply [options]",
                  "Find clusters of points by the density of their attributes, and "
                  "surfaces around them.\n"
                  "Output: fields label (-1: noise) and probability; -cluster "
                  "selects one cluster.");
  arguments.declare(options);
  if (!options.parse(argc, argv))
    return 0;
  arguments.finish(options);
  const pcl_uvol::LoadOptions load = uvol_tools::withoutPositions(arguments.reading);
  Report report;
  uvol_tools::ProgressBar bar;
  report.progress = std::ref(bar);
  Dataset dataset = uvol_tools::loadPoints(
      arguments.input, report, load, arguments.reading.getWhere(), options.threads());
  pcl_uvol::checkSavePath(arguments.output, dataset.cloud.fields);
  arguments.attributes.addFields(options, dataset, report);
  std::vector<pcl_uvol::ClusterNode> tree;
  const auto labels = findLabels(options, arguments, dataset, tree, report);
  Facts facts = {{"input", arguments.input}, {"output", arguments.output}};
  listSizes(labels, facts);
  if (!arguments.attributes.areGiven())
    countLabels(labels, report);
  if (!arguments.cluster.empty())
    writeCluster(options, arguments, dataset, labels, facts, report);
  else {
    pcl_uvol::SaveOptions save;
    save.ascii = arguments.ascii;
    uvol_tools::savePoints(arguments.output, dataset, save, report);
  }
  if (!arguments.tree.empty())
    writeTree(arguments.tree, tree);
  facts.push_back(uvol_tools::describeMemory());
  uvol_tools::printReport(options, report, facts);
  return 0;
}

} // namespace

int
main(int argc, char** argv)
{
  // What VTK would tell of errors, the sentence of the error tells.
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
  return uvol_tools::runTool("uvol_cluster", [&] { return run(argc, argv); });
}
