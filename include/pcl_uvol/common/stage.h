// SPDX-License-Identifier: BSD-3-Clause
// What the stages have in common besides their input: parameters, threads, progress and
// report.
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

  /** \return The number of threads that was set; 0: all cores. */
  unsigned
  getNumberOfThreads() const
  {
    return threads_;
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

/** \brief Base of the stages whose parameters are a plain struct; their setters set its
 * members one by one. */
template <typename ParametersT>
class ParameterStage : public Stage {
public:
  using Parameters = ParametersT;

  /** \brief All of them at once; they are checked when the stage runs. */
  void
  setParameters(const Parameters& parameters)
  {
    parameters_ = parameters;
  }

  /** \return The parameters that the next run will have. */
  const Parameters&
  getParameters() const
  {
    return parameters_;
  }

protected:
  ParameterStage() = default;
  ~ParameterStage() = default;

  Parameters parameters_;
};

} // namespace pcl_uvol
