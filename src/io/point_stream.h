// SPDX-License-Identifier: BSD-3-Clause
// Points of a file block by block, for clouds larger than memory and for processes that
// each read a part of one file.
#pragma once

#include "common/point_source.h"
#include <pcl_uvol/common/export.h>
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
class PCL_UVOL_EXPORTS PointStream : public PointSource {
public:
  /** \throws IOError as loadDataset() does, and for compressed PCD and VTK's files,
   * which have to be read whole; damage behind the header may be found by read() only
   * \throws InvalidArgument for columns chosen in a file that is no text */
  explicit PointStream(const std::string& path, const LoadOptions& options = {});
  ~PointStream() override;

  const Dataset&
  getHeader() const override;

  std::uint64_t
  size() const override;

  std::uint64_t
  tell() const override;

  void
  seek(std::uint64_t point) override;

  std::size_t
  read(std::size_t count, pcl::PCLPointCloud2& block) override;

  void
  readRows(const std::vector<std::uint64_t>& points,
           pcl::PCLPointCloud2& rows) override;

private:
  std::unique_ptr<io::PointReader> reader_;
  Dataset header_;
};

} // namespace pcl_uvol
