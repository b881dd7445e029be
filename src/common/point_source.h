// SPDX-License-Identifier: BSD-3-Clause
// Points that come block by block, of a file say, for clouds larger than memory.
#pragma once

#include <pcl_uvol/common/dataset.h>
#include <pcl_uvol/common/export.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl_uvol {

/** \brief Gives its points from any one on, in blocks of any size. */
class PCL_UVOL_EXPORTS PointSource {
public:
  PointSource() = default;
  PointSource(const PointSource&) = delete;
  PointSource&
  operator=(const PointSource&) = delete;
  virtual ~PointSource() = default;

  /** \brief The data set but for its points: fields, point_step, origin, notes. A copy
   * of it with a block as its cloud is a dataset to be saved. */
  virtual const Dataset&
  getHeader() const = 0;

  /** \brief Number of points. */
  virtual std::uint64_t
  size() const = 0;

  /** \brief The point that read() begins with. */
  virtual std::uint64_t
  tell() const = 0;

  /** \param point 0 to size()
   * \throws InvalidArgument beyond */
  virtual void
  seek(std::uint64_t point) = 0;

  /** \brief Read the next points.
   * \param count at most that many
   * \param[out] block gets as many as there are, with their fields; its memory is used
   * again
   * \return the number of points, 0 at the end
   * \throws IOError */
  virtual std::size_t
  read(std::size_t count, pcl::PCLPointCloud2& block) = 0;

  /** \brief Read points here and there; reading goes on behind the last one.
   * \param points ascending
   * \param[out] rows gets them in that order
   * \throws InvalidArgument for points that descend or are not there
   * \throws IOError */
  virtual void
  readRows(const std::vector<std::uint64_t>& points, pcl::PCLPointCloud2& rows) = 0;
};

} // namespace pcl_uvol
