// SPDX-License-Identifier: BSD-3-Clause
// Small pictures that somebody has looked at. They are written anew with
// PCL_UVOL_WRITE_GOLDEN_IMAGES set in the environment: look at them again then.
#pragma once

#include "support/png.h"
#include <pcl_uvol/io/image_file.h>

#include <cstdlib>
#include <string>

namespace uvol_test {

constexpr int golden_width = 160, golden_height = 120;

/** \brief That part of the pixels has to be alike. */
constexpr double golden_part = 0.998;

/** \brief Part of the pixels that are as in the picture of that name: no channel is off
 * by more than what another compiler's or another library's last bit makes. 0 if the
 * sizes differ. */
inline double
partLikeGolden(const std::string& name, const pcl_uvol::Image& image)
{
  const std::string path =
      std::string(PCL_UVOL_SOURCE_DIR "/tests/render/golden/") + name + ".png";
  if (std::getenv("PCL_UVOL_WRITE_GOLDEN_IMAGES") != nullptr)
    pcl_uvol::savePng(path, image);
  int channels = 0;
  const pcl_uvol::Image golden = readPng(path, channels);
  if (golden.width != image.width || golden.height != image.height)
    return 0.0;
  std::size_t alike = 0;
  for (std::size_t i = 0; i < image.pixels(); ++i) {
    bool is_alike = true;
    for (std::size_t k = 4 * i; k < 4 * i + 4; ++k)
      is_alike &= std::abs(image.color[k] - golden.color[k]) <= 2;
    alike += is_alike ? 1 : 0;
  }
  return static_cast<double>(alike) / static_cast<double>(image.pixels());
}

} // namespace uvol_test
