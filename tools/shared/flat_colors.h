// SPDX-License-Identifier: BSD-3-Clause
// Surfaces in the colours of their fields, without light.
#pragma once

#include <pcl_uvol/render/image_space/backend.h>

namespace uvol_tools {

/** \brief Where nothing is lit, show colours as they are: all would be white. */
inline void
showColorsWithoutLight(pcl_uvol::ImageSpaceSettings& settings)
{
  if (settings.shading)
    return;
  settings.shading = true;
  settings.ambient_occlusion = 0.0;
  settings.material.ambient = 1.0;
  settings.material.diffuse = settings.material.specular = 0.0;
}

/** \brief Whether a surface that has no colours is drawn white on white. */
inline bool
isInvisible(const pcl_uvol::ImageSpaceSettings& settings)
{
  const pcl_uvol::Background& background = settings.background;
  const pcl_uvol::Color& color = background.color;
  return !settings.shading && !settings.silhouettes && !settings.feature_lines &&
         background.kind == pcl_uvol::Background::Kind::Plain && color.r == 1.0f &&
         color.g == 1.0f && color.b == 1.0f;
}

} // namespace uvol_tools
