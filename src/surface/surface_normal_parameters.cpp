// SPDX-License-Identifier: BSD-3-Clause
#include "common/parameter_json.h"
#include <pcl_uvol/surface/surface_normals.h>

namespace pcl_uvol {

std::string
SurfaceNormalParameters::toJson() const
{
  return writeJson(*this);
}

SurfaceNormalParameters
SurfaceNormalParameters::fromJson(const std::string& text)
{
  return readJson<SurfaceNormalParameters>(text);
}

} // namespace pcl_uvol
