// SPDX-License-Identifier: BSD-3-Clause
#include "distributed/scratch_file.h"

#include "common/memory.h"
#include <pcl_uvol/common/exceptions.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <stdlib.h>
#include <unistd.h>

namespace pcl_uvol {

ScratchFile::ScratchFile(const std::string& folder)
    : folder_(folder)
    , descriptor_(::open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0600))
{
  if (descriptor_ < 0) { // not every file system has files without a name
    std::string path = folder + "/uvol_XXXXXX";
    descriptor_ = ::mkostemp(path.data(), O_CLOEXEC);
    if (descriptor_ >= 0)
      ::unlink(path.c_str());
  }
  if (descriptor_ < 0)
    throw IOError("scratch_folder_refused",
                  {{"folder", folder}, {"reason", std::strerror(errno)}});
}

ScratchFile::~ScratchFile()
{
  ::close(descriptor_);
}

void
ScratchFile::write(std::uint64_t offset, const void* data, std::size_t size)
{
  const auto* next = static_cast<const std::uint8_t*>(data);
  while (size > 0) {
    const ssize_t written =
        ::pwrite(descriptor_, next, size, static_cast<off_t>(offset));
    if (written < 0 && errno == EINTR)
      continue;
    if (written <= 0)
      throw IOError("scratch_folder_full",
                    {{"folder", folder_},
                     {"size", formatBytes(static_cast<double>(size_))},
                     {"reason", std::strerror(errno)}});
    next += written;
    size -= static_cast<std::size_t>(written);
    offset += static_cast<std::uint64_t>(written);
    size_ = std::max(size_, offset);
  }
}

void
ScratchFile::read(std::uint64_t offset, void* data, std::size_t size) const
{
  auto* next = static_cast<std::uint8_t*>(data);
  while (size > 0) {
    const ssize_t got = ::pread(descriptor_, next, size, static_cast<off_t>(offset));
    if (got < 0 && errno == EINTR)
      continue;
    if (got <= 0)
      throw IOError("scratch_file_lost",
                    {{"folder", folder_},
                     {"reason", got == 0 ? "it is too short" : std::strerror(errno)}});
    next += got;
    size -= static_cast<std::size_t>(got);
    offset += static_cast<std::uint64_t>(got);
  }
}

void
ScratchFile::release(std::uint64_t offset, std::uint64_t size)
{
  // What is not given back now is given back at the end.
  static_cast<void>(::fallocate(descriptor_,
                                FALLOC_FL_PUNCH_HOLE | FALLOC_FL_KEEP_SIZE,
                                static_cast<off_t>(offset),
                                static_cast<off_t>(size)));
}

} // namespace pcl_uvol
