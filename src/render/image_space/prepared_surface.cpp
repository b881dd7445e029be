// SPDX-License-Identifier: BSD-3-Clause
#include "render/image_space/footprint_need.h"
#include "render/surface_cloud.h"
#include "surface/footprints.h"
#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/render/image_space/image_space_renderer.h>

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

namespace pcl_uvol {

PreparedSurface::PreparedSurface(const pcl::PCLPointCloud2& cloud,
                                 unsigned threads,
                                 const ProgressCallback& progress)
    : threads_(threads)
{
  const CloudView view = viewOf(cloud);
  count_ = view.count;
  std::vector<std::uint32_t> all(count_);
  std::iota(all.begin(), all.end(), 0u);
  report_.progress = progress;
  {
    const StepTimer timer(report_, "prepare");
    surface_ = std::make_shared<SurfaceCloud>(view, all, threads, report_);
  }
  report_.progress = nullptr;
}

PreparedSurface::~PreparedSurface() = default;

void
PreparedSurface::findFootprints(const ProgressCallback& progress)
{
  Report report;
  report.progress = progress;
  auto found = std::make_unique<Footprints>(surface_->findFootprints(threads_, report));
  keepFootprints(std::move(found), std::move(report));
}

void
PreparedSurface::keepFootprints(std::unique_ptr<Footprints>&& footprints,
                                Report&& report)
{
  std::vector<FittedDisc> discs = surface_->listFittedDiscs(*footprints, count_);
  const std::lock_guard<std::mutex> lock(mutex_);
  footprints_ = std::move(footprints);
  footprints_report_ = std::move(report);
  if (fitted_discs_.empty()) // others may look at them
    fitted_discs_ = std::move(discs);
}

const std::vector<FittedDisc>&
PreparedSurface::findFittedDiscs(const Camera& camera, int width, int height)
{
  static const std::vector<FittedDisc> none;
  // In the usual number of samples per pixel: cameras do not depend on it.
  constexpr int supersampling = 2;
  const int factor =
      std::max(width, height) * supersampling <= View::largest_size ? supersampling : 1;
  const View view(camera, surface_->getBounds(), width * factor, height * factor);
  if (!needsFootprints(*surface_, view))
    return none;
  const auto are_found = [this] {
    const std::lock_guard<std::mutex> lock(mutex_);
    return !fitted_discs_.empty();
  };
  if (!are_found())
    findFootprints();
  return fitted_discs_;
}

const BoundingSphere&
PreparedSurface::getBounds() const
{
  return surface_->getBounds();
}

bool
PreparedSurface::applyFootprints(Report& report)
{
  std::unique_ptr<Footprints> found;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!footprints_)
      return false;
    found = std::move(footprints_);
    report.merge(footprints_report_);
  }
  surface_->setFootprints(std::move(*found));
  return true;
}

} // namespace pcl_uvol
