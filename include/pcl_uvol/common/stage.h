// SPDX-License-Identifier: BSD-3-Clause
// What the stages have in common besides their input: threads, progress and report.
#pragma once

#include <pcl_uvol/common/report.h>

namespace pcl_uvol {

/** \brief Base of the stages, beside pcl::PCLBase. */
class Stage {
public:
  /** \brief 0 (default) = all cores. The result does not depend on it. */
  void
  setNumberOfThreads(unsigned threads)
  {
    threads_ = threads;
  }

  /** \brief Told while the stage runs; see ProgressCallback. Default: nobody is. */
  void
  setProgressCallback(const ProgressCallback& progress)
  {
    progress_ = progress;
  }

  /** \brief Counts and times of the last run; each stage lists its counts. */
  const Report&
  getReport() const
  {
    return report_;
  }

protected:
  Stage() = default;
  ~Stage() = default;

  /** \brief An empty report that tells the stage's progress. */
  void
  startReport()
  {
    report_ = Report();
    report_.progress = progress_;
  }

  unsigned threads_ = 0;
  Report report_;

private:
  ProgressCallback progress_;
};

} // namespace pcl_uvol
