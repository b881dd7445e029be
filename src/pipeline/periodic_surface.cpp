// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/periodic_surface.h"

#include "common/records.h"
#include "common/scalar_field.h"
#include "pipeline/periodic_mesh.h"
#include <pcl_uvol/common/cloud_view.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace pcl_uvol {
namespace {

/** From places counted from the corner of one box to coordinates within another. */
void
movePoints(const PeriodicBox& cut, const PeriodicBox& box, Dataset& surface)
{
  pcl::PCLPointCloud2& cloud = surface.cloud;
  const CloudView view = viewOf(cloud);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    // A mesh comes from the box itself, whose high face is not the low one.
    const bool is_same = cut.low[axis] == box.low[axis];
    for (std::size_t i = 0; i < cloud.width; ++i) {
      const auto place = static_cast<double>(view.xyz(i)[axis]);
      const double at = cut.low[axis] + place;
      putCoordinate(is_same ? at : box.low[axis] + box.toBox(at, axis),
                    axis,
                    &cloud.data[i * cloud.point_step]);
    }
  }
}

/** Counts points in the box only. */
void
countSupport(IsosurfaceResult& result)
{
  const pcl::PCLPointCloud2& cloud = result.surface.cloud;
  const ScalarField field(cloud.fields, "support");
  std::array<std::uint64_t, 4> counts{};
  for (std::size_t i = 0; i < cloud.width; ++i)
    ++counts.at(
        static_cast<std::size_t>(field.read(&cloud.data[i * cloud.point_step])));
  for (const auto& [name, support] :
       {std::pair("bridged", IsoSupport::Bridged), std::pair("rim", IsoSupport::Rim)})
    if (const std::uint64_t count = counts.at(static_cast<std::size_t>(support));
        count > 0 || !result.triangles.empty())
      result.report.setCount(name, count);
}

/** Leave some out of a count: unsigned sums wrap around. */
void
takeOff(const char* count, std::uint64_t some, Report& report)
{
  report.count(count, std::uint64_t(0) - some);
}

/** Samples with the images that the stages need.
 *
 * Isopoints come from a box whose faces lie in the widest gaps between the coordinates,
 * so that they do not depend on where the samples' box was put; meshes, which are cut
 * at its faces, from that box.
 *
 * \param use null: all samples
 *
 * \param parameters with the field and the scale that are taken */
PeriodicSamples
makeImages(const Dataset& samples,
           const pcl::IndicesPtr& use,
           const PeriodicBox& box,
           const IsosurfacePipelineParameters& parameters,
           unsigned threads,
           Report& report)
{
  return addPeriodicImages(samples,
                           listWithValue(samples, use, parameters.isosurface.field),
                           parameters.mesh ? box
                                           : cutAtWidestGap(samples, box, threads),
                           reachFor(parameters),
                           threads,
                           report);
}

/** The samples to use among those with images. */
pcl::IndicesPtr
indicesWithImages(const PeriodicSamples& images, const pcl::IndicesPtr& use)
{
  if (!use)
    return nullptr;
  auto all = std::make_shared<pcl::Indices>(*use);
  for (std::size_t i = images.countOwn(); i < images.samples.cloud.width; ++i)
    all->push_back(static_cast<pcl::index_t>(i));
  return all;
}

/** Bring a surface back to the box of the samples: a mesh is cut at its faces, points
 * lie in it already; coordinates and edges become those of the samples. */
void
returnToBox(const Dataset& samples,
            const PeriodicSamples& images,
            const PeriodicBox& box,
            PeriodicMesh periodic_mesh,
            IsosurfaceResult& result)
{
  if (!result.triangles.empty())
    detail::cutAtFaces(images.box, periodic_mesh, result);
  returnPoints(images.box, box, samples.origin, result);
  for (IsoEdge& edge : result.edges) {
    edge.first = images.sourceOf(edge.first);
    edge.second = images.sourceOf(edge.second);
  }
}

} // namespace

