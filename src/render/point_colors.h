// SPDX-License-Identifier: BSD-3-Clause
// Colours of the points of a cloud: its own, or those of a scalar field.
#pragma once

#include "render/color_scale.h"
#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/common/stage.h>
#include <pcl_uvol/render/color_map.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace pcl_uvol {

/** \brief One colour per input point, and what the colours stand for. */
struct PointColors {
  std::vector<Rgba> colors;
  ColorScale scale;
};

/** \brief The colour of a point that is less sure than others: half that of the
 * background. */
PCL_UVOL_EXPORTS Rgba
makePaler(Rgba color, const Color& background);

/** \brief True for a cloud with colours of its own: rgb or rgba, as PCL packs them into
 * four bytes, or red, green and blue of a byte each, as PLY files have them. */
PCL_UVOL_EXPORTS bool
hasColors(const CloudView& cloud);

/** \brief True if the points are those of several isovalues. */
PCL_UVOL_EXPORTS bool
hasIsovalues(const CloudView& cloud);

/** \brief The isovalues of points, ascending; none of points without, and of so many
 * that they are a field. */
PCL_UVOL_EXPORTS std::vector<double>
listIsovalues(const CloudView& cloud);

/** \brief What a cloud is coloured by where nobody says: "rgb" if it has colours, else
 * "isovalue" if it has several, else "", the material's colour. */
PCL_UVOL_EXPORTS std::string
usualColorField(const CloudView& cloud);

/** \brief The field that a choice colours a cloud by: "auto" is usualColorField(), and
 * "none" is "". */
PCL_UVOL_EXPORTS std::string
resolveColor(const CloudView& cloud, const std::string& choice);

/** \brief Values of a field that stand for categories, ascending: whole numbers, and
 * isovalues.
 * \return none if another field holds a fraction, or for more than that many values */
PCL_UVOL_EXPORTS std::vector<double>
listCategories(const CloudView& cloud, const std::string& field, std::size_t most);

/** \brief A value and its colour. */
struct CategoryColor {
  double value;
  Color color;
  std::string name = {}; ///< that the value stands for; "": none
};

/** \brief The categories of a field with colours of a map of categories, as
 * ColorMap::ofCategory says; isovalues, and numbers of which two would share a colour
 * although there are enough, have colours in the order of their values.
 * \return none as listCategories */
PCL_UVOL_EXPORTS std::vector<CategoryColor>
colorCategories(const CloudView& cloud,
                const std::string& field,
                const ColorMap& map,
                std::size_t most);

/** \brief How values become colours. */
struct ColorMapping {
  ColorMap map;
  /** Values at the ends of the colours; none: those of the field, of which a
   * logarithmic scale takes those above 0 in the upper most_decades. */
  std::optional<std::array<double, 2>> range;
  bool is_logarithmic = false;
};

/** \brief The colours of categories where nobody says: OkabeIto for as many as it has,
 * else tab10.
 * \throws InvalidArgument for an unknown field */
PCL_UVOL_EXPORTS ColorMap
usualCategoryMap(const CloudView& cloud, const std::string& field);

/** \brief How a field is coloured where nobody says: a few whole numbers as categories,
 * others by shades from their lowest to their highest value.
 * \throws InvalidArgument for an unknown field */
PCL_UVOL_EXPORTS ColorMapping
usualColorMapping(const CloudView& cloud, const std::string& field);

/** \brief The scale that is asked for, else that of the values.
 * \throws InvalidArgument for an unknown field, one without a number, or a logarithmic
 * scale that is not above 0 */
PCL_UVOL_EXPORTS ColorScale
findColorScale(const CloudView& cloud,
               const std::string& field,
               const ColorMapping& mapping);

/** \brief Warn of values that a logarithmic scale has no colour for.
 * \throws InvalidArgument for an unknown field */
PCL_UVOL_EXPORTS void
warnOfLogarithms(const CloudView& cloud,
                 const std::string& field,
                 const ColorMapping& mapping,
                 Report& report);

/** \brief Colour a cloud. A map of categories colours whole numbers and
 * isovalues by themselves, whatever the range, see colorCategories. Values without a
 * number, or without a logarithm where it takes one, are grey.
 * \param field a scalar field, as in ScalarField, or "rgb" for the cloud's own colours
 * \throws InvalidArgument as findColorScale */
PCL_UVOL_EXPORTS PointColors
colorPoints(const CloudView& cloud,
            const std::string& field,
            const ColorMapping& mapping);

} // namespace pcl_uvol
