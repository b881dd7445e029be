// SPDX-License-Identifier: BSD-3-Clause
// Isosurfaces that are extracted while the window goes on.
#pragma once

#include <pcl_uvol/common/dataset.h>
#include <pcl_uvol/common/stage.h>
#include <pcl_uvol/render/image_space/image_space_renderer.h>

#include <Eigen/Geometry>
#include <pcl/PCLPointCloud2.h>

#include <atomic>
#include <condition_variable>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

namespace uvol_tools {

/** \brief What the user wants to see of samples. */
struct SurfaceRequest {
  std::vector<double> isovalues = {0.0}; ///< the last one moves, the others are kept
  bool is_meshed = false;                ///< triangles instead of isopoints
  /** Points in front of it are left out; a mesh stays whole. */
  std::optional<Eigen::Hyperplane<double, 3>> cut = {};
};

/** \brief What was extracted, and what is drawn of it; null where there are no points.
 */
struct ExtractedSurface {
  pcl::PCLPointCloud2::ConstPtr whole;
  pcl::PCLPointCloud2::ConstPtr data;  ///< what is not cut away of it
  pcl::PCLPointCloud2::ConstPtr cloud; ///< the same, stretched as it is drawn
  std::vector<pcl_uvol::Triangle> triangles;
  pcl_uvol::Report report;
  std::shared_ptr<pcl_uvol::PreparedSurface> prepared; ///< of cloud; null for a mesh
};

/** \brief Extracts isosurfaces in a thread of its own, one at a time. Requests that are
 * overtaken by newer ones before their turn comes are dropped; the one under way is
 * done, so that a slider that never rests shows something, too. Footprints of a surface
 * are found when it can be taken already and nothing newer is asked for. */
class SurfaceWorker {
public:
  /** \brief Makes a surface, in the worker's thread. What it tells to the progress is
   * dropped, but ends it when the worker ends. */
  using Extract = std::function<ExtractedSurface(
      const SurfaceRequest& request, const pcl_uvol::ProgressCallback& progress)>;

  /** \brief A surface, and what it is of. */
  struct Result {
    SurfaceRequest request;
    ExtractedSurface surface;
  };

  explicit SurfaceWorker(Extract extract);
  SurfaceWorker(const SurfaceWorker&) = delete;
  SurfaceWorker&
  operator=(const SurfaceWorker&) = delete;
  /** \brief Ends what is under way. */
  ~SurfaceWorker();

  /** \brief Ask for a surface. */
  void
  ask(const SurfaceRequest& request);

  /** \brief Whether a surface that was asked for is not taken yet, or has not all of
   * its footprints. */
  bool
  isBusy() const;

  /** \brief The newest surface that is ready and was not taken yet; none: there is no
   * such one.
   * \throws what its extraction has thrown */
  std::optional<Result>
  take();

  /** \brief The same once all that was asked for is done. */
  std::optional<Result>
  finish();

private:
  /** What the thread does. */
  void
  work();

  /** Extract a surface, with what is thrown in the place of a result.
   * \return what is to be drawn; null: nothing */
  std::shared_ptr<pcl_uvol::PreparedSurface>
  extract(const SurfaceRequest& request);

  /** Find footprints until something newer is asked for. */
  void
  findFootprints(pcl_uvol::PreparedSurface& prepared);

  const Extract extract_;
  mutable std::mutex mutex_; // of all below
  std::condition_variable changed_;
  std::optional<SurfaceRequest> waiting_;
  bool is_working_ = false;
  std::atomic<bool> is_ending_ = false;
  std::atomic<bool> is_overtaken_ = false; // by what waits
  std::optional<Result> result_;
  std::exception_ptr error_; // in the place of a result
  std::thread thread_;       // last: it uses the others
};

} // namespace uvol_tools
