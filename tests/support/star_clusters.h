// SPDX-License-Identifier: BSD-3-Clause
// Attribute tables of clusters that are known: normal distributions in 4 to 10
// dimensions; and what tests of projections ask of them.
#pragma once

#include "multivariate/attributes.h"
#include "multivariate/projections.h"
#include "support/matrices.h"

#include <Eigen/Core>

#include <cstdint>
#include <string>
#include <vector>

namespace uvol_test {

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
           const MatrixXd& root);

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

VectorXd
unit(Index size, Index axis, double length);

/** \brief Four dimensions, four round clusters in corners. */
LabelledTable
makeRound();

/** \brief Three dimensions of large noise take all principal axes. */
LabelledTable
makeNoisy();

/** \brief Long clusters, side by side, in eight dimensions that a rotation mixes. */
LabelledTable
makeLong();

/** \brief Sizes from 20 to 20,000, and noise around. */
LabelledTable
makeUneven();

/** \brief Twelve clusters in ten dimensions: three axes cannot have them all far apart.
 */
LabelledTable
makeMany();

const std::vector<LabelledTable>&
allPlanted();

pcl_uvol::Projection
optimize(const LabelledTable& planted);

double
ratioIn(const LabelledTable& planted, const pcl_uvol::Projection& projection);

MatrixXd
axesOf(const pcl_uvol::Projection& projection);

/** \brief All equal in bytes. */
void
expectSame(const pcl_uvol::Projection& a, const pcl_uvol::Projection& b);

/** \brief The first rows orthonormal, the rest 0. */
void
expectOrthonormal(const pcl_uvol::Projection& projection, Index rank);

} // namespace uvol_test
