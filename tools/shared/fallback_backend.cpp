// SPDX-License-Identifier: BSD-3-Clause
#include "shared/fallback_backend.h"

#include "gl/context.h"
#include "render/image_space/cpu_backend.h"

namespace uvol_tools {

void
FallbackBackend::render(const pcl_uvol::Frame& frame,
                        pcl_uvol::Image& image,
                        pcl_uvol::Report& report)
{
  if (is_on_cpu_) {
    current_->render(frame, image, report);
    return;
  }
  try {
    pcl_uvol::Report tried;
    current_->render(frame, image, tried);
    report.merge(tried);
  }
  catch (const pcl_uvol::GlError& error) {
    report.warn("graphics_card_failed", {{"reason", error.message()}});
    current_ = std::make_shared<pcl_uvol::CpuBackend>();
    is_on_cpu_ = true;
    current_->render(frame, image, report);
  }
}

} // namespace uvol_tools
