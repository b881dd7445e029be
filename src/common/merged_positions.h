// SPDX-License-Identifier: BSD-3-Clause
// Positions in double that fall together once they are rounded to float.
#pragma once

#include <pcl_uvol/common/message.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>

namespace pcl_uvol {

/** \brief Points that rounding has merged with others of another position. */
struct MergedPositions {
  std::uint64_t count = 0; ///< distinct positions, less those that are left of them; of
                           ///< more than 65,536, and a sixteenth of the points, some
  double distance = 0.0;   ///< the largest between two that have become one
};

/** \brief Find them. Takes some bytes per point while it looks.
 * \param position_at an index below count; positions that are not finite do not count
 * \param origin that is subtracted before positions are rounded */
MergedPositions
findMergedPositions(
    std::size_t count,
    const std::function<std::array<double, 3>(std::size_t)>& position_at,
    const std::array<double, 3>& origin);

/** \brief A message about them; none if there are none. */
std::optional<Message>
describe(const MergedPositions& merged);

} // namespace pcl_uvol
