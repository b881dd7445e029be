// SPDX-License-Identifier: BSD-3-Clause
#include "charts/slice_plot.h"

#include "charts/color_bar.h"
#include "charts/drawing.h"
#include "common/number_range.h"

#include <algorithm>
#include <cmath>

namespace uvol_tools {

using pcl_uvol::Image;

namespace {

constexpr std::size_t least_side = 512; ///< pixels along the longer side of the slice
/** Sides of a slice, in heights of letters: less has no room for the numbers beside it.
 */
constexpr int least_height = 5, least_width = 16;
constexpr Ink white{255, 255, 255}, ground{232, 232, 232};
constexpr double middle_gray = 128.0;

/** Black on light colours, white on dark ones. */
Ink
inkAgainst(const Ink& color)
{
  // ITU-R BT.601
  const double gray = 0.299 * color[0] + 0.587 * color[1] + 0.114 * color[2];
  return gray < middle_gray ? white : black;
}

/** The colours of values. */
class Palette {
public:
  explicit Palette(const SlicePlot& plot)
      : map_(plot.map)
      , scale_(plot.scale)
  {
  }

  double
  placeOf(double value) const
  {
    return std::clamp(scale_.placeOf(value), 0.0, 1.0);
  }

  Ink
  colorOf(double value) const
  {
    return scale_.hasPlace(value) ? inkOf(map_.at(placeOf(value))) : ground;
  }

private:
  const pcl_uvol::ColorMap& map_;
  const pcl_uvol::ColorScale& scale_;
};

/** Sizes of a figure, in pixels. */
struct Layout {
  double column, row; ///< of a value: a square, but for slices that are too thin
  int font, margin;
  PlotArea area;
  std::uint32_t width, height;

  explicit Layout(const SlicePlot& plot)
  {
    if (plot.paper.width > 0)
      fit(plot);
    else
      magnify(plot);
    margin = font / 2;
  }

  /** The area from centre to centre of the outermost values. */
  PlotArea
  centers() const
  {
    const int across = halfOf(column), up = halfOf(row);
    return {area.left + across, area.right - across, area.top + up, area.bottom - up};
  }

  static int
  halfOf(double side)
  {
    return static_cast<int>(side) / 2;
  }

private:
  // What is left around a slice for axes, bar and labels, in heights of letters.
  static constexpr int left = 8, right = 13, below = 5;

  /** As many pixels for each value as make a figure that can be read. */
  void
  magnify(const SlicePlot& plot)
  {
    const std::size_t longer = std::max(plot.width, plot.height);
    const int square = static_cast<int>((least_side + longer - 1) / longer);
    font = std::max(
        {13, square * static_cast<int>(longer) / 45, plot.paper.printedLetters()});
    column = widen(square, plot.width, least_width * font);
    row = widen(square, plot.height, least_height * font);
    const int across = static_cast<int>(column) * static_cast<int>(plot.width),
              up = static_cast<int>(row) * static_cast<int>(plot.height);
    place(left * font, topMargin(), across, up);
    width = static_cast<std::uint32_t>(area.right + right * font);
    height = static_cast<std::uint32_t>(area.bottom + below * font);
  }

  /** The largest squares for which paper has room, in its middle. */
  void
  fit(const SlicePlot& plot)
  {
    constexpr Paper usual{785, 600};
    font = plot.paper.chartLetters(usual);
    width = static_cast<std::uint32_t>(plot.paper.width);
    height = static_cast<std::uint32_t>(plot.paper.height);
    const int room_across = std::max(1, plot.paper.width - (left + right) * font),
              room_up = std::max(1, plot.paper.height - topMargin() - below * font);
    const auto columns = static_cast<double>(plot.width),
               rows = static_cast<double>(plot.height);
    const double square = std::min(room_across / columns, room_up / rows);
    const int across = lengthOf(square * columns, least_width, room_across),
              up = lengthOf(square * rows, least_height, room_up);
    column = across / columns;
    row = up / rows;
    place(left * font + (room_across - across) / 2,
          topMargin() + (room_up - up) / 2,
          across,
          up);
  }

  void
  place(int from_left, int from_top, int across, int up)
  {
    area = {from_left, from_left + across - 1, from_top, from_top + up - 1};
  }

