// SPDX-License-Identifier: BSD-3-Clause
// What takes time before the first frame of a surface, for threads that have it.
#pragma once

#include <pcl_uvol/common/export.h>
#include <pcl_uvol/common/report.h>

#include <pcl/PCLPointCloud2.h>

#include <cstddef>
#include <memory>
#include <mutex>

namespace pcl_uvol {

class SurfaceCloud;
struct Footprints;

/** \brief A surface that is ready to be drawn: a window takes it from the thread that
 * has made its points, and goes on meanwhile. For one renderer.
 *
 * \code
 * const auto prepared = std::make_shared<pcl_uvol::PreparedSurface>(*cloud); // there
 * prop->setInputCloud(cloud, prepared); // in the window's thread
 * prepared->findFootprints();           // there, while the window draws without
 * \endcode
 */
class PCL_UVOL_EXPORTS PreparedSurface {
public:
  /** \brief Sort the points.
   * \param cloud as of ImageSpaceRenderer
   * \param threads 0 (default) = all cores, here and for footprints
   * \param progress is told of the steps
   * \throws InvalidArgument if there is no point to draw */
  explicit PreparedSurface(const pcl::PCLPointCloud2& cloud,
                           unsigned threads = 0,
                           const ProgressCallback& progress = {});
  PreparedSurface(const PreparedSurface&) = delete;
  PreparedSurface&
  operator=(const PreparedSurface&) = delete;
  ~PreparedSurface();

  /** \brief Find the discs of the points; frames that need them have them from then on.
   * The surface may be drawn meanwhile.
   * \param progress is told of the steps */
  void
  findFootprints(const ProgressCallback& progress = {});

private:
  friend class ImageSpaceRendererBase;

  /** Give footprints that were found to the surface, and what they report.
   * \return false if there are none yet */
  bool
  applyFootprints(Report& report);

  unsigned threads_;
  std::size_t count_; // of the cloud's points
  std::shared_ptr<SurfaceCloud> surface_;
  Report report_; // of the points
  std::mutex mutex_;
  std::unique_ptr<Footprints> footprints_; // that wait to be applied
  Report footprints_report_;
};

} // namespace pcl_uvol
