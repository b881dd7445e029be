// SPDX-License-Identifier: BSD-3-Clause
// Arrays of VTK that are filled from files: numbers as text and as bytes.
#pragma once

#include "io/file_cursor.h"

#include <vtkDataArray.h>
#include <vtkSmartPointer.h>

#include <cstdint>
#include <string>
#include <string_view>

namespace pcl_uvol {
namespace io {

/** \brief A type of numbers under the names of both families of files. */
struct VtkType {
  std::string_view xml;    ///< "Float32"
  std::string_view legacy; ///< "float"
  int vtk_type;
  std::uint8_t datatype; ///< pcl::PCLPointField::PointFieldTypes, in the file
};

/** \brief Null for an unknown name @{ */
const VtkType*
findXmlType(std::string_view name);
const VtkType*
findLegacyType(std::string_view name);
/** @} */

/** \brief An array whose numbers are not set.
 * \param name "": none
 * \throws IOError if memory cannot hold it */
vtkSmartPointer<vtkDataArray>
makeArray(const VtkType& type,
          const std::string& name,
          std::uint64_t components,
          std::uint64_t tuples);

/** \brief The numbers of an array one behind the other. */
std::uint8_t*
bytesOf(vtkDataArray& array);

/** \brief Read numbers as text.
 * \param end of the text in the file
 * \throws IOError for what is no number, and for fewer */
void
readTexts(const std::string& path,
          FileCursor& cursor,
          std::uint64_t end,
          std::uint8_t datatype,
          std::uint64_t count,
          std::uint8_t* bytes);

/** \brief Before memory is taken.
 * \param size bytes that a number has at least
 * \throws IOError unless that many numbers fit into what is left */
void
checkFits(const std::string& path,
          std::string_view array,
          std::uint64_t components,
          std::uint64_t tuples,
          std::uint64_t size,
          std::uint64_t left);

} // namespace io
} // namespace pcl_uvol
