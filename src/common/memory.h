// SPDX-License-Identifier: BSD-3-Clause
// What memory there is, and work refused that does not fit before it begins.
#pragma once

#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/common/export.h>

#include <cstddef>
#include <cstdint>
#include <string>

namespace pcl_uvol {

/** \brief Bytes that the process can still take without swapping or being killed: the
 * least that the system, the control groups, the limits of the process and MemoryLimit
 * leave; the largest number where none of them tells. */
PCL_UVOL_EXPORTS std::uint64_t
availableMemory();

/** \brief What the memory limits of control groups leave, of versions 1 and 2: a
 * container's. Files that are kept in memory count as available, since they give way.
 * \param groups the file that tells the groups of the process
 * \param root where the groups are mounted
 * \return the largest number without a limit */
PCL_UVOL_EXPORTS std::uint64_t
availableInControlGroups(const std::string& groups = "/proc/self/cgroup",
                         const std::string& root = "/sys/fs/cgroup");

/** \brief Bytes of memory that the process has in use, code included; 0 where the
 * system does not tell. */
PCL_UVOL_EXPORTS std::uint64_t
residentMemory();

/** \brief The most of it so far (VmHWM). */
PCL_UVOL_EXPORTS std::uint64_t
peakMemory();

/** \brief The most that the process was expected to have in use by its checks of
 * memory: what it had, and what the work needs that was not refused. */
PCL_UVOL_EXPORTS double
forecastMemory();

/** \brief While it lives, all checks of memory hold the whole process against a bound,
 * small work as well. A limit within another one replaces it for that time. */
class PCL_UVOL_EXPORTS MemoryLimit {
public:
  /** \param bytes that the process may have in use */
  explicit MemoryLimit(std::uint64_t bytes);
  MemoryLimit(const MemoryLimit&) = delete;
  MemoryLimit&
  operator=(const MemoryLimit&) = delete;
  ~MemoryLimit();

private:
  std::uint64_t before_;
};

/** \brief "1.6 GB": two digits, in powers of 1000. */
PCL_UVOL_EXPORTS std::string
formatBytes(double bytes);

/** \brief More memory is asked for than there is. */
class PCL_UVOL_EXPORTS NotEnoughMemory : public InvalidArgument {
public:
  using InvalidArgument::InvalidArgument;
};

/** \brief Check that work fits into memory, and forecast what it needs.
 * \param what as a subject: "A grid of 9 x 9 x 9 cells"
 * \param bytes besides what the process has in use
 * \throws NotEnoughMemory with both figures if more is needed than is available */
PCL_UVOL_EXPORTS void
checkMemory(const std::string& what, double bytes);

/** \brief checkMemory() of work on points, asked before it begins. Small work is only
 * forecast: to ask what is available takes longer.
 * \param task as in "Clustering"
 * \param bytes at the peak, besides the points
 * \throws NotEnoughMemory "Clustering of 1000 points needs ..." */
PCL_UVOL_EXPORTS void
checkMemoryOf(const std::string& task, std::size_t points, double bytes);

} // namespace pcl_uvol
