// SPDX-License-Identifier: BSD-3-Clause
// Small pictures that somebody has looked at. They are written anew with
// PCL_UVOL_WRITE_GOLDEN_IMAGES set in the environment: look at them again then.
#pragma once

#include "support/png.h"
#include <pcl_uvol/io/image_file.h>

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

namespace uvol_test {

constexpr int golden_width = 160, golden_height = 120;

/** \brief Pixels of which no channel is off by more than what another compiler's or
 * another library's last bit makes. */
inline double
partOfAlike(const pcl_uvol::Image& a, const pcl_uvol::Image& b)
{
  std::size_t alike = 0;
  for (std::size_t i = 0; i < a.pixels(); ++i) {
    bool is_alike = true;
    for (std::size_t k = 4 * i; k < 4 * i + 4; ++k)
      is_alike &= std::abs(a.color[k] - b.color[k]) <= 2;
    alike += is_alike ? 1 : 0;
  }
  return static_cast<double>(alike) / static_cast<double>(a.pixels());
}

/** \brief Hold a picture to the one of that name. */
inline void
expectGolden(const std::string& name, const pcl_uvol::Image& image)
{
  const std::string path =
      std::string(PCL_UVOL_SOURCE_DIR "/tests/render/golden/") + name + ".png";
  if (std::getenv("PCL_UVOL_WRITE_GOLDEN_IMAGES") != nullptr)
    pcl_uvol::savePng(path, image);
  int channels = 0;
  const pcl_uvol::Image golden = readPng(path, channels);
  ASSERT_EQ(golden.width, image.width) << path;
  ASSERT_EQ(golden.height, image.height) << path;
  EXPECT_GE(partOfAlike(image, golden), 0.998) << path;
}

} // namespace uvol_test