std::vector<ImagePlace>
listPlaces(const Dataset& points, std::size_t first)
{
  const CloudView view = viewOf(points.cloud);
  std::vector<ImagePlace> places;
  for (std::size_t i = first; i < view.count; ++i)
    places.push_back({view.xyz(i)[0], view.xyz(i)[1], view.xyz(i)[2]});
  return places;
}

SampleBox
toSampleBox(const PeriodicBox& box, const std::array<double, 3>& origin)
{
  SampleBox result;
  result.sides = box.sides;
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (box.sides[axis] > 0.0)
      result.low[axis] = box.low[axis] + origin[axis];
  return result;
}

std::uint64_t
countPlaces(std::vector<ImagePlace> places)
{
  std::sort(places.begin(), places.end());
  return static_cast<std::uint64_t>(std::unique(places.begin(), places.end()) -
                                    places.begin());
}

std::vector<std::uint32_t>
listWithValue(const Dataset& samples,
              const pcl::IndicesPtr& use,
              const std::string& field)
{
  const CloudView cloud = viewOf(samples.cloud);
  const ScalarField values(cloud.fields, field);
  std::vector<std::uint32_t> with_value;
  const auto add = [&](std::size_t point) {
    if (std::isfinite(values.read(cloud.point(point))))
      with_value.push_back(static_cast<std::uint32_t>(point));
  };
  for (std::size_t i = 0; i < (use ? use->size() : cloud.count); ++i)
    add(use ? static_cast<std::size_t>((*use)[i]) : i);
  return with_value;
}

PeriodicReach
reachFor(const IsosurfacePipelineParameters& parameters)
{
  PeriodicReach reach;
  reach.scale = toPosition(parameters.isosurface.scale);
  reach.spacings = parameters.smooth ? PeriodicReach::of_level_sets
                   : parameters.mesh ? PeriodicReach::of_meshes
                                     : PeriodicReach::of_fits;
  return reach;
}

void
returnPoints(const PeriodicBox& cut,
             const PeriodicBox& box,
             const std::array<double, 3>& origin,
             IsosurfaceResult& result)
{
  countSupport(result);
  movePoints(cut, box, result.surface);
  result.surface.origin = origin;
}

RepeatedBox::RepeatedBox(PipelineInput& input, unsigned threads, Report& report)
{
  IsosurfacePipelineParameters& parameters = input.parameters;
  if (!isPeriodic(sidesOf(parameters)))
    return;
  samples_ = input.samples;
  box_ = findPeriodicBox(*samples_, sidesOf(parameters), report);
  images_ = std::make_shared<PeriodicSamples>(
      makeImages(*samples_, input.use, box_, parameters, threads, report));
  // Images go beyond all faces: caps would close the surface where it is cut.
  if (parameters.mesh && (parameters.periodic > 0.0).all())
    parameters.mesh->open = true;
  input.samples = {images_, &images_->samples};
  input.use = indicesWithImages(*images_, input.use);
}

void
RepeatedBox::leave(const IsosurfacePipelineParameters& parameters,
                   IsosurfaceResult& result) const
{
  if (!images_)
    return;
  result.box = toSampleBox(box_, samples_->origin);
  const std::uint64_t images = images_->image_of.size(),
                      places = countPlaces(
                          listPlaces(images_->samples, images_->countOwn()));
  result.report.setCount("images", images);
  takeOff("samples", places, result.report);
  takeOff("duplicates", images - places, result.report);
  returnToBox(*samples_, *images_, box_, parameters.periodic_mesh, result);
  for (std::size_t i = 0; parameters.mesh && i < result.isopoints.size(); ++i) {
    result.isopoints[i] = 0;
    for (const SurfacePiece& piece : result.pieces)
      if (piece.isovalue == parameters.isosurface.isovalues[i])
        result.isopoints[i] += piece.vertices;
  }
}

} // namespace pcl_uvol
