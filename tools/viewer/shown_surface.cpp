// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/shown_surface.h"

#include "common/scalar_field.h"
#include "pipeline/dataset_info.h"
#include "render/stretch_surface.h"
#include "viewer/drafting_pipeline.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/isosurface/isosurface_extraction.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

namespace uvol_tools {

namespace {

using pcl_uvol::InvalidArgument;

pcl_uvol::BoundingSphere
ballAround(const pcl::PCLPointCloud2& points)
{
  const pcl_uvol::CloudView cloud = pcl_uvol::viewOf(points);
  const auto position = [&](std::size_t i) {
    return Eigen::Vector3d(cloud.xyz(i)[0], cloud.xyz(i)[1], cloud.xyz(i)[2]);
  };
  Eigen::AlignedBox3d box;
  for (std::size_t i = 0; i < cloud.count; ++i)
    if (position(i).allFinite())
      box.extend(position(i));
  pcl_uvol::BoundingSphere ball;
  if (box.isEmpty())
    return ball;
  ball.center = box.center();
  for (std::size_t i = 0; i < cloud.count; ++i)
    if (position(i).allFinite())
      ball.radius = std::max(ball.radius, (position(i) - ball.center).norm());
  return ball;
}

using Cut = std::optional<Eigen::Hyperplane<double, 3>>;

bool
isSameCut(const Cut& a, const Cut& b)
{
  return a && b ? a->coeffs() == b->coeffs() : !a && !b;
}

/** The points that are not in front of a plane when they are stretched, and all of them
 * without one. */
pcl::PCLPointCloud2::ConstPtr
cutAway(const pcl::PCLPointCloud2::ConstPtr& whole,
        const Cut& plane,
        const Eigen::Vector3d& factors)
{
  if (!whole || !plane)
    return whole;
  const pcl_uvol::CloudView cloud = pcl_uvol::viewOf(*whole);
  std::vector<std::uint32_t> kept;
  for (std::size_t i = 0; i < cloud.count; ++i)
    if (const Eigen::Vector3d place =
            Eigen::Map<const Eigen::Vector3f>(cloud.xyz(i)).cast<double>();
        plane->signedDistance(place.cwiseProduct(factors)) <= 0.0)
      kept.push_back(static_cast<std::uint32_t>(i));
  if (kept.empty())
    return nullptr;
  const auto part = pcl::make_shared<pcl::PCLPointCloud2>();
  part->height = 1;
  part->width = static_cast<pcl::uindex_t>(kept.size());
  pcl_uvol::copyFields(*whole, kept, *part);
  return part;
}

pcl::PCLPointCloud2::ConstPtr
stretch(const pcl::PCLPointCloud2::ConstPtr& data, const Eigen::Vector3d& factors)
{
  if (!data || factors == Eigen::Vector3d::Ones())
    return data;
  pcl_uvol::Dataset surface;
  surface.cloud = *data;
  pcl_uvol::stretchSurface(surface, factors);
  return pcl::make_shared<pcl::PCLPointCloud2>(std::move(surface.cloud));
}

/** What is drawn of an isosurface. */
ExtractedSurface
makeShown(pcl_uvol::IsosurfaceResult result,
          const SurfaceRequest& request,
          const Eigen::Vector3d& factors,
          const ShownSurface::AddColor& add_color,
          unsigned threads,
          const pcl_uvol::ProgressCallback& progress)
{
  ExtractedSurface shown;
  shown.report = std::move(result.report);
  shown.report.progress = nullptr; // that of the worker
  shown.triangles = std::move(result.triangles);
  if (result.surface.cloud.width > 0 && add_color)
    add_color(result.surface, shown.report);
  if (result.surface.cloud.width > 0)
    shown.whole =
        pcl::make_shared<pcl::PCLPointCloud2>(std::move(result.surface.cloud));
  shown.data = shown.triangles.empty() ? cutAway(shown.whole, request.cut, factors)
                                       : shown.whole;
  shown.cloud = stretch(shown.data, factors);
  if (shown.cloud && shown.triangles.empty())
    shown.prepared =
        std::make_shared<pcl_uvol::PreparedSurface>(*shown.cloud, threads, progress);
  return shown;
}

} // namespace

std::array<double, 2>
findRange(const pcl::PCLPointCloud2& points, const std::string& name)
{
  const pcl_uvol::CloudView cloud = pcl_uvol::viewOf(points);
  const pcl_uvol::ScalarField field(cloud.fields, name);
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (std::size_t i = 0; i < cloud.count; ++i) {
    const double value = field.read(cloud.point(i));
    if (std::isfinite(value)) {
      low = std::min(low, value);
      high = std::max(high, value);
    }
  }
  if (low > high)
    throw InvalidArgument("all_values_missing", {{"field", name}});
  return {low, high};
}

ShownSurface::ShownSurface(pcl_uvol::Dataset dataset,
                           const std::string& field,
                           unsigned threads,
                           const Eigen::Vector3d& factors,
                           const AddColor& add_color)
    : origin_(dataset.origin)
    , factors_(factors)
    , field_(field)
    , threads_(threads)
{
  if (dataset.cloud.width == 0)
    throw InvalidArgument("no_points_to_show", {});
  const auto samples = std::make_shared<const pcl_uvol::Dataset>(std::move(dataset));
  samples_ = Cloud::ConstPtr(samples, &samples->cloud);
  if (field_.empty()) {
    whole_ = data_ = samples_;
    prepare();
    return;
  }
  range_ = findRange(*samples_, field_);
  if (!(range_[0] < range_[1]))
    throw InvalidArgument("all_values_equal", {{"field", field_}});
  const auto pipeline = std::make_shared<DraftingPipeline>(samples, field, threads);
  worker_ =
      std::make_unique<SurfaceWorker>([pipeline, factors, add_color, threads](
                                          const SurfaceRequest& request,
                                          unsigned thinning,
                                          const pcl_uvol::ProgressCallback& progress) {
        return makeShown(pipeline->run(request, thinning, progress),
                         request,
                         factors,
                         add_color,
                         threads,
                         progress);
      });
}

std::vector<double>
ShownSurface::readValues() const
{
  const pcl_uvol::CloudView cloud = pcl_uvol::viewOf(*samples_);
  const pcl_uvol::ScalarField field(cloud.fields, field_);
  std::vector<double> values(cloud.count);
  for (std::size_t i = 0; i < cloud.count; ++i)
    values[i] = field.read(cloud.point(i));
  return values;
}

double
ShownSurface::proposeIsoValue() const
{
  const auto proposed = pcl_uvol::describeValues(readValues()).isovalues;
  return proposed.empty() ? 0.5 * range_[0] + 0.5 * range_[1] : proposed.front();
}

void
ShownSurface::setIsoValue(double isovalue)
{
  std::vector<double> isovalues = asked_.isovalues;
  isovalues.back() = isovalue;
  setIsoValues(isovalues);
}

void
ShownSurface::setIsoValues(const std::vector<double>& isovalues)
{
  for (const double isovalue : isovalues)
    if (!(isovalue >= range_[0] && isovalue <= range_[1]))
      throw InvalidArgument("isovalue_beyond_range",
                            {{"low", range_[0]},
                             {"high", range_[1]},
                             {"field", field_},
                             {"isovalue", isovalue}});
  ask({isovalues, asked_.is_meshed, asked_.cut});
}

void
ShownSurface::keepIsoValue()
{
  const auto moving = std::prev(asked_.isovalues.end());
  if (std::find(asked_.isovalues.begin(), moving, *moving) == moving)
    asked_.isovalues.push_back(*moving);
}

void
ShownSurface::setMeshed(bool is_meshed)
{
  if (field_.empty())
    throw InvalidArgument("mesh_of_surface_points", {});
  ask({asked_.isovalues, is_meshed, asked_.cut});
}

void
ShownSurface::ask(const SurfaceRequest& request)
{
  worker_->ask(request);
  asked_ = request;
}

bool
ShownSurface::update()
{
  return takeFrom(&SurfaceWorker::take);
}

bool
ShownSurface::finish()
{
  return takeFrom(&SurfaceWorker::finish);
}

bool
ShownSurface::takeFrom(std::optional<SurfaceWorker::Result> (SurfaceWorker::*give)())
{
  if (!worker_)
    return false;
  std::optional<SurfaceWorker::Result> result;
  try {
    result = (*worker_.*give)();
  }
  catch (...) {
    if (!worker_->isBusy())
      asked_ = shown_;
    throw;
  }
  if (!result)
    return false;
  shown_ = result->request;
  report_ = std::move(result->surface.report);
  triangles_ = std::move(result->surface.triangles);
  whole_ = result->surface.whole;
  data_ = result->surface.data;
  cloud_ = result->surface.cloud;
  prepared_ = result->surface.prepared;
  if (!isSameCut(shown_.cut, asked_.cut)) // which has changed meanwhile
    setCut(asked_.cut);
  return true;
}

void
ShownSurface::setCut(const std::optional<Eigen::Hyperplane<double, 3>>& plane)
{
  asked_.cut = shown_.cut = plane;
  data_ = triangles_.empty() ? cutAway(whole_, plane, factors_) : whole_;
  prepare();
}

void
ShownSurface::prepare()
{
  cloud_ = stretch(data_, factors_);
  prepared_.reset();
  if (cloud_ && triangles_.empty())
    prepared_ = std::make_shared<pcl_uvol::PreparedSurface>(*cloud_, threads_);
}

pcl_uvol::BoundingSphere
ShownSurface::getBounds() const
{
  return ballAround(*(cloud_ ? cloud_ : stretch(samples_, factors_)));
}

std::array<double, 3>
ShownSurface::getDrawnOrigin() const
{
  std::array<double, 3> origin = origin_;
  for (std::size_t axis = 0; axis < origin.size(); ++axis)
    origin[axis] *= factors_[static_cast<Eigen::Index>(axis)];
  return origin;
}

} // namespace uvol_tools
