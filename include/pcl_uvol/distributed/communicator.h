// SPDX-License-Identifier: BSD-3-Clause
// What processes that each hold a part of one data set tell each other, in the words of
// MPI. The core talks through this interface; mpi implements it by VTK's controllers.
#pragma once

#include <pcl_uvol/common/export.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace pcl_uvol {

/** \brief A message. */
using Bytes = std::vector<std::uint8_t>;

/** \brief Processes in a row. Each function is called by all of them, in one order;
 * \throws pcl::PCLException if the connection fails */
class PCL_UVOL_EXPORTS Communicator {
public:
  Communicator() = default;
  Communicator(const Communicator&) = delete;
  Communicator&
  operator=(const Communicator&) = delete;
  virtual ~Communicator();

  /** \brief The number of processes, at least 1. */
  virtual std::size_t
  size() const = 0;

  /** \brief The number of this process, below size(). */
  virtual std::size_t
  rank() const = 0;

  /** \brief Replace every number by its sum over all processes.
   * \param numbers as many on each process; become the sums */
  virtual void
  allReduce(std::vector<std::uint64_t>& numbers) = 0;

  /** \brief Send a message to each process.
   * \param messages one for each process, this one among them
   * \return what each process sent to this one */
  virtual std::vector<Bytes>
  allToAll(std::vector<Bytes>&& messages) = 0;

  /** \brief Wait until all processes have come here. */
  void
  barrier();

  /** \brief The message of every process.
   * \param message of this process */
  virtual std::vector<Bytes>
  allGather(const Bytes& message);

  /** \brief Form groups of processes, which then communicate by themselves until they
   * all have come back to this communicator. It must outlive the groups.
   * \param color of this process's group
   * \return the processes of that color, in the order of their ranks */
  virtual std::unique_ptr<Communicator>
  split(std::size_t color) = 0;
};

/** \brief A process alone. */
class PCL_UVOL_EXPORTS SelfCommunicator : public Communicator {
public:
  std::size_t
  size() const override
  {
    return 1;
  }
  std::size_t
  rank() const override
  {
    return 0;
  }
  void
  allReduce(std::vector<std::uint64_t>&) override
  {
  }
  std::vector<Bytes>
  allToAll(std::vector<Bytes>&& messages) override
  {
    return std::move(messages);
  }
  std::unique_ptr<Communicator>
  split(std::size_t) override
  {
    return std::make_unique<SelfCommunicator>();
  }
};

} // namespace pcl_uvol
