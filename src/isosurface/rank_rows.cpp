// SPDX-License-Identifier: BSD-3-Clause
#include "../common/byte_stream.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/isosurface/rank_rows.h>

#include <algorithm>
#include <limits>
#include <string>

namespace pcl_uvol {

namespace {

/** Ascending, each once. */
std::vector<std::uint64_t>
rowsOf(const std::vector<std::vector<GlobalIsopoint>>& isopoints)
{
  std::vector<std::uint64_t> rows;
  for (const auto& part : isopoints)
    for (const GlobalIsopoint& isopoint : part) {
      rows.push_back(isopoint.first);
      rows.push_back(isopoint.second);
    }
  std::sort(rows.begin(), rows.end());
  rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
  if (rows.size() > std::numeric_limits<std::uint32_t>::max())
    throw InvalidArgument("The isopoints lie between " + std::to_string(rows.size()) +
                          " points, more than one process can number.");
  return rows;
}

/** Exchange, and count what leaves this process. */
std::vector<Bytes>
exchange(std::vector<Bytes>&& messages, RankGroup& ranks, Report& report)
{
  for (std::size_t rank = 0; rank < messages.size(); ++rank)
    if (rank != ranks.rank())
      report.count("bytes_of_fields", messages[rank].size());
  return ranks.exchange(std::move(messages));
}

/** What those who asked for points get. */
std::vector<Bytes>
answer(const std::vector<Bytes>& questions,
       const pcl::PCLPointCloud2& points,
       std::uint64_t first_row)
{
  const std::size_t count = std::size_t(points.width) * points.height;
  std::vector<Bytes> answers(questions.size());
  for (std::size_t rank = 0; rank < questions.size(); ++rank) {
    std::vector<std::uint64_t> rows;
    ByteReader(questions[rank]).get(rows);
    answers[rank].reserve(rows.size() * points.point_step);
    for (const std::uint64_t row : rows) {
      if (row < first_row || row - first_row >= count)
        throw InvalidArgument("No process has the point " + std::to_string(row) + ".");
      const auto point =
          points.data.begin() + static_cast<std::ptrdiff_t>(
                                    (row - first_row) * std::size_t(points.point_step));
      answers[rank].insert(
          answers[rank].end(), point, point + static_cast<int>(points.point_step));
    }
  }
  return answers;
}

} // namespace

std::uint64_t
findFirstRow(std::uint64_t count, RankGroup& ranks)
{
  const auto counts = gatherItems(ranks, std::vector<std::uint64_t>{count});
  std::uint64_t first = 0;
  for (std::size_t rank = 0; rank < ranks.rank(); ++rank)
    first += counts[rank];
  return first;
}

RankRows
fetchRows(const pcl::PCLPointCloud2& points,
          std::uint64_t first_row,
          const std::vector<std::vector<GlobalIsopoint>>& isopoints,
          RankGroup& ranks,
          Report& report)
{
  const auto firsts = gatherItems(ranks, std::vector<std::uint64_t>{first_row});
  const std::vector<std::uint64_t> rows = rowsOf(isopoints);
  std::vector<Bytes> questions(ranks.size());
  for (std::size_t rank = 0; rank < firsts.size(); ++rank) {
    const auto begin = std::lower_bound(rows.begin(), rows.end(), firsts[rank]);
    const auto end = rank + 1 < firsts.size()
                         ? std::lower_bound(begin, rows.end(), firsts[rank + 1])
                         : rows.end();
    ByteWriter(questions[rank]).put(std::vector<std::uint64_t>(begin, end));
  }
  const auto asked = exchange(std::move(questions), ranks, report);

  RankRows fetched;
  fetched.cloud.fields = points.fields;
  fetched.cloud.point_step = points.point_step;
  fetched.cloud.is_bigendian = points.is_bigendian;
  fetched.cloud.height = 1;
  fetched.cloud.width = static_cast<pcl::uindex_t>(rows.size());
  fetched.cloud.row_step = fetched.cloud.width * fetched.cloud.point_step;
  auto& data = fetched.cloud.data;
  data.reserve(rows.size() * points.point_step);
  for (const Bytes& bytes :
       exchange(answer(asked, points, first_row), ranks, report)) // ascending as rows
    data.insert(data.end(), bytes.begin(), bytes.end());
  const auto indexOf = [&](std::uint64_t row) {
    return static_cast<std::uint32_t>(std::lower_bound(rows.begin(), rows.end(), row) -
                                      rows.begin());
  };
  for (const auto& part : isopoints)
    for (const GlobalIsopoint& isopoint : part)
      fetched.edges.push_back(
          {indexOf(isopoint.first), indexOf(isopoint.second), isopoint.t});
  return fetched;
}

} // namespace pcl_uvol
