// SPDX-License-Identifier: BSD-3-Clause
// The numbers of volumes whose headers are lines of text: MetaImage and NRRD.
#pragma once

#include <pcl_uvol/common/export.h>
#include <pcl_uvol/io/dataset.h>

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace pcl_uvol {
namespace io {

/** \brief Where the numbers of a volume are, and how they are written. */
struct VolumeData {
  enum class Encoding { Raw, Ascii, Zipped };

  std::uint8_t datatype = 0; ///< pcl::PCLPointField::PointFieldTypes
  Encoding encoding = Encoding::Raw;
  bool big_endian = false;
  std::vector<std::string> files; ///< the volume's layers in turn, in equal parts
  std::uint64_t offset = 0;       ///< of the first line behind a header in the file
  std::uint64_t skipped_lines = 0;
  std::uint64_t skipped_bytes = 0; ///< of the unpacked data
  bool at_end = false;             ///< the numbers are the last bytes of a file
};

/** \brief Sets the sizes of a volume.
 * \throws IOError unless they are three from 1 on */
void
setDims(const std::string& path,
        const std::vector<std::string_view>& words,
        Volume& volume);

/** \brief Sets spacing from the direction of an axis.
 * \throws IOError for one that is not parallel to its coordinate */
void
setDirection(const std::string& path,
             std::size_t axis,
             const std::array<double, 3>& direction,
             Volume& volume);

/** \brief A name in the folder of a header. */
std::string
besideFile(const std::string& path, std::string_view name);

/** \brief The files that a pattern with one %d, as in slice%03d.raw, stands for.
 * \param words pattern, first, last, step
 * \throws IOError for files that are not there, and for any other pattern */
std::vector<std::string>
expandPattern(const std::string& path, const std::vector<std::string_view>& words);

/** \brief Read the numbers; nothing larger than the files allow is ever held.
 * \param volume has its sizes
 * \throws IOError */
void
readValues(const std::string& path, const VolumeData& data, Volume& volume);

/** \brief Readers of files. @{ */
Volume
readMetaImage(const std::string& path);
Volume
readNrrd(const std::string& path);
/** @} */

/** \brief The files of the numbers, as headers name them; the header's own, too.
 * \throws IOError @{ */
std::vector<std::string>
findMetaImageFiles(const std::string& path);
std::vector<std::string>
findNrrdFiles(const std::string& path);
/** @} */

/** \brief The files of the numbers of any volume; none where these, or the header,
 * cannot be read. */
std::vector<std::string>
findVolumeFiles(const std::string& path);

/** \throws IOError that says what to do with axes that are not x, y and z */
[[noreturn]] PCL_UVOL_EXPORTS void
throwOblique(const std::string& path);

} // namespace io
} // namespace pcl_uvol
