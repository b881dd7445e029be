// SPDX-License-Identifier: BSD-3-Clause
#include "distributed/fetch_points.h"

#include "distributed/byte_stream.h"
#include <pcl_uvol/common/exceptions.h>

#include <algorithm>
#include <string>
#include <utility>

namespace pcl_uvol {

namespace {

/** Send messages to all processes, and count what leaves this one. */
std::vector<Bytes>
send(std::vector<Bytes>&& messages, Communicator& communicator, Report& report)
{
  for (std::size_t rank = 0; rank < messages.size(); ++rank)
    if (rank != communicator.rank())
      report.count("bytes_of_fields", messages[rank].size());
  return communicator.allToAll(std::move(messages));
}

/** What those who asked for points get. */
std::vector<Bytes>
answer(const std::vector<Bytes>& questions,
       const pcl::PCLPointCloud2& points,
       std::uint64_t first)
{
  const std::size_t count = std::size_t(points.width) * points.height;
  std::vector<Bytes> answers(questions.size());
  for (std::size_t rank = 0; rank < questions.size(); ++rank) {
    std::vector<std::uint64_t> indices;
    ByteReader(questions[rank]).get(indices);
    answers[rank].reserve(indices.size() * points.point_step);
    for (const std::uint64_t index : indices) {
      if (index < first || index - first >= count)
        throw InvalidArgument("point_of_no_rank", {{"point", index}});
      const auto point =
          points.data.begin() +
          static_cast<std::ptrdiff_t>((index - first) * std::size_t(points.point_step));
      answers[rank].insert(
          answers[rank].end(), point, point + static_cast<int>(points.point_step));
    }
  }
  return answers;
}

} // namespace

std::vector<std::uint64_t>
findFirstIndices(std::uint64_t count, Communicator& communicator)
{
  std::vector<std::uint64_t> firsts{0};
  for (const std::uint64_t other :
       allGatherItems(communicator, std::vector<std::uint64_t>{count}))
    firsts.push_back(firsts.back() + other);
  return firsts;
}

pcl::PCLPointCloud2
fetchPoints(const pcl::PCLPointCloud2& points,
            std::uint64_t first,
            const std::vector<std::uint64_t>& wanted,
            Communicator& communicator,
            Report& report)
{
  const auto firsts = allGatherItems(communicator, std::vector<std::uint64_t>{first});
  std::vector<Bytes> questions(communicator.size());
  for (std::size_t rank = 0; rank < firsts.size(); ++rank) {
    const auto begin = std::lower_bound(wanted.begin(), wanted.end(), firsts[rank]);
    const auto end = rank + 1 < firsts.size()
                         ? std::lower_bound(begin, wanted.end(), firsts[rank + 1])
                         : wanted.end();
    ByteWriter(questions[rank]).put(std::vector<std::uint64_t>(begin, end));
  }
  const auto asked = send(std::move(questions), communicator, report);

  pcl::PCLPointCloud2 fetched;
  fetched.fields = points.fields;
  fetched.point_step = points.point_step;
  fetched.is_bigendian = points.is_bigendian;
  fetched.height = 1;
  fetched.width = static_cast<pcl::uindex_t>(wanted.size());
  fetched.row_step = fetched.width * fetched.point_step;
  fetched.data.reserve(wanted.size() * points.point_step);
  for (const Bytes& bytes :
       send(answer(asked, points, first), communicator, report)) // ascending as wanted
    fetched.data.insert(fetched.data.end(), bytes.begin(), bytes.end());
  return fetched;
}

} // namespace pcl_uvol
