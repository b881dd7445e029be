// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_uvol/mpi/mpi_communicator.h>

#include <vtkMPIController.h>
#include <vtkSmartPointer.h>

#include <algorithm>
#include <exception>
#include <numeric>
#include <string>
#include <utility>

namespace pcl_uvol {

namespace {

using Request = vtkMPICommunicator::Request;
using Number = unsigned long; // what VTK calls 64 bits without sign
static_assert(sizeof(Number) == sizeof(std::uint64_t));

constexpr int length_tag = 1, message_tag = 2;
/** Numbers that are added at once. */
constexpr std::size_t sum_block = 1u << 24;

void
check(int is_done)
{
  if (is_done == 0)
    throw Exception("mpi_exchange_failed", {});
}

/** Messages on their way. */
class Traffic {
public:
  explicit Traffic(vtkMPIController& controller)
      : controller_(controller)
  {
  }

  void
  reserve(std::size_t messages)
  {
    requests_.reserve(messages);
  }

  template <typename T>
  void
  send(const T* data, std::size_t count, std::size_t to, int tag)
  {
    requests_.emplace_back();
    check(controller_.NoBlockSend(
        data, static_cast<int>(count), static_cast<int>(to), tag, requests_.back()));
  }

  template <typename T>
  void
  receive(T* data, std::size_t count, std::size_t from, int tag)
  {
    requests_.emplace_back();
    check(controller_.NoBlockReceive(
        data, static_cast<int>(count), static_cast<int>(from), tag, requests_.back()));
  }

  void
  wait()
  {
    if (!requests_.empty())
      check(controller_.WaitAll(static_cast<int>(requests_.size()), requests_.data()));
  }

private:
  vtkMPIController& controller_;
  std::vector<Request> requests_;
};

/** Keeps the controller of a group for as long as the group. */
struct GroupController {
  vtkSmartPointer<vtkMPIController> controller;
};

class MpiGroup : private GroupController, public MpiCommunicator {
public:
  MpiGroup(vtkSmartPointer<vtkMPIController> group_controller,
           std::size_t largest_part,
           MpiCommunicator& parent)
      : GroupController{std::move(group_controller)}
      , MpiCommunicator(*controller, largest_part)
      , parent_(parent)
      , exceptions_(std::uncaught_exceptions())
  {
  }
  MpiGroup(const MpiGroup&) = delete;
  MpiGroup&
  operator=(const MpiGroup&) = delete;

  ~MpiGroup() override
  {
    if (std::uncaught_exceptions() == exceptions_)
      return;
    try {
      // One of the group speaks for it.
      parent_.agree(agree(true) == rank());
    }
    catch (const pcl::PCLException&) {
      // The connection is lost: nobody can be told.
    }
  }

private:
  MpiCommunicator& parent_;
  int exceptions_;
};

} // namespace

MpiCommunicator::MpiCommunicator(vtkMPIController& controller, std::size_t largest_part)
    : controller_(controller)
    , largest_part_(largest_part)
    , failed_(size())
{
}

std::size_t
MpiCommunicator::size() const
{
  return static_cast<std::size_t>(controller_.GetNumberOfProcesses());
}

std::size_t
MpiCommunicator::rank() const
{
  return static_cast<std::size_t>(controller_.GetLocalProcessId());
}

std::size_t
MpiCommunicator::agree(bool has_failed)
{
  if (failed_ < size())
    return failed_;
  const Number mine = has_failed ? rank() : size();
  Number first = mine;
  check(controller_.AllReduce(&mine, &first, 1, vtkCommunicator::MIN_OP));
  failed_ = first;
  return failed_;
}

void
MpiCommunicator::proceed()
{
  if (agree(false) < size())
    throw OtherRankFailed("other_rank_failed", {{"rank", failed_}});
}

void
MpiCommunicator::allReduce(std::vector<std::uint64_t>& numbers)
{
  std::vector<Number> sums(std::min(numbers.size(), sum_block));
  proceed();
  for (std::size_t begin = 0; begin < numbers.size(); begin += sum_block) {
    const std::size_t count = std::min(numbers.size() - begin, sum_block);
    check(controller_.AllReduce(&numbers[begin],
                                sums.data(),
                                static_cast<vtkIdType>(count),
                                vtkCommunicator::SUM_OP));
    std::copy_n(sums.begin(), count, &numbers[begin]);
  }
}

std::vector<Bytes>
MpiCommunicator::allToAll(std::vector<Bytes>&& messages)
{
  const std::vector<Bytes> sent = std::move(messages);
  std::vector<Number> sent_lengths(size()), lengths(size());
  Traffic announcements(controller_), parts(controller_);
  announcements.reserve(2 * size());
  proceed();
  for (std::size_t other = 0; other < size(); ++other) {
    announcements.receive(&lengths[other], 1, other, length_tag);
    sent_lengths[other] = sent[other].size();
    announcements.send(&sent_lengths[other], 1, other, length_tag);
  }
  announcements.wait();

  std::vector<Bytes> received(size());
  std::size_t count = 0;
  for (std::size_t other = 0; other < size(); ++other) {
    received[other].resize(lengths[other]);
    count += lengths[other] / largest_part_ + sent[other].size() / largest_part_ + 2;
  }
  parts.reserve(count);
  proceed(); // all have the memory for it
  // Parts of one message arrive in the order in which they were sent.
  for (std::size_t other = 0; other < size(); ++other)
    for (std::size_t at = 0; at < received[other].size(); at += largest_part_)
      parts.receive(&received[other][at],
                    std::min(largest_part_, received[other].size() - at),
                    other,
                    message_tag);
  for (std::size_t other = 0; other < size(); ++other)
    for (std::size_t at = 0; at < sent[other].size(); at += largest_part_)
      parts.send(&sent[other][at],
                 std::min(largest_part_, sent[other].size() - at),
                 other,
                 message_tag);
  parts.wait();
  return received;
}

std::vector<Bytes>
MpiCommunicator::allGather(const Bytes& message)
{
  std::vector<vtkIdType> lengths(size()), offsets(size());
  proceed();
  const auto length = static_cast<vtkIdType>(message.size());
  check(controller_.AllGather(&length, lengths.data(), 1));
  std::exclusive_scan(lengths.begin(), lengths.end(), offsets.begin(), vtkIdType(0));
  const auto total = static_cast<std::size_t>(offsets.back() + lengths.back());
  if (total > largest_part_) // MPI counts all of them together by int
    return Communicator::allGather(message);
  Bytes all(std::max<std::size_t>(total, 1));
  std::vector<Bytes> received(size());
  proceed();
  check(controller_.AllGatherV(
      message.data(), all.data(), length, lengths.data(), offsets.data()));
  for (std::size_t rank = 0; rank < size(); ++rank) {
    const auto first = all.begin() + offsets[rank];
    received[rank].assign(first, first + lengths[rank]);
  }
  return received;
}

std::unique_ptr<Communicator>
MpiCommunicator::split(std::size_t color)
{
  proceed();
  const auto group =
      vtkSmartPointer<vtkMPIController>::Take(controller_.PartitionController(
          static_cast<int>(color), static_cast<int>(rank())));
  if (!group)
    throw Exception("mpi_group_failed", {});
  return std::make_unique<MpiGroup>(group, largest_part_, *this);
}

} // namespace pcl_uvol
