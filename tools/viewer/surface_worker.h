// SPDX-License-Identifier: BSD-3-Clause
// Isosurfaces that are extracted while the window goes on.
#pragma once

#include "viewer/draft_choice.h"
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

/** \brief Extracts isosurfaces in a thread of its own, one at a time, each with its
 * footprints. Where a surface of all samples takes too long to follow a slider, a draft
 * of some of them comes first, and the surface itself when nothing newer has been asked
 * for during a pause.
 *
 * Requests that are overtaken by newer ones before their turn comes are dropped, and
 * surfaces after their drafts are ended; what is shown first of a request is done, so
 * that a slider that never rests shows something, too. */
class SurfaceWorker {
public:
  /** \brief Makes a surface, in the worker's thread, of one of so many samples. What it
   * tells to the progress is dropped, but ends it when it is not wanted any more. */
  using Extract =
      std::function<ExtractedSurface(const SurfaceRequest& request,
                                     unsigned thinning,
                                     const pcl_uvol::ProgressCallback& progress)>;

  /** \brief A surface, and what it is of. */
  struct Result {
    SurfaceRequest request;
    ExtractedSurface surface;
  };

  /** \brief Milliseconds that the first surface of a request may take: with its frame,
   * a slider's step then takes about half as long again. */
  static constexpr double usual_goal = 90.0;

  /** \param milliseconds what the first surface of a request may take */
  explicit SurfaceWorker(Extract extract, double milliseconds = usual_goal);
  SurfaceWorker(const SurfaceWorker&) = delete;
  SurfaceWorker&
  operator=(const SurfaceWorker&) = delete;
  /** \brief Ends what is under way. */
  ~SurfaceWorker();

  /** \brief Ask for a surface. */
  void
  ask(const SurfaceRequest& request);

  /** \brief Whether a surface that was asked for is not taken yet, or only a draft of
   * it. */
  bool
  isBusy() const;

  /** \brief The newest surface that is ready and was not taken yet; none: there is no
   * such one.
   * \throws what its extraction has thrown */
  std::optional<Result>
  take();

  /** \brief The same once all that was asked for is done, without drafts. */
  std::optional<Result>
  finish();

private:
  /** What the thread does. */
  void
  work();

  /** Extract what is asked for, a draft of it first if it is a long way. */
  void
  answer(const SurfaceRequest& request);

  /** Make a draft.
   * \return whether it shows something, so that there is no hurry any more */
  bool
  draft(const SurfaceRequest& request, unsigned thinning);

  /** Make the surface of all samples, with what is thrown in the place of a result.
   * \param is_drafted it ends when something newer is asked for */
  void
  complete(const SurfaceRequest& request, bool is_drafted);

  /** Extract a surface and find its footprints. */
  Result
  extract(const SurfaceRequest& request,
          unsigned thinning,
          const std::function<bool()>& is_unwanted);

  /** Give a surface, or what was thrown in its place. */
  void
  give(std::optional<Result>&& result, std::exception_ptr error);

  /** Wait a while whether something newer is asked for.
   * \return false: it is, or nothing is wanted any more */
  bool
  rests();

  const Extract extract_;
  DraftChoice choice_;       // of the thread
  mutable std::mutex mutex_; // of all below
  std::condition_variable changed_;
  std::optional<SurfaceRequest> waiting_;
  bool is_working_ = false;
  std::atomic<bool> is_ending_ = false;
  std::atomic<bool> is_overtaken_ = false; // by what waits
  std::atomic<bool> is_awaited_ = false;   // by finish()
  std::optional<Result> result_;
  std::exception_ptr error_; // in the place of a result
  std::thread thread_;       // last: it uses the others
};

} // namespace uvol_tools
