// SPDX-License-Identifier: BSD-3-Clause
// A file without a name: it is gone with the process, however that ends.
#pragma once

#include <pcl_uvol/common/export.h>

#include <cstddef>
#include <cstdint>
#include <string>

namespace pcl_uvol {

/** \brief Bytes on disk for the time of a run. */
class PCL_UVOL_EXPORTS ScratchFile {
public:
  /** \throws IOError if the folder takes no files */
  explicit ScratchFile(const std::string& folder);
  ScratchFile(const ScratchFile&) = delete;
  ScratchFile&
  operator=(const ScratchFile&) = delete;
  ~ScratchFile();

  std::uint64_t
  size() const
  {
    return size_;
  }

  /** \throws IOError, naming the folder, if the disk is full @{ */
  void
  append(const void* data, std::size_t size)
  {
    write(size_, data, size);
  }
  void
  write(std::uint64_t offset, const void* data, std::size_t size);
  /** @} */

  /** \throws IOError */
  void
  read(std::uint64_t offset, void* data, std::size_t size) const;

  /** \brief Give room back that is not read again, where the file system can. */
  void
  release(std::uint64_t offset, std::uint64_t size);

private:
  std::string folder_;
  int descriptor_;
  std::uint64_t size_ = 0;
};

} // namespace pcl_uvol
