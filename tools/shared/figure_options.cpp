// SPDX-License-Identifier: BSD-3-Clause
#include "shared/figure_options.h"

#include "common/printable.h"

#include <algorithm>

namespace uvol_tools {

void
FigureOptions::declare(Options& options)
{
  options.group("Figure", true);
  options.flag("ticks", figure_.has_ticks, "draw axes with values and grid lines");
  options.flag("box", figure_.has_box, "draw a box around the surface");
  options.flag("triad", figure_.has_triad, "draw the directions of x, y and z");
  options.flag(
      "scale-bar",
      figure_.has_scale_bar,
      "draw a scale bar of a round length, valid at the centre of the surface");
  options.text("unit",
               "text",
               figure_.unit,
               "unit of the coordinates, such as km, for axes and scale bar");
  options.text("title", "text", figure_.title, "title above the image");
  options.text(
      "views",
      "side,...",
      views_text_,
      "draw several views in one image, such as iso,top,front, instead of -view");
}

const std::vector<std::string>&
FigureOptions::names()
{
  static const std::vector<std::string> all = {
      "ticks", "box", "triad", "scale-bar", "unit", "title", "views"};
  return all;
}

void
FigureOptions::check(const Options& options, const Paper& paper)
{
  constexpr int room = 8; // letters of a legend
  figure_.least_letters = paper.leastLetters(room);
  if (options.given("unit") && !figure_.has_ticks && !figure_.has_scale_bar)
    throw UsageError("-unit needs -ticks or -scale-bar.");
  for (const char* const other : {"view", "eye"})
    if (options.given("views") && options.given(other))
      throw UsageError(std::string("-views and -") + other +
                       " both say where the camera is: give one of them.");
  figure_.views = parseNames("views", views_text_);
  const auto& names = pcl_uvol::Camera::viewNames();
  const auto unknown =
      std::find_if(figure_.views.begin(), figure_.views.end(), [&](const auto& view) {
        return std::find(names.begin(), names.end(), view) == names.end();
      });
  if (unknown != figure_.views.end()) {
    std::string all;
    for (const std::string& name : names)
      all += (all.empty() ? "" : ", ") + name;
    throw UsageError("-views has names of sides, " + all + ", not " +
                     pcl_uvol::quoteText(*unknown) + ".");
  }
  if (!figure_.fits(paper.width, paper.height))
    throw UsageError("The picture is too small for -views and -title: a larger -size "
                     "helps.");
}

} // namespace uvol_tools
