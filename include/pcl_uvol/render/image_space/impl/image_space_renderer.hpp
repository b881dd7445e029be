// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/render/image_space/image_space_renderer.h>

namespace pcl_uvol {

template <typename PointT>
void
ImageSpaceRenderer<PointT>::render(Image& image)
{
  if (!this->input_ || !this->initCompute())
    throw InvalidArgument("ImageSpaceRenderer has no input cloud: call setInputCloud.");
  renderFrom(viewOf(*this->input_), this->indices_, image);
  this->deinitCompute();
}

template <typename PointT>
void
ImageSpaceRenderer<PointT>::draw(const View& view, const Painter& painter)
{
  if (!this->input_ || !this->initCompute())
    throw InvalidArgument("ImageSpaceRenderer has no input cloud: call setInputCloud.");
  drawFrom(viewOf(*this->input_), this->indices_, view, painter);
  this->deinitCompute();
}

template <typename PointT>
BoundingSphere
ImageSpaceRenderer<PointT>::getBounds()
{
  if (!this->input_ || !this->initCompute())
    throw InvalidArgument("ImageSpaceRenderer has no input cloud: call setInputCloud.");
  BoundingSphere bounds = prepare(viewOf(*this->input_), this->indices_).getBounds();
  this->deinitCompute();
  return bounds;
}

} // namespace pcl_uvol
