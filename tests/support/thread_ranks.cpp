// SPDX-License-Identifier: BSD-3-Clause
#include "support/thread_ranks.h"

#include <algorithm>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <stdexcept>
#include <thread>

namespace uvol_test {

namespace {

using pcl_uvol::Bytes;

/** What all ranks see: the messages of one exchange, from each to each. */
class Board {
public:
  explicit Board(std::size_t count)
      : count_(count)
      , messages_(count)
  {
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

  void
  leave()
  {
    const std::lock_guard lock(mutex_);
    is_left_ = true;
    changed_.notify_all();
  }

private:
  void
  barrier()
  {
    std::unique_lock lock(mutex_);
    const std::size_t round = round_;
    if (++waiting_ == count_) {
      waiting_ = 0;
      ++round_;
      changed_.notify_all();
    }
    changed_.wait(lock, [&] { return round_ != round || is_left_; });
    if (round_ == round)
      throw std::runtime_error("Another rank failed.");
  }

  std::size_t count_;
  std::vector<std::vector<Bytes>> messages_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::size_t waiting_ = 0, round_ = 0;
  bool is_left_ = false;
};

class ThreadCommunicator : public pcl_uvol::Communicator {
public:
  ThreadCommunicator(Board& board, std::size_t rank, std::size_t count)
      : board_(board)
      , rank_(rank)
      , count_(count)
  {
  }

  std::size_t
  size() const override
  {
    return count_;
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
    return board_.allToAll(rank_, std::move(messages));
  }

private:
  Board& board_;
  std::size_t rank_, count_;
};

} // namespace

void
runRanks(std::size_t count, const std::function<void(pcl_uvol::Communicator&)>& body)
{
  Board board(count);
  std::exception_ptr first;
  std::mutex mutex;
  std::vector<std::thread> threads;
  for (std::size_t rank = 0; rank < count; ++rank)
    threads.emplace_back([&, rank] {
      try {
        ThreadCommunicator group(board, rank, count);
        body(group);
      }
      catch (...) {
        {
          const std::lock_guard lock(mutex);
          first = first ? first : std::current_exception();
        }
        board.leave();
      }
    });
  for (std::thread& thread : threads)
    thread.join();
  if (first)
    std::rethrow_exception(first);
}

} // namespace uvol_test
