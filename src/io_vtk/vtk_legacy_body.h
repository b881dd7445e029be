// SPDX-License-Identifier: BSD-3-Clause
// What stands behind the keywords of a legacy VTK file: numbers, texts, names.
#pragma once

#include "io/file_cursor.h"
#include "io_vtk/vtk_arrays.h"

#include <vtkDataArray.h>
#include <vtkSmartPointer.h>

#include <cstdint>
#include <string>
#include <string_view>

namespace pcl_uvol {
namespace io {

/** \brief A name as it was before blanks and the like were written as %20. */
std::string
decodeLegacyName(std::string_view text);

/** \brief Takes data from where a cursor stands.
 *
 * All throw IOError where the file ends before. */
class LegacyBody {
public:
  /** \param path, cursor must outlive this
   * \param is_binary numbers are big-endian, else texts */
  LegacyBody(const std::string& path, FileCursor& cursor, bool is_binary);

  bool
  isBinary() const
  {
    return is_binary_;
  }

  /** \brief An array of a type that the format has; bits become bytes. */
  vtkSmartPointer<vtkDataArray>
  readArray(std::string_view type,
            const std::string& name,
            std::uint64_t components,
            std::uint64_t tuples);

  void
  skipNumbers(const VtkType& type, std::uint64_t count);

  /** \brief Pass over texts, which have a line each, or their length in front. */
  void
  skipTexts(std::uint64_t count);

  /** \brief Pass over lines up to an empty one. */
  void
  skipMetadata();

private:
  [[noreturn]] void
  fail(const FileReason& reason) const;

  const std::string& path_;
  FileCursor& cursor_;
  bool is_binary_;
};

} // namespace io
} // namespace pcl_uvol
