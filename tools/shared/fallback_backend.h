// SPDX-License-Identifier: BSD-3-Clause
// Drawing that goes on where a graphics card gives up.
#pragma once

#include <pcl_uvol/render/image_space/backend.h>

#include <memory>
#include <string>

namespace uvol_tools {

/** \brief Draws with one backend until it fails with a GlError, and then, with a
 * warning, on the CPU, which gives the same picture. */
class FallbackBackend : public pcl_uvol::ImageSpaceBackend {
public:
  explicit FallbackBackend(std::shared_ptr<pcl_uvol::ImageSpaceBackend> first)
      : current_(std::move(first))
  {
  }

  std::string
  describe() const override
  {
    return current_->describe();
  }

  void
  render(const pcl_uvol::Frame& frame,
         pcl_uvol::Image& image,
         pcl_uvol::Report& report) override;

private:
  std::shared_ptr<pcl_uvol::ImageSpaceBackend> current_;
  bool is_on_cpu_ = false;
};

} // namespace uvol_tools
