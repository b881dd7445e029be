// SPDX-License-Identifier: BSD-3-Clause
// A cloud of any point type as bytes and fields, which is what the plain kernels read;
// and the input of the stages: that of pcl::PCLBase, checked and viewed in one place.
#pragma once

#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/common/export.h>

#include <pcl/PCLPointCloud2.h>
#include <pcl/conversions.h>
#include <pcl/impl/pcl_base.hpp>
#include <pcl/pcl_base.h>
#include <pcl/point_cloud.h>
#include <pcl/types.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

namespace pcl_uvol {

/** \brief Refers to a cloud, which must outlive it. x, y, z are consecutive floats. If
 * the cloud has other coordinates, for example doubles, the view refers to a copy. */
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
 * \throws InvalidArgument without x, y and z, and for a field beyond the end of the
 * points or of an unknown type. Also for fewer bytes than points, big endian, and more
 * points than PCL's indices can number */
PCL_UVOL_EXPORTS CloudView
makeView(const CloudBytes& bytes, const std::vector<pcl::PCLPointField>& fields);

/** \brief Indices that a user gave.
 * \param stage name for the messages
 * \throws InvalidArgument for none, and for one that is no point of the cloud */
PCL_UVOL_EXPORTS void
checkIndices(const pcl::Indices& indices, std::size_t count, const char* stage);

/** \brief Room for the indices of all points, which PCL fills. */
PCL_UVOL_EXPORTS pcl::IndicesPtr
makeIndices(std::size_t count);

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

/** \brief Base of the stages that take a cloud, and indices of its points.
 * \tparam PointT any registered point type with x, y, z, or pcl::PCLPointCloud2 */
template <typename PointT>
class CloudStage : public pcl::PCLBase<PointT> {
public:
  using Cloud = std::conditional_t<std::is_same_v<PointT, pcl::PCLPointCloud2>,
                                   pcl::PCLPointCloud2,
                                   pcl::PointCloud<PointT>>;

  /** \brief The cloud to work on; null: none. What was made of an earlier one, or of
   * this one before it changed in place, is forgotten. */
  void
  // NOLINTNEXTLINE: PCLBase<PCLPointCloud2> has it, but not as a virtual function
  setInputCloud(const typename Cloud::ConstPtr& cloud)
  {
    if (cloud)
      pcl::PCLBase<PointT>::setInputCloud(cloud);
    else // PCLBase<PCLPointCloud2> would look into it
      this->input_.reset();
    forgetInput();
  }

protected:
  CloudStage() = default;

  /** \brief For stages that keep data computed from the input. */
  virtual void
  forgetInput()
  {
  }

  /** \brief Call work(cloud, indices): a view of the cloud, and the points to take.
   * \param stage name for the messages
   * \param work called with a CloudView and pcl::Indices
   * \throws InvalidArgument without an input cloud, and for indices that are no points
   * of it */
  template <typename WorkT>
  void
  withInput(const char* stage, const WorkT& work)
  {
    if (this->input_ && !this->indices_) {
      this->fake_indices_ = true;
      this->indices_ = detail::makeIndices(viewOf(*this->input_).count);
    }
    if (!this->input_ || !this->initCompute())
      throw InvalidArgument("stage_without_cloud", {{"stage", stage}});
    const CloudView cloud = viewOf(*this->input_);
    detail::checkIndices(*this->indices_, cloud.count, stage);
    work(cloud, *this->indices_);
    this->deinitCompute();
  }
};

} // namespace pcl_uvol
