// SPDX-License-Identifier: BSD-3-Clause
// The extension _vtk: meshes around clusters, which VTK's contours make.
#include "shared/convert.h"
#include "shared/interruptible.h"
#include <pcl_uvol/io/dataset.h>
#include <pcl_uvol/isosurface/isosurface_extraction.h>
#include <pcl_uvol/vtk/cluster_surface.h>

#include <memory>
#include <pybind11/stl.h>
#include <string>
#include <utility>
#include <vector>

namespace py = pybind11;

namespace pcl_uvol::python {
namespace {

/** Vertices of hulls carry the fields of their points.
 * \param numbers indices of points
 * \param parameters JSON of ClusterSurfaceParameters
 * \return vertices, triangles, and the report with the distance that was taken */
py::tuple
encloseCluster(const DatasetPtr& dataset,
               const Numbers& numbers,
               const std::string& parameters,
               unsigned threads,
               const py::object& progress)
{
  const auto how = ClusterSurfaceParameters::fromJson(parameters);
  ClusterSurfaceGeneration<pcl::PCLPointCloud2> generation;
  generation.setInputCloud(pcl::PCLPointCloud2::ConstPtr(dataset, &dataset->cloud));
  generation.setIndices(std::make_shared<pcl::Indices>(toWholeNumbers(numbers)));
  generation.setParameters(how);
  generation.setNumberOfThreads(threads);
  ClusterSurface surface;
  Dataset vertices;
  runInterruptibly(progress, [&](const ProgressCallback& callback) {
    generation.setProgressCallback(callback);
    generation.compute(surface);
    vertices = toDataset(surface.mesh);
    vertices.origin = dataset->origin;
    vertices.double_coordinates = dataset->double_coordinates;
    if (!surface.points.empty())
      copyFields(dataset->cloud, surface.points, vertices.cloud);
  });
  py::dict entries = toDict(generation.getReport());
  entries["distance"] = surface.distance;
  entries["parameters"] = toText(how.toJson());
  return py::make_tuple(share(std::move(vertices)),
                        toIndices(std::move(surface.mesh.triangles)),
                        entries);
}

} // namespace
} // namespace pcl_uvol::python

PYBIND11_MODULE(_vtk, module)
{
  py::module_::import("pcl_uvol._core"); // the dataset's class
  module.def("enclose_cluster", &pcl_uvol::python::encloseCluster);
}
