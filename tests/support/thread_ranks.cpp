// SPDX-License-Identifier: BSD-3-Clause
#include "support/thread_ranks.h"

#include "distributed/byte_stream.h"

#include <algorithm>
#include <condition_variable>
#include <exception>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <thread>

namespace uvol_test {

namespace {

using pcl_uvol::Bytes;

/** What threads wait for, in whatever group. */
struct Bell {
  std::mutex mutex;
  std::condition_variable changed;
  bool is_left = false; ///< by a rank that failed
};

/** What all ranks of a group see: the messages of one exchange, from each to each. */
class Board {
public:
  Board(std::size_t count, Bell& bell)
      : bell_(bell)
      , count_(count)
      , messages_(count)
      , groups_(count)
  {
  }

  std::size_t
  size() const
  {
    return count_;
  }

  std::vector<Bytes>
  allToAll(std::size_t rank, std::vector<Bytes>&& messages)
  {
    messages_[rank] = std::move(messages);
    barrier();
    std::vector<Bytes> received;
    for (const auto& sent : messages_)
      received.push_back(sent.at(rank));
    barrier();
    return received;
  }

  /** \param ranks of this one's group, ascending */
  std::shared_ptr<Board>
  split(std::size_t rank, const std::vector<std::size_t>& ranks)
  {
    if (rank == ranks.front())
      groups_[rank] = std::make_shared<Board>(ranks.size(), bell_);
    barrier();
    auto group = groups_[ranks.front()];
    barrier();
    return group;
  }

private:
  void
  barrier()
  {
    std::unique_lock lock(bell_.mutex);
    const std::size_t round = round_;
    if (++waiting_ == count_) {
      waiting_ = 0;
      ++round_;
      bell_.changed.notify_all();
    }
    bell_.changed.wait(lock, [&] { return round_ != round || bell_.is_left; });
    if (round_ == round)
      throw std::runtime_error("Another rank failed.");
  }

  Bell& bell_;
  std::size_t count_;
  std::vector<std::vector<Bytes>> messages_;
  std::vector<std::shared_ptr<Board>> groups_; // by their first rank
  std::size_t waiting_ = 0, round_ = 0;
};

class ThreadCommunicator : public pcl_uvol::Communicator {
public:
  ThreadCommunicator(std::shared_ptr<Board> board, std::size_t rank)
      : board_(std::move(board))
      , rank_(rank)
  {
  }

  std::size_t
  size() const override
  {
    return board_->size();
  }
  std::size_t
  rank() const override
  {
    return rank_;
  }

  void
  allReduce(std::vector<std::uint64_t>& numbers) override
  {
    const auto* const first = reinterpret_cast<const std::uint8_t*>(numbers.data());
    const Bytes mine(first, first + numbers.size() * sizeof(std::uint64_t));
    std::fill(numbers.begin(), numbers.end(), 0u);
    for (const Bytes& bytes : allGather(mine)) {
      const auto* const other = reinterpret_cast<const std::uint64_t*>(bytes.data());
      for (std::size_t i = 0; i < numbers.size(); ++i)
        numbers[i] += other[i];
    }
  }

  std::vector<Bytes>
  allToAll(std::vector<Bytes>&& messages) override
  {
    return board_->allToAll(rank_, std::move(messages));
  }

  std::unique_ptr<pcl_uvol::Communicator>
  split(std::size_t color) override
  {
    const auto colors =
        pcl_uvol::allGatherItems(*this, std::vector<std::size_t>{color});
    std::vector<std::size_t> ranks;
    for (std::size_t rank = 0; rank < colors.size(); ++rank)
      if (colors[rank] == color)
        ranks.push_back(rank);
    const auto own = std::find(ranks.begin(), ranks.end(), rank_) - ranks.begin();
    return std::make_unique<ThreadCommunicator>(board_->split(rank_, ranks),
                                                static_cast<std::size_t>(own));
  }

private:
  std::shared_ptr<Board> board_;
  std::size_t rank_;
};

} // namespace

void
runRanks(std::size_t count, const std::function<void(pcl_uvol::Communicator&)>& body)
{
  Bell bell;
  const auto board = std::make_shared<Board>(count, bell);
  std::exception_ptr first;
  std::mutex mutex;
  std::vector<std::thread> threads;
  for (std::size_t rank = 0; rank < count; ++rank)
    threads.emplace_back([&, rank] {
      try {
        ThreadCommunicator communicator(board, rank);
        body(communicator);
      }
      catch (...) {
        {
          const std::lock_guard lock(mutex);
          first = first ? first : std::current_exception();
        }
        const std::lock_guard lock(bell.mutex);
        bell.is_left = true;
        bell.changed.notify_all();
      }
    });
  for (std::thread& thread : threads)
    thread.join();
  if (first)
    std::rethrow_exception(first);
}

} // namespace uvol_test
