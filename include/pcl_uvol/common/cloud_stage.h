// SPDX-License-Identifier: BSD-3-Clause
// The input of the stages: that of pcl::PCLBase, checked and viewed in one place.
#pragma once

#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/common/exceptions.h>

#include <pcl/impl/pcl_base.hpp>
#include <pcl/pcl_base.h>

#include <string>
#include <type_traits>

namespace pcl_uvol {

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

  /** \brief For stages that keep what they made of the input. */
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
    if (!this->input_ || !this->initCompute())
      throw InvalidArgument(std::string(stage) +
                            " has no input cloud: call setInputCloud.");
    const CloudView cloud = viewOf(*this->input_);
    detail::checkIndices(*this->indices_, cloud.count, stage);
    work(cloud, *this->indices_);
    this->deinitCompute();
  }
};

} // namespace pcl_uvol
