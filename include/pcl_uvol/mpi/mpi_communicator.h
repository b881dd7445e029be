// SPDX-License-Identifier: BSD-3-Clause
// The processes of an MPI job, by VTK's controller.
#pragma once

#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/distributed/communicator.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

class vtkMPIController;

namespace pcl_uvol {

/** \brief Thrown where a process waits for another one that failed, which knows why. */
class PCL_UVOL_EXPORTS OtherRankFailed : public Exception {
public:
  using Exception::Exception;
};

/** \brief The processes of a controller. None waits for one that failed: before they
 * exchange anything they agree that all are well, by the minimum of one number. */
class PCL_UVOL_EXPORTS MpiCommunicator : public Communicator {
public:
  /** \param controller is initialized, and must outlive this object
   * \param largest_part bytes that MPI, which counts by int, is given at once */
  explicit MpiCommunicator(vtkMPIController& controller,
                           std::size_t largest_part = std::size_t(1) << 30);

  std::size_t
  size() const override;

  std::size_t
  rank() const override;

  /** \copydoc Communicator::allReduce
   * \throws OtherRankFailed */
  void
  allReduce(std::vector<std::uint64_t>& numbers) override;

  /** \copydoc Communicator::allToAll
   * \throws OtherRankFailed */
  std::vector<Bytes>
  allToAll(std::vector<Bytes>&& messages) override;

  /** \copydoc Communicator::allGather
   * \throws OtherRankFailed */
  std::vector<Bytes>
  allGather(const Bytes& message) override;

  /** \copydoc Communicator::split
   * A process that leaves its group by an exception has failed: the others of the
   * group learn it at their next exchange, and all others at that after the groups.
   * \throws OtherRankFailed */
  std::unique_ptr<Communicator>
  split(std::size_t color) override;

  /** \brief Report to the other processes whether this one has failed, when they call
   * this function or one of those above. After a failure nothing more is exchanged.
   * \param has_failed whether this process has
   * \return the first process that failed, size() for none */
  std::size_t
  agree(bool has_failed);

private:
  /** Go on only if all do. */
  void
  proceed();

  vtkMPIController& controller_;
  std::size_t largest_part_;
  std::size_t failed_; ///< the first process that did
};

} // namespace pcl_uvol
