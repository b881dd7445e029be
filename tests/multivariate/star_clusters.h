// SPDX-License-Identifier: BSD-3-Clause
// Attribute tables of clusters that are known: normal distributions in 4 to 10
// dimensions; and what tests of projections ask of them.
#pragma once

#include "common/random.h"
#include "multivariate/attributes.h"
#include "multivariate/projections.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

namespace uvol_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using Index = Eigen::Index;

/** \brief Rows, and the cluster of each. */
struct LabelledTable {
  const char* name;
  pcl_uvol::AttributeTable table;
  std::vector<std::int32_t> labels;
};

/** \brief Makes rows of normal distributions. */
class Planter {
public:
  Planter(const char* name, std::size_t columns)
  {
    planted_.name = name;
    for (std::size_t i = 0; i < columns; ++i)
      planted_.table.names.push_back("a" + std::to_string(i));
  }

  /** \brief Rows that are the mean and root times normal numbers. */
  Planter&
  addMixed(std::int32_t label,
           std::size_t count,
           const VectorXd& mean,
           const MatrixXd& root)
  {
    for (std::size_t k = 0; k < count; ++k) {
      const auto row = static_cast<std::uint32_t>(planted_.labels.size());
      VectorXd value(mean.size());
      for (Index i = 0; i < mean.size(); ++i)
        value[i] = pcl_uvol::normalAt(7, row, static_cast<std::uint64_t>(i));
      value = (mean + root * value).eval();
      for (const double v : value)
        planted_.table.values.push_back(static_cast<float>(v));
      planted_.table.points.push_back(row);
      planted_.labels.push_back(label);
    }
    return *this;
  }

  /** \brief The same for attributes that do not depend on each other. */
  Planter&
  add(std::int32_t label,
      std::size_t count,
      const VectorXd& mean,
      const VectorXd& deviations)
  {
    return addMixed(label, count, mean, deviations.asDiagonal());
  }

  const LabelledTable&
  get() const
  {
    return planted_;
  }

private:
  LabelledTable planted_;
};

inline VectorXd
unit(Index size, Index axis, double length)
{
  return VectorXd::Unit(size, axis) * length;
}

/** \brief A rotation that mixes all attributes. */
inline MatrixXd
mixing(Index size)
{
  MatrixXd numbers(size, size);
  for (Index i = 0; i < size; ++i)
    for (Index j = 0; j < size; ++j)
      numbers(i, j) =
          pcl_uvol::normalAt(11, static_cast<std::uint64_t>(i * size + j), 0);
  return Eigen::HouseholderQR<MatrixXd>(numbers).householderQ();
}

/** \brief Four dimensions, four round clusters in corners. */
inline LabelledTable
makeRound()
{
  Planter planter("round", 4);
  for (Index c = 0; c < 4; ++c)
    planter.add(static_cast<std::int32_t>(c), 400, unit(4, c, 6.0), VectorXd::Ones(4));
  return planter.get();
}

/** \brief Three dimensions of large noise take all principal axes. */
inline LabelledTable
makeNoisy()
{
  VectorXd deviations = VectorXd::Ones(6);
  deviations.tail(3).setConstant(20.0);
  Planter planter("noisy", 6);
  planter.add(0, 500, VectorXd::Zero(6), deviations);
  for (Index c = 0; c < 3; ++c)
    planter.add(static_cast<std::int32_t>(c) + 1, 500, unit(6, c, 5.0), deviations);
  return planter.get();
}

/** \brief Long clusters, side by side, in eight dimensions that a rotation mixes. */
inline LabelledTable
makeLong()
{
  const MatrixXd rotation = mixing(8);
  Planter planter("long", 8);
  for (Index c = 0; c < 5; ++c) {
    VectorXd deviations = VectorXd::Constant(8, 0.5);
    deviations[5 + c % 3] = 15.0;
    planter.addMixed(static_cast<std::int32_t>(10 * c),
                     600,
                     rotation * unit(8, c, 4.0),
                     rotation * deviations.asDiagonal());
  }
  return planter.get();
}

/** \brief Sizes from 20 to 20,000, and noise around. */
inline LabelledTable
makeUneven()
{
  Planter planter("uneven", 5);
  VectorXd deviations(5);
  deviations << 1.0, 0.2, 3.0, 1.0, 8.0;
  std::size_t count = 20;
  for (Index c = 0; c < 4; ++c, count *= 10)
    planter.add(static_cast<std::int32_t>(c), count, unit(5, c, 4.0), deviations);
  planter.add(-1, 1000, VectorXd::Zero(5), VectorXd::Constant(5, 10.0));
  return planter.get();
}

/** \brief Twelve clusters in ten dimensions: three axes cannot have them all far apart.
 */
inline LabelledTable
makeMany()
{
  Planter planter("many", 10);
  for (Index c = 0; c < 12; ++c) {
    VectorXd mean(10), deviations(10);
    for (Index i = 0; i < 10; ++i) {
      const auto number = static_cast<std::uint64_t>(c * 10 + i);
      mean[i] = 6.0 * pcl_uvol::normalAt(3, number, 0);
      deviations[i] = 0.3 + pcl_uvol::uniformAt(5, number, 0);
    }
    deviations[c % 10] *= 4.0;
    planter.add(static_cast<std::int32_t>(c), 200, mean, deviations);
  }
  return planter.get();
}

inline const std::vector<LabelledTable>&
allPlanted()
{
  static const std::vector<LabelledTable> all = {
      makeRound(), makeNoisy(), makeLong(), makeUneven(), makeMany()};
  return all;
}

inline pcl_uvol::Projection
optimize(const LabelledTable& planted)
{
  pcl_uvol::Report report;
  return pcl_uvol::starCoordinates(
      planted.table, planted.labels, pcl_uvol::StarCoordinateParameters(), 0, report);
}

inline double
ratioIn(const LabelledTable& planted, const pcl_uvol::Projection& projection)
{
  return pcl_uvol::smallestFisherRatio(planted.table, planted.labels, projection);
}

inline MatrixXd
axesOf(const pcl_uvol::Projection& projection)
{
  MatrixXd axes(3, static_cast<Index>(projection.names.size()));
  for (Index k = 0; k < 3; ++k)
    axes.row(k) = Eigen::Map<const Eigen::RowVectorXd>(
        projection.rows[static_cast<std::size_t>(k)].data(), axes.cols());
  return axes;
}

/** \brief All equal in bytes. */
inline void
expectSame(const pcl_uvol::Projection& a, const pcl_uvol::Projection& b)
{
  EXPECT_EQ(a.names, b.names);
  EXPECT_EQ(a.mean, b.mean);
  EXPECT_EQ(a.rows, b.rows);
}

/** \brief The first rows orthonormal, the rest 0. */
inline void
expectOrthonormal(const pcl_uvol::Projection& projection, Index rank)
{
  const MatrixXd axes = axesOf(projection);
  MatrixXd expected = MatrixXd::Zero(3, 3);
  expected.topLeftCorner(rank, rank).setIdentity();
  EXPECT_LT((axes * axes.transpose() - expected).cwiseAbs().maxCoeff(), 1e-12);
}

} // namespace uvol_test
