// SPDX-License-Identifier: BSD-3-Clause
// The forecast of a tool's memory: against what is there, and beside what it came to.
#pragma once

#include "common/memory.h"
#include "shared/facts.h"
#include <pcl_uvol/io/dataset.h>

#include <functional>
#include <string>

namespace uvol_tools {

/** \brief Refuses a run whose memory is short before it begins. */
class MemoryGuard {
public:
  /** \brief Adds what a tool does with points, which the forecast holds already, to it.
   * \param point_step bytes of one of them */
  using Work = std::function<void(
      double points, double point_step, pcl_uvol::MemoryForecast& forecast)>;

  /** \param task as in "Extracting isosurfaces"
   * What is resident now counts as held: to be made before anything is read. */
  explicit MemoryGuard(std::string task);

  /** \brief Check what the header of a file tells, before the file is read.
   * \param work empty if only reading tells how many points are left
   * \throws InvalidArgument with both figures if more is needed than is available */
  void
  checkFile(const std::string& path,
            const Work& work,
            const pcl_uvol::LoadOptions& options = {});

  /** \brief Check the points that were read.
   * \throws InvalidArgument the same */
  void
  checkCloud(const pcl_uvol::Dataset& dataset, const Work& work);

  /** \brief The last forecast beside the peak so far. */
  Fact
  describe() const;

private:
  void
  check(double points) const;

  std::string task_;
  double base_, forecast_ = 0.0;
};

} // namespace uvol_tools