  int
  topMargin() const
  {
    return 3 * font / 2;
  }

  /** \param least in heights of letters */
  int
  lengthOf(double pixels, int least, int room) const
  {
    return std::clamp(rounded(pixels), std::min(least * font, room), room);
  }

  /** The side of a value, or a multiple by which so many take the least length. */
  static int
  widen(int side, std::size_t values, int least)
  {
    const int length = side * static_cast<int>(values);
    return length < least ? side * ((least + length - 1) / length) : side;
  }
};

void
drawValues(const SlicePlot& plot,
           const Palette& colors,
           const Layout& layout,
           Image& image)
{
  const PlotArea& area = layout.area;
  const auto valueAt = [](int pixel, double side, std::size_t values) {
    return std::min(static_cast<std::size_t>((pixel + 0.5) / side), values - 1);
  };
  for (int y = area.top; y <= area.bottom; ++y)
    for (int x = area.left; x <= area.right; ++x) {
      const std::size_t row = valueAt(area.bottom - y, layout.row, plot.height),
                        column = valueAt(x - area.left, layout.column, plot.width);
      const auto value = static_cast<double>(plot.values[row * plot.width + column]);
      blend(image, x, y, colors.colorOf(value), 1.0);
    }
}

/** Lines of equal values, by the edges of the squares between four of them; lines are
 * covered once, however many pieces meet in a pixel. */
class ContourPen {
public:
  ContourPen(const SlicePlot& plot, const Layout& layout, Image& image)
      : plot_(plot)
      , layout_(layout)
      , image_(image)
      , cover_(image.pixels())
  {
  }

  void
  draw(double value, const Ink& ink)
  {
    std::fill(cover_.begin(), cover_.end(), 0.0f);
    for (std::size_t row = 0; row + 1 < plot_.height; ++row)
      for (std::size_t column = 0; column + 1 < plot_.width; ++column)
        drawSquare(row, column, value);
    for (std::size_t i = 0; i < cover_.size(); ++i)
      if (cover_[i] > 0.0f)
        blend(image_,
              static_cast<int>(i % image_.width),
              static_cast<int>(i / image_.width),
              ink,
              static_cast<double>(cover_[i]));
  }

private:
  using Pixel = std::array<double, 2>;

  double
  valueAt(std::size_t row, std::size_t column) const
  {
    return static_cast<double>(plot_.values[row * plot_.width + column]);
  }

  Pixel
  pixelOf(double row, double column) const
  {
    const PlotArea centers = layout_.centers();
    return {centers.left + layout_.column * column, centers.bottom - layout_.row * row};
  }

  /** The line through a square, or two where corners across are on the same side: these
   * are joined as the mean of the four says. */
  void
  drawSquare(std::size_t row, std::size_t column, double value)
  {
    const double corners[] = {valueAt(row, column),
                              valueAt(row, column + 1),
                              valueAt(row + 1, column + 1),
                              valueAt(row + 1, column)};
    constexpr double rows[] = {0.0, 0.0, 1.0, 1.0}, columns[] = {0.0, 1.0, 1.0, 0.0};
    Pixel ends[4];
    std::size_t count = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      const std::size_t j = (i + 1) % 4;
      if (std::isnan(corners[i]))
        return;
      if ((corners[i] < value) == (corners[j] < value))
        continue;
      const double part = (value - corners[i]) / (corners[j] - corners[i]);
      ends[count++] = pixelOf(
          static_cast<double>(row) + rows[i] + part * (rows[j] - rows[i]),
          static_cast<double>(column) + columns[i] + part * (columns[j] - columns[i]));
    }
    if (count == 2)
      cover(ends[0], ends[1]);
    if (count == 4) {
      const double mean = 0.25 * (corners[0] + corners[1] + corners[2] + corners[3]);
      const bool first_is_cut_off = (corners[0] < value) != (mean < value);
      cover(ends[0], first_is_cut_off ? ends[3] : ends[1]);
      cover(ends[2], first_is_cut_off ? ends[1] : ends[3]);
    }
  }

