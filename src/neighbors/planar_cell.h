// SPDX-License-Identifier: BSD-3-Clause
// The cell of a point among others in a plane.
#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl_uvol::detail {

/** \brief The Voronoi cell of a point among its neighbours in a plane, around the
 * origin. */
class PlanarCell {
public:
  /** \brief A square of twice that side. */
  void
  reset(float distance)
  {
    corners_ = {{{-distance, -distance}, border},
                {{distance, -distance}, border},
                {{distance, distance}, border},
                {{-distance, distance}, border}};
    sq_extent_ = 2.0f * distance * distance;
  }

  /** \brief Squared distance of the farthest corner. */
  float
  sqExtent() const
  {
    return sq_extent_;
  }

  /** \brief Cut off what is nearer to a neighbour.
   * \param index of it, not that of the border */
  void
  cut(const Eigen::Vector2f& neighbor, std::uint32_t index)
  {
    const float limit = 0.5f * neighbor.squaredNorm();
    const auto beyond = [&](const Corner& corner) {
      return corner.position.dot(neighbor) - limit;
    };
    if (std::none_of(corners_.begin(), corners_.end(), [&](const Corner& corner) {
          return beyond(corner) > 0.0f;
        }))
      return;
    kept_.clear();
    for (std::size_t i = 0; i < corners_.size(); ++i) {
      const Corner& here = corners_[i];
      const Corner& next = corners_[i + 1 < corners_.size() ? i + 1 : 0];
      const float a = beyond(here), b = beyond(next);
      if (a <= 0.0f)
        kept_.push_back(here);
      if ((a <= 0.0f) != (b <= 0.0f)) {
        const Eigen::Vector2f crossing =
            here.position + a / (a - b) * (next.position - here.position);
        // Leaving, the cut goes on from there; coming back, the old edge does.
        kept_.push_back({crossing, a > 0.0f ? here.edge : index});
      }
    }
    corners_.swap(kept_);
    sq_extent_ = 0.0f;
    for (const Corner& corner : corners_)
      sq_extent_ = std::max(sq_extent_, corner.position.squaredNorm());
  }

  /** \brief Call visit(corner, before, next), counter-clockwise, for all corners but
   * those on the border, with the indices of the two neighbours that meet there. */
  template <typename Visit>
  void
  forCorners(const Visit& visit) const
  {
    for (std::size_t i = 0; i < corners_.size(); ++i) {
      const Corner& before = corners_[(i + corners_.size() - 1) % corners_.size()];
      if (before.edge != border && corners_[i].edge != border)
        visit(corners_[i].position, before.edge, corners_[i].edge);
    }
  }

  /** \brief True if a condition holds for all neighbours that cut it. */
  template <typename Condition>
  bool
  allNeighbors(const Condition& condition) const
  {
    return std::all_of(corners_.begin(), corners_.end(), [&](const Corner& corner) {
      return condition(corner.edge);
    });
  }

  bool
  isBounded() const
  {
    return std::none_of(corners_.begin(), corners_.end(), [](const Corner& corner) {
      return corner.edge == border;
    });
  }

private:
  static constexpr std::uint32_t border = 0xffffffff;

  struct Corner {
    Eigen::Vector2f position;
    std::uint32_t edge; ///< to the next corner: index of a neighbour, or the square's
  };

  std::vector<Corner> corners_, kept_;
  float sq_extent_ = 0.0f;
};

} // namespace pcl_uvol::detail
