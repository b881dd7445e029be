// SPDX-License-Identifier: BSD-3-Clause
#include "gl/picture_tiles.h"

#include "render/image_space/occlusion_grid.h"
#include "render/lighting.h"

#include <algorithm>

namespace pcl_uvol {

namespace {

/** Drawn boxes begin at multiples of this, which cells of occlusion divide. */
constexpr int grain = 64;

/** Pixels that discs, lines and smoothing look around a pixel. */
constexpr int filter_reach = 2 * View::guard;

template <typename Number>
void
copyPlane(const PictureTile& tile,
          std::size_t per_pixel,
          const std::vector<Number>& from,
          std::uint32_t from_width,
          std::vector<Number>& to,
          std::uint32_t to_width)
{
  if (to.empty())
    return;
  const PixelBox& kept = tile.kept;
  for (int row = kept.top; row < kept.bottom; ++row) {
    const auto place = [&](int left, int top, std::uint32_t width) {
      return static_cast<std::ptrdiff_t>(per_pixel *
                                         (static_cast<std::size_t>(row - top) * width +
                                          static_cast<std::size_t>(kept.left - left)));
    };
    std::copy_n(from.begin() + place(tile.drawn.left, tile.drawn.top, from_width),
                per_pixel * static_cast<std::size_t>(kept.width()),
                to.begin() + place(0, 0, to_width));
  }
}

} // namespace

std::vector<PictureTile>
splitPicture(int width, int height, int largest, int overlap)
{
  const int around =
      std::min((overlap + grain - 1) / grain * grain, largest / 4 / grain * grain);
  const int step = (largest - 2 * around) / grain * grain;
  const PixelBox picture{0, 0, width, height};
  std::vector<PictureTile> tiles;
  for (int top = 0; top < height; top += step)
    for (int left = 0; left < width; left += step) {
      const PixelBox kept =
          PixelBox{left, top, left + step, top + step}.clippedTo(picture);
      tiles.push_back({kept, kept.grownBy(around).clippedTo(picture)});
    }
  return tiles;
}

int
findReach(const Frame& frame)
{
  const ImageSpaceSettings& settings = frame.settings;
  const OcclusionGrid grid(frame);
  // Larger fills close holes of the size of a tile: none that are seen as such.
  constexpr int most = View::largest_size;
  const int fills =
      std::min(settings.background_fill, most) + std::min(settings.occluded_fill, most);
  return filter_reach + fills + grid.reach() * grid.cell;
}

View
cutView(const View& view, const PixelBox& box)
{
  View part = view;
  part.width = box.width();
  part.height = box.height();
  part.center_x -= static_cast<float>(box.left);
  part.center_y -= static_cast<float>(box.top);
  return part;
}

Background
cutBackground(const Background& background, const PixelBox& box, int height)
{
  const auto colorAt = [&](int row) {
    return backgroundAt(background,
                        static_cast<float>(row) / static_cast<float>(height));
  };
  Background part = background;
  part.top = colorAt(box.top);
  part.color = colorAt(box.bottom);
  return part;
}

void
copyTile(const PictureTile& tile, const Image& drawn, Image& picture)
{
  copyPlane(tile, 4, drawn.color, drawn.width, picture.color, picture.width);
  copyPlane(tile, 1, drawn.depth, drawn.width, picture.depth, picture.width);
  copyPlane(tile, 3, drawn.normal, drawn.width, picture.normal, picture.width);
  copyPlane(tile, 1, drawn.id, drawn.width, picture.id, picture.width);
}

} // namespace pcl_uvol
