// SPDX-License-Identifier: BSD-3-Clause
#include "shared/figure_options.h"

#include "charts/view_marks.h"

#include <algorithm>

namespace uvol_tools {

namespace {

/** Titles have larger letters than values. */
int
titleSize(int height)
{
  return letterSize(height) * 4 / 3;
}

int
titleRows(int height)
{
  return titleSize(height) * 5 / 2;
}

} // namespace

void
FigureOptions::declare(Options& options)
{
  options.group("Figure");
  options.flag("ticks", has_ticks_, "axes with values, and grid lines behind");
  options.flag("box", has_box_, "the box around the surface");
  options.flag("triad", has_triad_, "the directions of x, y and z");
  options.flag("scale-bar",
               has_scale_bar_,
               "a bar of a round length, as lengths in the middle of the surface look");
  options.text("unit", "text", unit_, "of the coordinates, such as km, for the above");
  options.text("title", "text", title_, "a line above the picture");
  options.text("views",
               "side,...",
               views_text_,
               "several views in one picture, as iso,top,front, instead of -view");
}

const std::vector<std::string>&
FigureOptions::names()
{
  static const std::vector<std::string> all = {
      "ticks", "box", "triad", "scale-bar", "unit", "title", "views"};
  return all;
}

void
FigureOptions::check(const Options& options, int width, int height)
{
  if (options.given("unit") && !has_ticks_ && !has_scale_bar_)
    throw UsageError("-unit needs -ticks or -scale-bar.");
  for (const char* const other : {"view", "eye"})
    if (options.given("views") && options.given(other))
      throw UsageError(std::string("-views and -") + other +
                       " both say where the camera is: give one of them.");
  views_ = parseNames("views", views_text_);
  const auto& names = pcl_uvol::Camera::viewNames();
  for (const std::string& view : views_)
    if (std::find(names.begin(), names.end(), view) == names.end()) {
      std::string all;
      for (const std::string& name : names)
        all += (all.empty() ? "" : ", ") + name;
      throw UsageError("-views has names of sides, " + all + ", not '" + view + "'.");
    }
  constexpr int least = 16;
  const auto cells = layOut(width, height);
  if (std::min(cells[0].width, cells[0].height) < least &&
      (!views_.empty() || !title_.empty()))
    throw UsageError("The picture is too small for -views and -title: a larger -size "
                     "helps.");
}

double
FigureOptions::getFill(const PictureCell& cell) const
{
  constexpr double usual = 0.9, least = 0.4, letters = 11.0; // of values on both sides
  if (!has_ticks_)
    return usual;
  const double side = std::min(cell.width, cell.height);
  return std::clamp(1.0 - letters * letterSize(cell.height) / side, least, usual);
}

std::vector<PictureCell>
FigureOptions::layOut(int width, int height) const
{
  const int top = title_.empty() ? 0 : titleRows(height);
  const int count = std::max(1, static_cast<int>(views_.size()));
  // As many columns as leave the largest square for each view.
  int columns = 1, largest = 0;
  for (int across = 1; across <= count; ++across) {
    const int down = (count + across - 1) / across;
    const int side = std::min(width / across, (height - top) / down);
    if (side > largest) {
      largest = side;
      columns = across;
    }
  }
  const int rows = (count + columns - 1) / columns;
  std::vector<PictureCell> cells;
  for (int i = 0; i < count; ++i) {
    const int column = i % columns, row = i / columns;
    const auto split = [](int length, int part, int parts) {
      return length * part / parts;
    };
    const int left = split(width, column, columns),
              above = top + split(height - top, row, rows);
    cells.push_back({left,
                     above,
                     split(width, column + 1, columns) - left,
                     top + split(height - top, row + 1, rows) - above,
                     views_.empty() ? "" : views_[static_cast<std::size_t>(i)]});
  }
  return cells;
}

void
FigureOptions::drawBehind(pcl_uvol::Image& image,
                          const PictureCell& cell,
                          const pcl_uvol::Camera& camera,
                          const DataBox& box) const
{
  const Perspective perspective(camera, cell.width, cell.height, cell.left, cell.top);
  const int font = letterSize(cell.height);
  const MarkStyle style{font, inkOn(image)};
  if (hasBox())
    drawBoxBehind(image, perspective, box, style, has_ticks_);
  if (views_.size() > 1)
    writeText(image,
              cell.view,
              font,
              cell.left + font,
              cell.top + 3 * font / 2,
              TextAnchor::Left,
              style.ink);
}

void
FigureOptions::drawBefore(pcl_uvol::Image& image,
                          const PictureCell& cell,
                          const pcl_uvol::Camera& camera,
                          const DataBox& box) const
{
  const Perspective perspective(camera, cell.width, cell.height, cell.left, cell.top);
  const int font = letterSize(cell.height);
  const MarkStyle style{font, inkOn(image)};
  if (has_box_)
    drawBoxBefore(image, perspective, box, style);
  const double length = std::min(3.0 * font, 0.12 * std::min(cell.width, cell.height));
  const double margin = length + 1.5 * font;
  if (has_triad_)
    drawTriad(image,
              perspective,
              {cell.left + margin, cell.top + cell.height - margin},
              length,
              style);
  if (has_scale_bar_) {
    constexpr double longest = 0.25; // of the view's width
    const double distance = perspective.seenFromEye(box.box.center()).z();
    drawScaleBar(
        image,
        {cell.left + cell.width - 1.5 * font, cell.top + cell.height - 1.5 * font},
        perspective.pixelsOf(box.factors.x(), distance),
        longest * cell.width,
        box.unit,
        style);
  }
}

void
FigureOptions::drawTitle(pcl_uvol::Image& image) const
{
  if (title_.empty())
    return;
  const int height = static_cast<int>(image.height);
  writeText(image,
            title_,
            titleSize(height),
            static_cast<int>(image.width) / 2,
            titleRows(height) / 2,
            TextAnchor::Center,
            inkOn(image));
}

} // namespace uvol_tools
