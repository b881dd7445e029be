// SPDX-License-Identifier: BSD-3-Clause
// The gaps between coordinates on an axis that repeats, and the one to cut a box at.
#pragma once

#include "neighbors/periodic_box.h"
#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/common/export.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl_uvol {

/** \brief A coordinate, what is free in front of it, and how many samples have it. */
struct Gap {
  double width;
  std::uint64_t samples;
  double place; ///< the coordinate
};

/** \brief So many gaps tell which of equally wide ones is chosen. The planes of a
 * lattice are no more, as a rule; coordinates at random part at the first ones. */
inline constexpr std::size_t most_compared = 256;

/** \brief Finite coordinates of samples along an axis, moved into a box, ascending. */
PCL_UVOL_EXPORTS std::vector<double>
sortPlaces(const CloudView& cloud,
           const PeriodicBox& box,
           std::size_t axis,
           unsigned threads);

/** \param places ascending, at least one
 *
 * \param first what is free in front of the first one
 *
 * \return one gap for each coordinate */
PCL_UVOL_EXPORTS std::vector<Gap>
listGaps(const std::vector<double>& places, double first);

/** \brief Whether gaps are wider than others: at the first difference the gap is, or
 * its coordinate has fewer samples, so that the next gap comes sooner. */
PCL_UVOL_EXPORTS bool
areWider(const Gap* gaps, const Gap* others, std::size_t count);

/** \brief The widest gap; of equal ones that whose next gaps are wider, then the first.
 *
 * \param gaps in their order; behind those to choose from there are as many more as are
 * compared
 *
 * \param count of gaps to choose from, at least 1
 *
 * \param compared gaps of each */
PCL_UVOL_EXPORTS std::size_t
findWidestGap(const std::vector<Gap>& gaps, std::size_t count, std::size_t compared);

} // namespace pcl_uvol
