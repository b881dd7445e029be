// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/common/scalar_field.h>

namespace pcl_uvol {

CloudView
viewOf(const pcl::PCLPointCloud2& cloud)
{
  const auto* const x = findField(cloud.fields, "x");
  const auto* const y = findField(cloud.fields, "y");
  const auto* const z = findField(cloud.fields, "z");
  const bool floats = x && y && z && x->datatype == pcl::PCLPointField::FLOAT32 &&
                      y->datatype == pcl::PCLPointField::FLOAT32 &&
                      z->datatype == pcl::PCLPointField::FLOAT32;
  if (!floats || y->offset != x->offset + sizeof(float) ||
      z->offset != y->offset + sizeof(float) || x->offset % alignof(float) != 0 ||
      cloud.point_step % alignof(float) != 0)
    throw InvalidArgument(
        "The cloud needs consecutive, aligned float32 fields x, y, z; "
        "it has " +
        describeFields(cloud.fields) + ".");
  CloudView view;
  view.data = cloud.data.data();
  view.count = static_cast<std::size_t>(cloud.width) * cloud.height;
  view.point_step = cloud.point_step;
  view.xyz_offset = x->offset;
  view.fields = cloud.fields;
  if (cloud.data.size() < view.count * view.point_step)
    throw InvalidArgument("The cloud holds fewer bytes than its " +
                          std::to_string(view.count) + " points need.");
  return view;
}

} // namespace pcl_uvol
