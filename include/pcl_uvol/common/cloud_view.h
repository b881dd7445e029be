// SPDX-License-Identifier: BSD-3-Clause
// A cloud of any point type as bytes and fields: what the plain kernels read.
#pragma once

#include <pcl_uvol/common/export.h>

#include <pcl/PCLPointCloud2.h>
#include <pcl/conversions.h>
#include <pcl/point_cloud.h>
#include <pcl/types.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace pcl_uvol {

/** \brief Refers to a cloud, which must outlive it. x, y, z are consecutive floats: a
 * cloud that has them otherwise, as doubles, say, is referred to as a copy of its own.
 */
struct PCL_UVOL_EXPORTS CloudView {
  const std::uint8_t* data = nullptr;
  std::size_t count = 0;
  std::size_t point_step = 0; ///< bytes from point to point, a multiple of 4
  std::size_t xyz_offset = 0; ///< bytes from the start of a point to x, a multiple of 4
  std::vector<pcl::PCLPointField> fields;
  std::shared_ptr<const std::vector<std::uint8_t>>
      copy; ///< that data refers to, or null

  /** \brief The bytes of a point.
   * \param index below count */
  const std::uint8_t*
  point(std::size_t index) const
  {
    return data + index * point_step;
  }

  /** \brief The three coordinates of a point.
   * \param index below count */
  const float*
  xyz(std::size_t index) const
  {
    return reinterpret_cast<const float*>(point(index) + xyz_offset);
  }

  /** \brief Floats from one point's x to the next one's. */
  std::size_t
  stride() const
  {
    return point_step / sizeof(float);
  }
};

namespace detail {

/** \brief The bytes of a cloud, as a point type or a file lays them out. */
struct CloudBytes {
  const std::uint8_t* data;
  std::size_t size; ///< bytes
  std::size_t width, height, point_step, row_step;
  bool is_big_endian;
};

/** \brief Check a layout, and lay the points out anew where x, y, z are not consecutive
 * aligned floats or rows are padded.
 * \throws InvalidArgument without x, y and z, for a field beyond the end of the points
 * or of an unknown type, for fewer bytes than points, big endian, more points than
 * PCL's indices can number */
PCL_UVOL_EXPORTS CloudView
makeView(const CloudBytes& bytes, const std::vector<pcl::PCLPointField>& fields);

/** \brief Indices that a user gave.
 * \param stage name for the messages
 * \throws InvalidArgument for none, and for one that is no point of the cloud */
PCL_UVOL_EXPORTS void
checkIndices(const pcl::Indices& indices, std::size_t count, const char* stage);

} // namespace detail

/** \brief View of a cloud of a registered point type with x, y, z of any numeric type.
 * \param cloud must outlive the view
 * \throws InvalidArgument for more points than PCL's indices can number */
template <typename PointT>
CloudView
viewOf(const pcl::PointCloud<PointT>& cloud)
{
  // As pcl::getFields does, whose header needs all of PCL's point types.
  std::vector<pcl::PCLPointField> fields;
  pcl::for_each_type<typename pcl::traits::fieldList<PointT>::type>(
      pcl::detail::FieldAdder<PointT>(fields));
  const std::size_t bytes = cloud.size() * sizeof(PointT);
  return detail::makeView({reinterpret_cast<const std::uint8_t*>(cloud.points.data()),
                           bytes,
                           cloud.size(),
                           1,
                           sizeof(PointT),
                           bytes,
                           false},
                          fields);
}

/** \brief View of a cloud with fields known at run time only.
 * \param cloud must outlive the view
 * \throws InvalidArgument as detail::makeView */
PCL_UVOL_EXPORTS CloudView
viewOf(const pcl::PCLPointCloud2& cloud);

} // namespace pcl_uvol
