// SPDX-License-Identifier: BSD-3-Clause
// How many samples have which values, drawn behind the slider.
#pragma once

#include "render/color_scale.h"

#include <vtkActor2D.h>
#include <vtkSmartPointer.h>

#include <array>
#include <vector>

namespace uvol_tools {

/** \brief Bars over a scale, whose heights are the logarithms of their numbers: most
 * samples lie far from a surface, and rare values are to be seen.
 *
 * \param values those that are not finite do not count
 * \param corners left, bottom, right and top in the viewport, in [0, 1] */
vtkSmartPointer<vtkActor2D>
drawHistogram(const std::vector<double>& values,
              const pcl_uvol::ColorScale& scale,
              const std::array<double, 4>& corners);

} // namespace uvol_tools
