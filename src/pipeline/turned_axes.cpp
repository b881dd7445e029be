// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/turned_axes.h"

#include "levelset/level_set_input.h"

#include <memory>

namespace pcl_uvol {

TurnedAxes::TurnedAxes(PipelineInput& input)
    : axes_(input.parameters.rotation)
{
  if (!axes_.areTurned())
    return;
  const auto turned = std::make_shared<Dataset>(*input.samples);
  axes_.turn(turned->cloud);
  input.samples = turned;
  input.parameters.rotation.setZero();
  LevelSetParameters& level_set = input.parameters.level_set;
  const Eigen::Array3d origin(turned->origin.data()); // that it counts from none of
  level_set.initial =
      moveShape(turnShape(moveShape(level_set.initial, origin), axes_), -origin);
}

void
TurnedAxes::leave(IsosurfaceResult& result) const
{
  if (axes_.areTurned())
    axes_.turnBack(result.surface.cloud);
}

} // namespace pcl_uvol
