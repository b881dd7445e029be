// SPDX-License-Identifier: BSD-3-Clause
// Colours of the points of a cloud: its own, or those of a scalar field.
#pragma once

#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/render/color_map.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace pcl_uvol {

/** \brief One colour per input point, and the values at the ends of the colours. */
struct PointColors {
  std::vector<Rgba> colors;
  std::array<double, 2> range{{0.0, 1.0}};
};

/** \brief True for a cloud with colours of its own: rgb or rgba, as PCL packs them into
 * four bytes, or red, green and blue of a byte each, as PLY files have them. */
PCL_UVOL_EXPORTS bool
hasColors(const CloudView& cloud);

/** \brief True if the points are those of several isovalues. */
PCL_UVOL_EXPORTS bool
hasIsovalues(const CloudView& cloud);

/** \brief What a cloud is coloured by where nobody says: "rgb" if it has colours, else
 * "isovalue" if it has several, else "", the material's colour. */
PCL_UVOL_EXPORTS std::string
usualColorField(const CloudView& cloud);

/** \brief Colour a cloud.
 * \param field a scalar field, as in ScalarField, or "rgb" for the cloud's own colours
 * \param range values at the ends of the colours; none: those of the field
 * \throws InvalidArgument for an unknown field, or one without a number */
PCL_UVOL_EXPORTS PointColors
colorPoints(const CloudView& cloud,
            const std::string& field,
            const ColorMap& map,
            const std::optional<std::array<double, 2>>& range);

} // namespace pcl_uvol
