// SPDX-License-Identifier: BSD-3-Clause
#include "charts/perspective.h"

#include <cmath>

namespace uvol_tools {

Perspective::Perspective(
    const pcl_uvol::Camera& camera, int width, int height, int left, int top)
    : turn_(camera.rotation())
    , eye_(camera.eye)
    , center_{left + 0.5 * width - 0.5, top + 0.5 * height - 0.5}
    , frame_(Eigen::Vector2d(left, top),
             Eigen::Vector2d(left + width - 1, top + height - 1))
{
  constexpr double pi = 3.14159265358979323846;
  focal_ = 0.5 * height / std::tan(camera.vertical_fov * pi / 360.0);
}

} // namespace uvol_tools