  void
  cover(const Pixel& from, const Pixel& to)
  {
    const double width = layout_.font / 9.0;
    forLinePixels(
        from[0], from[1], to[0], to[1], width, [&](int column, int row, double part) {
          if (column < layout_.area.left || column > layout_.area.right ||
              row < layout_.area.top || row > layout_.area.bottom)
            return;
          float& covered = cover_[static_cast<std::size_t>(row) * image_.width +
                                  static_cast<std::size_t>(column)];
          covered = std::max(covered, static_cast<float>(part));
        });
  }

  const SlicePlot& plot_;
  const Layout& layout_;
  Image& image_;
  std::vector<float> cover_;
};

/** Dots in the colours of the samples, with rims that tell them from the slice: all
 * rims first, so that none hides a dot beside it. */
void
drawSamples(const SlicePlot& plot,
            const Palette& colors,
            const Layout& layout,
            Image& image)
{
  const PlotArea centers = layout.centers();
  const double radius = layout.font / 4.0, rim = layout.font / 12.0;
  for (const bool is_rim : {true, false})
    for (const SliceSample& sample : plot.samples) {
      const double column = centers.left + plot.across.placeOf(sample.across) *
                                               (centers.right - centers.left);
      const double row =
          centers.bottom - plot.up.placeOf(sample.up) * (centers.bottom - centers.top);
      if (column < layout.area.left || column > layout.area.right ||
          row < layout.area.top || row > layout.area.bottom)
        continue;
      const double width = 2.0 * (is_rim ? radius : radius - rim);
      drawLine(image,
               column,
               row,
               column,
               row,
               width,
               is_rim ? black : colors.colorOf(sample.value));
    }
}

void
drawScale(const SlicePlot& plot,
          const Palette& colors,
          const Layout& layout,
          Image& image)
{
  const int font = layout.font, left = layout.area.right + 2 * font;
  const PlotArea bar{left, left + font - 1, layout.area.top, layout.area.bottom};
  const auto ticks = listTicks(plot.scale);
  const auto texts = pcl_uvol::describeNumbers(ticks);
  std::vector<BarLabel> labels;
  for (std::size_t i = 0; i < ticks.size(); ++i)
    labels.push_back({colors.placeOf(ticks[i]), texts[i]});
  const int widest =
      drawBar(image, plot.map, plot.scale, bar, labels, TextAnchor::Left, font, black);
  for (const double value : plot.contours) {
    if (value < plot.scale.low || value > plot.scale.high)
      continue;
    const double row = bar.bottom - colors.placeOf(value) * (bar.bottom - bar.top);
    drawLine(image,
             bar.left,
             row,
             bar.right,
             row,
             font / 9.0,
             inkAgainst(colors.colorOf(value)));
  }
  writeUpwards(image,
               plot.title,
               font,
               bar.right + 2 * font + widest,
               (bar.top + bar.bottom) / 2,
               black);
}

} // namespace

pcl_uvol::ColorScale
findColorScale(const std::vector<float>& values,
               const AxisScale& bounds,
               bool is_logarithmic)
{
  pcl_uvol::ColorScaleFinder finder(is_logarithmic);
  for (const float single : values) {
    const auto value = static_cast<double>(single);
    if (value >= bounds.low && value <= bounds.high)
      finder.add(value);
  }
  const pcl_uvol::ColorScale none =
      is_logarithmic && !(bounds.low > 0.0)
          ? pcl_uvol::ColorScale{0.1, 1.0, true}
          : pcl_uvol::ColorScale{bounds.low, bounds.high, is_logarithmic};
  return finder.find().value_or(none);
}

Image
drawSlicePlot(const SlicePlot& plot)
{
  const Layout layout(plot);
  Image image;
  image.width = layout.width;
  image.height = layout.height;
  image.color.assign(4 * image.pixels(), 255);
  const Palette colors(plot);
  drawValues(plot, colors, layout, image);
  ContourPen pen(plot, layout, image);
  for (const double value : plot.contours)
    pen.draw(value, inkAgainst(colors.colorOf(value)));
  drawSamples(plot, colors, layout, image);
  drawAxisBelow(image,
                layout.centers(),
                layout.margin + Layout::halfOf(layout.row),
                plot.across,
                plot.across_label,
                layout.font);
  drawAxisLeft(image,
               layout.centers(),
               layout.margin + Layout::halfOf(layout.column),
               plot.up,
               plot.up_label,
               layout.font);
  drawScale(plot, colors, layout, image);
  return image;
}

} // namespace uvol_tools
