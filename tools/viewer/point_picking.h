// SPDX-License-Identifier: BSD-3-Clause
// The point of a surface under the mouse, and what it holds.
#pragma once

#include <pcl/PCLPointCloud2.h>

#include <array>
#include <cstddef>
#include <optional>
#include <string>

class vtkRenderer;

namespace uvol_tools {

/** \brief The point that is seen at a pixel of a window: of those within some pixels of
 * it the one nearest to the eye, and of those about as near the one nearest to the
 * pixel.
 *
 * \param column of the pixel, from the left
 *
 * \param row from below
 *
 * \return none where no point is near */
std::optional<std::size_t>
findPointAt(const pcl::PCLPointCloud2& cloud,
            vtkRenderer& renderer,
            double column,
            double row);

/** \brief Place and values of a point, a line each.
 * \param origin that was subtracted from the coordinates */
std::string
describePoint(const pcl::PCLPointCloud2& cloud,
              const std::array<double, 3>& origin,
              std::size_t point);

} // namespace uvol_tools
