// SPDX-License-Identifier: BSD-3-Clause
// Where in an image there is something to do.
#pragma once

#include "render/image_space/pixel_box.h"

#include <cstdint>
#include <vector>

namespace pcl_uvol {

/** \brief Some of the square tiles of a part of an image. A pixel that depends on its
 * eight neighbours can change only if one of these, or itself, has changed before: so
 * an iteration goes on in tiles with a change in them or beside them. */
class TileSet {
public:
  /** Pixels along the side of a tile: small ones keep fewer idle pixels, large ones are
   * fewer to look after. */
  static constexpr int tile = 8;

  /** \brief None. */
  TileSet() = default;

  /** \brief All tiles that a box of pixels touches. */
  explicit TileSet(const PixelBox& pixels);

  /** \brief The tiles that the box of pixels touches, in units of tiles. */
  const PixelBox&
  getBounds() const
  {
    return bounds_;
  }

  /** \brief For every tile of the bounds, row by row, 1 if it is one of the set. */
  std::vector<std::uint8_t>&
  flags()
  {
    return flags_;
  }

  bool
  isEmpty() const;

  /** \brief These tiles and their neighbours. */
  TileSet
  grown() const;

  /** \brief Add the tiles of a set with the same bounds. */
  void
  add(const TileSet& other);

  /** \brief Disjoint boxes of tiles, in units of tiles. */
  std::vector<PixelBox>
  boxes() const;

private:
  /** Tiles of a row that lie side by side. */
  std::vector<PixelBox>
  runs(int row) const;

  bool
  hasAny(const PixelBox& tiles) const;

  std::size_t
  indexOf(int column, int row) const
  {
    return static_cast<std::size_t>((row - bounds_.top) * bounds_.width() + column -
                                    bounds_.left);
  }

  PixelBox bounds_{0, 0, 0, 0};
  std::vector<std::uint8_t> flags_;
};

} // namespace pcl_uvol
