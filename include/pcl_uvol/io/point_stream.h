// SPDX-License-Identifier: BSD-3-Clause
// Points of a file block by block, for clouds larger than memory and for processes that
// each read a part of one file.
#pragma once

#include <pcl_uvol/io/dataset.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace pcl_uvol {
namespace io {
class PointReader;
}

/** \brief Reads a file from any point on, in blocks of any size, and gives the very
 * bytes that loadDataset() gives.
 *
 * Streams are PCD (ascii, binary), PLY and text tables. Besides the block of the caller
 * a stream takes less than 2 MB, whatever the size of the file. Opening looks at all
 * points once where their layout needs it: text tables, whose columns get their types
 * from all rows, and coordinates that are not float32, whose origin depends on them
 * all. Points of binary files are found at once; in text and in PLY with lists of
 * vertices the lines passed are counted. */
class PCL_UVOL_EXPORTS PointStream {
public:
  /** \throws IOError as loadDataset() does, and for compressed PCD and VTK's files,
   * which have to be read whole; damage behind the header may be found by read() only
   * \throws InvalidArgument for columns chosen in a file that is no text */
  explicit PointStream(const std::string& path, const LoadOptions& options = {});
  PointStream(PointStream&& other) noexcept;
  PointStream&
  operator=(PointStream&& other) noexcept;
  ~PointStream();

  /** \brief What loadDataset() gives, but for the points: fields, point_step, origin,
   * notes. A copy of it with a block as its cloud is a dataset to be saved. */
  const Dataset&
  getHeader() const;

  /** \brief Number of points in the file. */
  std::uint64_t
  size() const;

  /** \brief The point that read() begins with. */
  std::uint64_t
  tell() const;

  /** \param point 0 to size() \throws InvalidArgument beyond */
  void
  seek(std::uint64_t point);

  /** \brief Read the next points.
   * \param count at most that many
   * \param[out] block gets as many as there are, with their fields; its memory is used
   * again
   * \return the number of points, 0 at the end \throws IOError */
  std::size_t
  read(std::size_t count, pcl::PCLPointCloud2& block);

  /** \brief Read points here and there; reading goes on behind the last one.
   * \param points ascending
   * \param[out] rows gets them in that order
   * \throws InvalidArgument for points that descend or are not there
   * \throws IOError */
  void
  readRows(const std::vector<std::uint64_t>& points, pcl::PCLPointCloud2& rows);

private:
  std::unique_ptr<io::PointReader> reader_;
};

} // namespace pcl_uvol
