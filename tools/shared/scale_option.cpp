// SPDX-License-Identifier: BSD-3-Clause
#include "shared/scale_option.h"

#include "neighbors/anisotropy.h"
#include "shared/options.h"

namespace uvol_tools {

ScaleOption::ScaleOption(const std::string& text)
    : is_automatic_(text == "auto")
    , factors_(3, 1.0)
{
  if (!is_automatic_ && !text.empty())
    factors_ = parseNumbers("scale", text, 3);
}

Eigen::Array3f
ScaleOption::resolveScale(const pcl_uvol::CloudView& cloud) const
{
  if (is_automatic_)
    return pcl_uvol::equalizingScale(cloud);
  return getFactors();
}

} // namespace uvol_tools
