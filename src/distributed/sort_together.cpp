// SPDX-License-Identifier: BSD-3-Clause
#include "distributed/sort_together.h"

#include "common/parallel.h"
#include "distributed/byte_stream.h"

#include <algorithm>
#include <functional>
#include <utility>

namespace pcl_uvol {
namespace {

/** Where the share of each process begins, but for the first one. */
std::vector<double>
chooseBorders(const std::vector<double>& numbers, Communicator& communicator)
{
  const std::size_t ranks = communicator.size();
  std::vector<double> some;
  for (std::size_t i = 0; i < ranks && !numbers.empty(); ++i)
    some.push_back(numbers[numbers.size() * i / ranks]);
  some = allGatherItems(communicator, some);
  std::sort(some.begin(), some.end());
  std::vector<double> borders;
  for (std::size_t rank = 1; rank < ranks && !some.empty(); ++rank)
    borders.push_back(some[some.size() * rank / ranks]);
  return borders;
}

} // namespace

std::vector<double>
sortTogether(const std::vector<double>& numbers,
             Communicator& communicator,
             unsigned threads)
{
  const std::vector<double> borders = chooseBorders(numbers, communicator);
  std::vector<Bytes> messages(communicator.size());
  auto begin = numbers.begin();
  for (std::size_t rank = 0; rank < messages.size(); ++rank) {
    const auto end = rank < borders.size()
                         ? std::lower_bound(begin, numbers.end(), borders[rank])
                         : numbers.end();
    ByteWriter(messages[rank]).put(std::vector<double>(begin, end));
    begin = end;
  }
  std::vector<double> share;
  for (const Bytes& bytes : communicator.allToAll(std::move(messages)))
    ByteReader(bytes).get(share);
  parallelSort(share.begin(), share.end(), threads, std::less<>());
  return share;
}

} // namespace pcl_uvol
