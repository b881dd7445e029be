// SPDX-License-Identifier: BSD-3-Clause
// The legend of a picture that is coloured by a scalar field.
#pragma once

#include "charts/axes.h"
#include "charts/drawing.h"
#include "render/color_scale.h"
#include "render/point_colors.h"
#include <pcl_uvol/common/dataset.h>
#include <pcl_uvol/common/stage.h>
#include <pcl_uvol/render/color_map.h>
#include <pcl_uvol/render/renderer.h>

#include <array>
#include <string>
#include <vector>

namespace uvol_tools {

/** \brief Columns at the right border of an image of that size that hold a bar and its
 * values; 0 for images too small for it (below 128 pixels).
 * \param least_letters see letterSize() */
int
colorBarWidth(int image_width, int image_height, int least_letters = 0);

/** \brief Draw a bar of colours with its values and a title at the right border of an
 * image; nothing in images too small for it. Both ends have their values; of values
 * that only their last digits tell apart the common part is written below the bar. */
void
drawColorBar(pcl_uvol::Image& image,
             const pcl_uvol::ColorMap& map,
             const pcl_uvol::ColorScale& scale,
             const std::string& title,
             int least_letters = 0);

/** \brief Most categories that a legend lists. */
constexpr std::size_t most_categories = 20;

/** \brief The categories of a field that a legend lists, with the names that labels
 * stand for; none for a map of shades, and as colorCategories. */
std::vector<pcl_uvol::CategoryColor>
listNamedCategories(const pcl_uvol::CloudView& cloud,
                    const pcl_uvol::LabelNames& labels,
                    const std::string& field,
                    const pcl_uvol::ColorMap& map);

/** \brief How a field is coloured where nobody says: usualColorMapping(), but all
 * labels of names as categories. */
pcl_uvol::ColorMapping
mapUsually(const pcl_uvol::CloudView& cloud,
           const pcl_uvol::LabelNames& labels,
           const std::string& field);

/** \brief True if the colours of a picture need an explanation, and can have one: ""
 * and colours of the points' own need none, and of too many names there is none. */
bool
hasLegend(const pcl_uvol::CloudView& cloud,
          const pcl_uvol::LabelNames& labels,
          const std::string& field);

/** \brief Warn of a column of so many names that there is no legend. */
void
warnOfNames(const pcl_uvol::CloudView& cloud,
            const pcl_uvol::LabelNames& labels,
            const std::string& field,
            pcl_uvol::Report& report);

/** \brief What a legend calls a category: its name, cut where it is long, or its
 * number.
 */
std::string
describeCategory(const pcl_uvol::CategoryColor& category);

/** \brief Draw a square for each category with its name or number, and a title, in the
 * place of a bar.
 * \param categories ascending, at most most_categories */
void
drawCategories(pcl_uvol::Image& image,
               const std::vector<pcl_uvol::CategoryColor>& categories,
               const std::string& title,
               int least_letters = 0);

/** \brief Draw what the colours of a picture stand for at its right border: categories,
 * or a bar.
 * \param range values at the ends of its colours
 * \param title what the values are called
 * \param least_letters see letterSize() */
void
drawLegend(pcl_uvol::Image& image,
           const pcl_uvol::CloudView& cloud,
           const pcl_uvol::LabelNames& labels,
           const std::string& field,
           const pcl_uvol::ColorMapping& mapping,
           const std::array<double, 2>& range,
           const std::string& title,
           int least_letters = 0);

/** \brief A value beside a bar. */
struct BarLabel {
  double place; ///< along the bar, 0 at its lower end and 1 at the upper one
  std::string text;
};

/** \brief Values beside a bar. */
struct BarLabels {
  std::vector<BarLabel> values; ///< from the lower end to the upper one
  /** What is to be added to all of them, as "+ 1.6e9"; empty for nothing. */
  std::string offset;
};

/** \brief Both ends of a scale, and round values in between.
 * \param nearest two of them, in parts of the bar */
BarLabels
labelBar(const pcl_uvol::ColorScale& scale, double nearest);

/** \brief Round values within a scale, to be written beside it. */
std::vector<double>
listTicks(const pcl_uvol::ColorScale& scale);

/** \brief The colour at a place along a bar: everywhere the same for one value. */
pcl_uvol::Color
colorOnBar(const pcl_uvol::ColorMap& map,
           const pcl_uvol::ColorScale& scale,
           double place);

/** \brief Draw a standing bar of colours with values beside it.
 * \param anchor Left: the values stand to the right of the bar; Right: to the left
 * \param font size, pixels
 * \return the width of the widest value, pixels */
int
drawBar(pcl_uvol::Image& image,
        const pcl_uvol::ColorMap& map,
        const pcl_uvol::ColorScale& scale,
        const PlotArea& area,
        const std::vector<BarLabel>& labels,
        TextAnchor anchor,
        int font,
        const Ink& ink);

} // namespace uvol_tools
