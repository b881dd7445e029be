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
  std::uint32_t width, height;     ///< of a slice, cells
  std::uint32_t magnification, columns, rows;

  Layout(const GridShape& shape, int axis, std::uint32_t slices)
      : axes(axis == 0   ? std::array<std::size_t, 2>{{1, 2}}
             : axis == 1 ? std::array<std::size_t, 2>{{0, 2}}
                         : std::array<std::size_t, 2>{{0, 1}})
      , width(shape.cells[axes[0]])
      , height(shape.cells[axes[1]])
      , magnification(std::max(1u, slice_pixels / std::max(width, height)))
      , columns(std::min(slices, most_columns))
      , rows((slices + columns - 1) / columns)
  {
  }
};

} // namespace

Image
drawVoronoiSlices(const VoronoiGrid& grid, int axis, int slices)
{
  checkRange("axis of the slices", axis, 0, 2);
  const GridShape& shape = grid.getShape();
  const std::uint32_t along = shape.cells[static_cast<std::size_t>(axis)];
  checkRange("number of slices", slices, 1, std::numeric_limits<int>::max());
  const std::uint32_t count = std::min(static_cast<std::uint32_t>(slices), along);
  const Layout layout(shape, axis, count);
  const std::uint32_t step_x = layout.width * layout.magnification + gap,
                      step_y = layout.height * layout.magnification + gap;
  Image image;
  image.width = layout.columns * step_x - gap;
  image.height = layout.rows * step_y - gap;
  image.color.assign(4 * image.pixels(), 0xff); // white between the slices
  for (std::uint32_t slice = 0; slice < count; ++slice) {
    GridCell cell{};
    cell[static_cast<std::size_t>(axis)] =
        static_cast<std::uint16_t>((2 * slice + 1) * along / (2 * count));
    const std::uint32_t left = slice % layout.columns * step_x,
                        top = slice / layout.columns * step_y;
    for (std::uint32_t y = 0; y < step_y - gap; ++y)
      for (std::uint32_t x = 0; x < step_x - gap; ++x) {
        cell[layout.axes[0]] = static_cast<std::uint16_t>(x / layout.magnification);
        cell[layout.axes[1]] =
            static_cast<std::uint16_t>(layout.height - 1 - y / layout.magnification);
        const Rgba color = colorOf(grid.getNearest()[shape.indexOf(cell)]);
        std::memcpy(&image.color[4 * ((std::size_t{top} + y) * image.width + left + x)],
                    &color,
                    sizeof(color));
      }
  }
  return image;
}

} // namespace pcl_uvol
