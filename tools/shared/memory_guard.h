// SPDX-License-Identifier: BSD-3-Clause
// The forecast of a tool's memory: against what is there, and beside what it came to.
#pragma once

#include "shared/facts.h"
#include <pcl_uvol/io/dataset.h>

#include <functional>
#include <string>

namespace uvol_tools {

/** \brief Refuses a run whose memory is short before it begins. */
class MemoryGuard {
public:
  /** \brief Bytes that a tool takes at its peak besides points, by their number and the
   * bytes of one. */
  using Bytes = std::function<double(double points, double point_step)>;

  /** \param task as in "Extracting isosurfaces"
   * What is resident now counts as held: to be made before anything is read. */
  explicit MemoryGuard(std::string task);

  /** \brief Check what the header of a file tells, before the file is read.
   * \param bytes empty if only reading tells how many points are left
   * \throws NotEnoughMemory with both figures if more is needed than is available */
  void
  checkFile(const std::string& path,
            const Bytes& bytes,
            const pcl_uvol::LoadOptions& options = {});

  /** \brief Check the points that were read.
   * \throws NotEnoughMemory the same */
  void
  checkCloud(const pcl_uvol::Dataset& dataset, const Bytes& bytes);

  /** \brief The last forecast beside the peak so far. */
  Fact
  describe() const;

private:
  void
  check(double points) const;

  std::string task_;
  double base_, forecast_ = 0.0;
};

/** \brief Bytes of the derivatives of an expression, 0 if it has none. */
double
derivativeBytes(const std::string& expression, double points);

} // namespace uvol_tools
