// SPDX-License-Identifier: BSD-3-Clause
#include "gl/tile_set.h"

#include <utility>

namespace pcl_uvol {

TileSet::TileSet(const PixelBox& pixels)
    : bounds_{pixels.left / tile,
              pixels.top / tile,
              (pixels.right + tile - 1) / tile,
              (pixels.bottom + tile - 1) / tile}
    , flags_(static_cast<std::size_t>(bounds_.width() * bounds_.height()), 1)
{
}

bool
TileSet::isEmpty() const
{
  return std::find(flags_.begin(), flags_.end(), 1) == flags_.end();
}

bool
TileSet::hasAny(const PixelBox& tiles) const
{
  for (int row = tiles.top; row < tiles.bottom; ++row)
    for (int column = tiles.left; column < tiles.right; ++column)
      if (flags_[indexOf(column, row)] != 0)
        return true;
  return false;
}

TileSet
TileSet::grown() const
{
  TileSet larger = *this;
  for (int row = bounds_.top; row < bounds_.bottom; ++row)
    for (int column = bounds_.left; column < bounds_.right; ++column) {
      const PixelBox around = PixelBox{column, row, column + 1, row + 1}.grownBy(1);
      larger.flags_[indexOf(column, row)] = hasAny(around.clippedTo(bounds_)) ? 1 : 0;
    }
  return larger;
}

void
TileSet::add(const TileSet& other)
{
  for (std::size_t i = 0; i < flags_.size(); ++i)
    flags_[i] |= other.flags_[i];
}

std::vector<PixelBox>
TileSet::runs(int row) const
{
  std::vector<PixelBox> runs;
  bool goes_on = false;
  for (int column = bounds_.left; column < bounds_.right; ++column) {
    const bool is_in = flags_[indexOf(column, row)] != 0;
    if (is_in && goes_on)
      ++runs.back().right;
    else if (is_in)
      runs.push_back({column, row, column + 1, row + 1});
    goes_on = is_in;
  }
  return runs;
}

std::vector<PixelBox>
TileSet::boxes() const
{
  std::vector<PixelBox> boxes, open; // those that end with the row above
  for (int row = bounds_.top; row < bounds_.bottom; ++row) {
    std::vector<PixelBox> here = runs(row);
    for (const PixelBox& above : open) {
      const auto same = std::find_if(here.begin(), here.end(), [&](const auto& run) {
        return run.left == above.left && run.right == above.right;
      });
      if (same != here.end())
        same->top = above.top;
      else
        boxes.push_back(above);
    }
    open = std::move(here);
  }
  boxes.insert(boxes.end(), open.begin(), open.end());
  return boxes;
}

} // namespace pcl_uvol
