// SPDX-License-Identifier: BSD-3-Clause
// What samples are like, told by pieces and by all of them.
#pragma once

#include "neighbors/sampling.h"
#include <pcl_uvol/isosurface/isosurface_extraction.h>

#include <gtest/gtest.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <cstddef>
#include <numeric>

namespace uvol_test {

/** \brief Expect of pieces, whose ends see neighbours on one side only, nearly what all
 * samples tell together.
 * \return the dimension of most samples */
inline pcl_uvol::LocalDimension
expectSamplingOf(const pcl::PointCloud<pcl::PointXYZI>& cloud,
                 const pcl_uvol::IsosurfaceParameters& settings,
                 const pcl_uvol::SamplingSummary& found)
{
  pcl::Indices all(cloud.size());
  std::iota(all.begin(), all.end(), 0);
  const auto whole = pcl_uvol::summarizeSampling(pcl_uvol::viewOf(cloud),
                                                 all,
                                                 settings.field,
                                                 settings.scale,
                                                 Eigen::Array3d::Zero(),
                                                 1);
  EXPECT_EQ(whole.most, found.most);
  EXPECT_NEAR(whole.along, found.along, 0.02f * whole.along);
  EXPECT_NEAR(whole.across, found.across, 0.02f * whole.across);
  for (std::size_t i = 0; i < found.shares.size(); ++i)
    EXPECT_NEAR(whole.shares[i], found.shares[i], 0.03) << i;
  return whole.most;
}

} // namespace uvol_test
