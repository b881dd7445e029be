// SPDX-License-Identifier: BSD-3-Clause
// Bytes of arrays in VTK's XML files: as they are or in base64, packed or not.
#pragma once

#include "io/files.h"

#include <cstdint>
#include <string>
#include <vector>

class vtkDataCompressor;

namespace pcl_uvol {
namespace io {

/** \brief A part of a file from front to back. */
class EncodedBytes {
public:
  /** \param begin, end of the part in the file */
  EncodedBytes(const std::string& path,
               const InputFile& file,
               std::uint64_t begin,
               std::uint64_t end,
               bool base64)
      : path_(path)
      , file_(file)
      , next_(begin)
      , end_(end)
      , base64_(base64)
  {
  }

  /** \brief The most bytes that can follow. */
  std::uint64_t
  left() const;

  /** \throws IOError for damaged base64, and for fewer bytes */
  void
  read(void* bytes, std::uint64_t count);

private:
  void
  decode();

  const std::string& path_;
  const InputFile& file_;
  std::uint64_t next_;
  const std::uint64_t end_;
  const bool base64_;
  std::string text_;    ///< taken from the file
  std::string decoded_; ///< of the text
  std::size_t taken_ = 0;
};

/** \brief How the arrays of a file are written. */
struct ArrayEncoding {
  bool big_endian = false;
  bool wide_headers = false; ///< numbers in front of the bytes have 8 bytes, not 4
  vtkDataCompressor* compressor = nullptr; ///< null: not packed
  std::uint64_t most_expansion = 1;        ///< by unpacking
};

/** \brief Read the bytes of an array with the numbers in front of them.
 * \param count of the bytes that the array has
 * \throws IOError for fewer */
void
readBlocks(const std::string& path,
           EncodedBytes& source,
           const ArrayEncoding& encoding,
           std::uint64_t count,
           std::uint8_t* bytes);

/** \brief Look at the numbers in front of the bytes only.
 * \param count of the bytes that the array has
 * \throws IOError unless that many are there */
void
checkBlocks(const std::string& path,
            EncodedBytes& source,
            const ArrayEncoding& encoding,
            std::uint64_t count);

} // namespace io
} // namespace pcl_uvol
