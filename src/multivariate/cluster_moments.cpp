// SPDX-License-Identifier: BSD-3-Clause
#include "multivariate/cluster_moments.h"

#include "common/parallel.h"
#include <pcl_uvol/common/exceptions.h>

#include <algorithm>
#include <functional>
#include <string>

namespace pcl_uvol {

namespace {

/** Rows that are summed up at a time, and of these, rows that stay in the cache. */
constexpr std::size_t block_rows = 1u << 12, chunk_rows = 64;

using Eigen::MatrixXd;
using Eigen::VectorXd;
using Index = Eigen::Index;

/** Rows of an index list, first the mean so that large offsets lose no digits. */
Moments
computeMoments(const AttributeTable& table,
               const std::uint32_t* rows,
               std::size_t count)
{
  const auto m = static_cast<Index>(table.columns());
  const auto row = [&](std::size_t i) {
    return Eigen::Map<const Eigen::VectorXf>(table.row(rows[i]), m).cast<double>();
  };
  Moments moments{static_cast<double>(count), VectorXd::Zero(m), MatrixXd::Zero(m, m)};
  for (std::size_t i = 0; i < count; ++i)
    moments.mean += row(i);
  moments.mean /= moments.count;
  MatrixXd chunk(m, static_cast<Index>(chunk_rows));
  for (std::size_t begin = 0; begin < count; begin += chunk_rows) {
    const std::size_t size = std::min(chunk_rows, count - begin);
    chunk.setZero();
    for (std::size_t i = 0; i < size; ++i)
      chunk.col(static_cast<Index>(i)) = row(begin + i) - moments.mean;
    for (Index k = 0; k < m; ++k)
      moments.scatter.col(k).head(k + 1).noalias() +=
          chunk.topRows(k + 1) * chunk.row(k).transpose();
  }
  return moments;
}

void
checkSizes(const AttributeTable& table, const std::vector<std::int32_t>& labels)
{
  if (table.rows() == 0 || table.columns() == 0)
    throw InvalidArgument("empty_attribute_table",
                          {{"rows", table.rows()}, {"attributes", table.columns()}});
  if (table.values.size() != table.rows() * table.columns())
    throw InvalidArgument("unfitting_attribute_table",
                          {{"rows", table.rows()},
                           {"attributes", table.columns()},
                           {"values", table.values.size()}});
  if (labels.size() != table.rows())
    throw InvalidArgument("unfitting_cluster_labels",
                          {{"labels", labels.size()}, {"rows", table.rows()}});
}

/** Rows of the noise, and then of the clusters by label. */
std::vector<std::vector<std::uint32_t>>
membersPerCluster(const std::vector<std::int32_t>& labels, unsigned threads)
{
  std::vector<std::int32_t> names(labels);
  names.push_back(-1);
  for (auto& name : names)
    name = std::max(name, -1);
  parallelSort(names.begin(), names.end(), threads, std::less<>());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  std::vector<std::vector<std::uint32_t>> members(names.size());
  for (std::uint32_t row = 0; row < labels.size(); ++row) {
    const auto name =
        std::lower_bound(names.begin(), names.end(), std::max(labels[row], -1));
    members[static_cast<std::size_t>(name - names.begin())].push_back(row);
  }
  return members;
}

} // namespace

Eigen::MatrixXd
Moments::covariance() const
{
  return Eigen::MatrixXd(scatter.selfadjointView<Eigen::Upper>()) / count;
}

void
Moments::join(const Moments& other)
{
  if (other.count == 0.0)
    return;
  if (count == 0.0) {
    *this = other;
    return;
  }
  // Chan, Golub, LeVeque 1979.
  const VectorXd offset = other.mean - mean;
  const double both = count + other.count;
  scatter += other.scatter;
  scatter += (count * other.count / both) * (offset * offset.transpose());
  mean += offset * (other.count / both);
  count = both;
}

std::vector<Moments>
momentsPerCluster(const AttributeTable& table,
                  const std::vector<std::int32_t>& labels,
                  unsigned threads)
{
  checkSizes(table, labels);
  const auto members = membersPerCluster(labels, threads);
  struct Piece {
    std::size_t cluster, begin;
  };
  std::vector<Piece> pieces;
  for (std::size_t cluster = 0; cluster < members.size(); ++cluster)
    for (std::size_t begin = 0; begin < members[cluster].size(); begin += block_rows)
      pieces.push_back({cluster, begin});
  std::vector<Moments> parts(pieces.size());
  parallelBlocks(pieces.size(), 1, threads, [&](std::size_t p, std::size_t) {
    const auto& rows = members[pieces[p].cluster];
    parts[p] = computeMoments(table,
                              &rows[pieces[p].begin],
                              std::min(block_rows, rows.size() - pieces[p].begin));
  });
  std::vector<Moments> moments(members.size());
  for (std::size_t p = 0; p < pieces.size(); ++p)
    moments[pieces[p].cluster].join(parts[p]);
  return moments;
}

} // namespace pcl_uvol
