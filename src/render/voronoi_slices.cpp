// SPDX-License-Identifier: BSD-3-Clause
#include "render/voronoi_slices.h"

#include "common/random.h"
#include "render/lighting.h"
#include <pcl_uvol/render/color_map.h>

#include <algorithm>
#include <cstring>
#include <limits>

namespace pcl_uvol {

namespace {

constexpr std::uint32_t slice_pixels = 300, gap = 4, most_columns = 3;

/** Light enough to be told from black, in any hue. */
Rgba
colorOf(std::uint32_t region)
{
  const auto channel = [&](std::uint64_t number) {
    return static_cast<float>(0.15 + 0.85 * uniformAt(1, region, number));
  };
  return toRgba({channel(0), channel(1), channel(2)});
}

/** Where the slices lie in the picture. */
struct Layout {
  std::array<std::size_t, 2> axes; ///< to the right and upwards
  std::uint32_t cells_across, cells_up, columns, rows;
  std::uint32_t wide, high; ///< a slice, pixels
  std::uint32_t width, height, left = 0, top = 0;

  Layout(const GridShape& shape, int axis, std::uint32_t slices)
      : axes(axis == 0   ? std::array<std::size_t, 2>{{1, 2}}
             : axis == 1 ? std::array<std::size_t, 2>{{0, 2}}
                         : std::array<std::size_t, 2>{{0, 1}})
      , cells_across(shape.cells[axes[0]])
      , cells_up(shape.cells[axes[1]])
      , columns(std::min(slices, most_columns))
      , rows((slices + columns - 1) / columns)
  {
    const std::uint32_t magnification =
        std::max(1u, slice_pixels / std::max(cells_across, cells_up));
    wide = cells_across * magnification;
    high = cells_up * magnification;
    width = lengthOf(columns, wide);
    height = lengthOf(rows, high);
  }

  /** Make the slices as large as a picture of that size has room for. */
  void
  fit(std::uint32_t picture_width, std::uint32_t picture_height)
  {
    const auto roomFor = [](std::uint32_t length, std::uint32_t count) {
      return (length - std::min(length, (count - 1) * gap)) / count;
    };
    const double side =
        std::min(static_cast<double>(roomFor(picture_width, columns)) / cells_across,
                 static_cast<double>(roomFor(picture_height, rows)) / cells_up);
    const auto pixelsOf = [&](std::uint32_t cells) {
      return std::max(1u, static_cast<std::uint32_t>(side * cells + 1e-9));
    };
    wide = pixelsOf(cells_across);
    high = pixelsOf(cells_up);
    width = picture_width;
    height = picture_height;
    left = (width - std::min(width, lengthOf(columns, wide))) / 2;
    top = (height - std::min(height, lengthOf(rows, high))) / 2;
  }

private:
  static std::uint32_t
  lengthOf(std::uint32_t count, std::uint32_t side)
  {
    return count * (side + gap) - gap;
  }
};

/** The cell in whose square the middle of a pixel lies. */
std::uint16_t
cellAt(std::uint32_t pixel, std::uint32_t cells, std::uint32_t pixels)
{
  return static_cast<std::uint16_t>((2 * std::uint64_t{pixel} + 1) * cells /
                                    (2 * std::uint64_t{pixels}));
}

} // namespace

Image
drawVoronoiSlices(const VoronoiGrid& grid, int axis, int slices, int width, int height)
{
  checkRange("axis of the slices", axis, 0, 2);
  const GridShape& shape = grid.getShape();
  const std::uint32_t along = shape.cells[static_cast<std::size_t>(axis)];
  checkRange("number of slices", slices, 1, std::numeric_limits<int>::max());
  const std::uint32_t count = std::min(static_cast<std::uint32_t>(slices), along);
  Layout layout(shape, axis, count);
  if (width > 0)
    layout.fit(static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height));
  Image image;
  image.width = layout.width;
  image.height = layout.height;
  image.color.assign(4 * image.pixels(), 0xff); // white between the slices
  for (std::uint32_t slice = 0; slice < count; ++slice) {
    GridCell cell{};
    cell[static_cast<std::size_t>(axis)] =
        static_cast<std::uint16_t>((2 * slice + 1) * along / (2 * count));
    const std::uint32_t left =
                            layout.left + slice % layout.columns * (layout.wide + gap),
                        top = layout.top + slice / layout.columns * (layout.high + gap);
    for (std::uint32_t y = top; y < std::min(top + layout.high, image.height); ++y)
      for (std::uint32_t x = left; x < std::min(left + layout.wide, image.width); ++x) {
        cell[layout.axes[0]] = cellAt(x - left, layout.cells_across, layout.wide);
        cell[layout.axes[1]] = static_cast<std::uint16_t>(
            layout.cells_up - 1 - cellAt(y - top, layout.cells_up, layout.high));
        const Rgba color = colorOf(grid.getNearest()[shape.indexOf(cell)]);
        std::memcpy(&image.color[4 * (std::size_t{y} * image.width + x)],
                    &color,
                    sizeof(color));
      }
  }
  return image;
}

} // namespace pcl_uvol
