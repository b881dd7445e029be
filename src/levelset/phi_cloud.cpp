// SPDX-License-Identifier: BSD-3-Clause
#include "levelset/phi_cloud.h"

#include "common/records.h"
#include <pcl_uvol/common/exceptions.h>

#include <cstring>
#include <string>

namespace pcl_uvol {

pcl::PCLPointCloud2
makePhiCloud(const CloudView& cloud, const std::vector<float>& phi)
{
  if (phi.size() != cloud.count)
    throw InvalidArgument("phi_of_other_points",
                          {{"values", phi.size()}, {"points", cloud.count}});
  Fields fields;
  for (const char* const name : {"x", "y", "z", "phi"})
    appendField(fields, name, pcl::PCLPointField::FLOAT32);
  pcl::PCLPointCloud2 result = makeRecords(std::move(fields), phi.size());
  result.is_dense = 0;
  for (std::size_t i = 0; i < phi.size(); ++i) {
    std::uint8_t* const point = result.data.data() + i * result.point_step;
    std::memcpy(point, cloud.xyz(i), 3 * sizeof(float));
    std::memcpy(point + 3 * sizeof(float), &phi[i], sizeof(float));
  }
  return result;
}

} // namespace pcl_uvol
