// SPDX-License-Identifier: BSD-3-Clause
// What the shading kernel needs to know of a frame.
#pragma once

#include "render/image_space/frame.h"
#include "render/image_space/shading_kernel.h"

#include <vector>

namespace pcl_uvol {

/** \brief View, lights and material of a frame, which must stay as long. */
class ShadingSetup {
public:
  explicit ShadingSetup(const Frame& frame);
  ShadingSetup(const ShadingSetup&) = delete;
  ShadingSetup&
  operator=(const ShadingSetup&) = delete;

  const Shading&
  get() const
  {
    return shading_;
  }

private:
  std::vector<ShadingLight> lights_;
  Shading shading_{};
};

} // namespace pcl_uvol
