// SPDX-License-Identifier: BSD-3-Clause
// Image-space rendering in plain C++: no context, the same bytes on any number of
// threads and with any instruction set.
#pragma once

#include "render/image_space/frame.h"

#include <memory>

namespace pcl_uvol {

/** \brief Points are projected band by band of the image, each band by one thread into
 * its own rows; so do all later passes. Memory: 10 bytes per pixel besides the image,
 * and 32 more where discs are blended.
 */
class PCL_UVOL_EXPORTS CpuBackend : public ImageSpaceBackend {
public:
  CpuBackend();
  ~CpuBackend() override;
  CpuBackend(const CpuBackend&) = delete;
  CpuBackend&
  operator=(const CpuBackend&) = delete;

  std::string
  describe() const override;

  void
  render(const Frame& frame, Image& image, Report& report) override;

private:
  struct Buffers;
  std::unique_ptr<Buffers> buffers_;
};

} // namespace pcl_uvol
