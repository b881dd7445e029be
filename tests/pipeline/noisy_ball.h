// SPDX-License-Identifier: BSD-3-Clause
// A ball of noisy samples, and the columns of what is made of them.
#pragma once

#include "common/scalar_field.h"
#include "support/environment.h"
#include <pcl_uvol/pipeline/isosurface_pipeline.h>

#include <pcl/conversions.h>
#include <pcl/point_types.h>

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace uvol_test {

/** A ball of noisy samples with a second field. */
inline std::shared_ptr<pcl_uvol::Dataset>
makeSamples(std::size_t n = 4000)
{
  Random random(3);
  pcl::PointCloud<pcl::PointXYZI> cloud;
  std::vector<float> second;
  for (std::size_t i = 0; i < n; ++i) {
    pcl::PointXYZI point;
    for (int axis = 0; axis < 3; ++axis)
      point.data[axis] = static_cast<float>(2.0 * random.uniform() - 1.0);
    point.intensity = 0.7f - point.getVector3fMap().norm() +
                      0.02f * static_cast<float>(random.uniform() - 0.5);
    cloud.push_back(point);
    second.push_back(point.x + 2.0f * point.y);
  }
  auto samples = std::make_shared<pcl_uvol::Dataset>();
  pcl::toPCLPointCloud2(cloud, samples->cloud);
  pcl_uvol::setField(*samples, "second", second);
  samples->origin = {{1000.0, 0.0, -5.0}};
  samples->double_coordinates = true;
  return samples;
}

inline pcl_uvol::IsosurfacePipelineParameters
makeParameters(double isovalue = 0.0)
{
  pcl_uvol::IsosurfacePipelineParameters parameters;
  parameters.isosurface.isovalues = {isovalue};
  return parameters;
}

inline float
readField(const pcl_uvol::Dataset& dataset, std::size_t point, const std::string& name)
{
  const pcl_uvol::CloudView view = pcl_uvol::viewOf(dataset.cloud);
  return static_cast<float>(
      pcl_uvol::ScalarField(view.fields, name).read(view.point(point)));
}

inline std::vector<float>
readColumn(const pcl_uvol::Dataset& dataset, const std::string& name)
{
  std::vector<float> values;
  for (std::size_t i = 0; i < dataset.cloud.width; ++i)
    values.push_back(readField(dataset, i, name));
  return values;
}

} // namespace uvol_test
