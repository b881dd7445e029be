// SPDX-License-Identifier: BSD-3-Clause
// Packed files and standard input as files that can be read at any place.
#pragma once

#include <pcl_uvol/common/export.h>

#include <cstdint>
#include <string>
#include <unistd.h>
#include <utility>

namespace pcl_uvol {
namespace io {

/** \brief A descriptor that is closed unless it is taken. */
class Descriptor {
public:
  explicit Descriptor(int descriptor)
      : descriptor_(descriptor)
  {
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor&
  operator=(const Descriptor&) = delete;
  ~Descriptor()
  {
    if (descriptor_ >= 0)
      ::close(descriptor_);
  }

  int
  get() const
  {
    return descriptor_;
  }

  int
  take()
  {
    return std::exchange(descriptor_, -1);
  }

private:
  int descriptor_;
};

/** \brief True for the names of standard input and output: "-", and with an ending that
 * chooses the format "-.csv". */
inline bool
isStandardStream(const std::string& path)
{
  return path == "-" ||
         (path.rfind("-.", 0) == 0 && path.find('/') == std::string::npos);
}

/** \brief True for names that end in .gz, .bz2 or .zst. */
bool
isPacked(const std::string& path);

/** \brief True for a file that gzip packs although its name does not tell: Partio and
 * splashsurf write .bgeo so.
 * \param file its descriptor */
bool
isPackedInside(const std::string& path, int file);

/** \brief The name without that ending. */
std::string
withoutPacking(const std::string& path);

/** \brief The folder of temporary files: TMPDIR, else /tmp. */
PCL_UVOL_EXPORTS std::string
temporaryFolder();

/** \brief A file without a name in the folder of temporary files,
 * open for reading and writing; to be closed by the caller.
 * \throws IOError about path */
int
openTemporary(const std::string& path);

/** \brief Unpack a packed file into one without a name.
 * \param packed its descriptor, at its start
 * \return a descriptor, to be closed by the caller
 * \throws IOError for damaged files and full disks */
int
unpackFile(const std::string& path, int packed);

/** \brief What standard input gave, all of it: it is read once, whoever asks.
 * \return a descriptor, to be closed by the caller
 * \throws IOError */
int
openStandardInput();

/** \brief Inflate a part of a file (raw deflate, as in zip) into a file without a name.
 * \param bytes it becomes exactly
 * \return a descriptor, to be closed by the caller
 * \throws IOError */
int
inflatePart(const std::string& path,
            int file,
            std::uint64_t offset,
            std::uint64_t packed,
            std::uint64_t bytes);

} // namespace io
} // namespace pcl_uvol
