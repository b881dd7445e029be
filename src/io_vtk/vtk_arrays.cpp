// SPDX-License-Identifier: BSD-3-Clause
#include "io_vtk/vtk_arrays.h"

#include "common/numbers.h"
#include "common/printable.h"
#include "common/scalar_field.h"
#include "io_vtk/vtk_readers.h"

#include <pcl/PCLPointField.h>
#include <vtkDataSet.h>
#include <vtkPointData.h>
#include <vtkPointSet.h>

#include <algorithm>
#include <limits>

namespace pcl_uvol {
namespace io {
namespace {

using Type = pcl::PCLPointField;

/** Types without an XML name are written under another one there. */
constexpr VtkType types[] = {
    {"Float32", "float", VTK_TYPE_FLOAT32, Type::FLOAT32},
    {"Float64", "double", VTK_TYPE_FLOAT64, Type::FLOAT64},
    {"Int8", "char", VTK_TYPE_INT8, Type::INT8},
    {"", "signed_char", VTK_TYPE_INT8, Type::INT8},
    {"UInt8", "unsigned_char", VTK_TYPE_UINT8, Type::UINT8},
    {"Int16", "short", VTK_TYPE_INT16, Type::INT16},
    {"UInt16", "unsigned_short", VTK_TYPE_UINT16, Type::UINT16},
    {"Int32", "int", VTK_TYPE_INT32, Type::INT32},
    {"UInt32", "unsigned_int", VTK_TYPE_UINT32, Type::UINT32},
    {"Int64", "vtktypeint64", VTK_TYPE_INT64, Type::INT64},
    {"UInt64", "vtktypeuint64", VTK_TYPE_UINT64, Type::UINT64},
    {"", "long", VTK_TYPE_INT64, Type::INT64},
    {"", "unsigned_long", VTK_TYPE_UINT64, Type::UINT64},
    {"", "long_long", VTK_TYPE_INT64, Type::INT64},
    {"", "unsigned_long_long", VTK_TYPE_UINT64, Type::UINT64},
    {"", "vtkidtype", VTK_TYPE_INT32, Type::INT32}, // in the file
};

const VtkType*
findType(std::string_view VtkType::*family, std::string_view name)
{
  const auto* const found =
      std::find_if(std::begin(types), std::end(types), [&](const VtkType& type) {
        return type.*family == name;
      });
  return found == std::end(types) || name.empty() ? nullptr : found;
}

} // namespace

const VtkType*
findXmlType(std::string_view name)
{
  return findType(&VtkType::xml, name);
}

const VtkType*
findLegacyType(std::string_view name)
{
  return findType(&VtkType::legacy, name);
}

vtkSmartPointer<vtkDataArray>
makeArray(const VtkType& type,
          const std::string& name,
          std::uint64_t components,
          std::uint64_t tuples)
{
  auto array =
      vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(type.vtk_type));
  if (!name.empty())
    array->SetName(name.c_str());
  array->SetNumberOfComponents(static_cast<int>(components));
  array->SetNumberOfTuples(static_cast<vtkIdType>(tuples));
  return array;
}

void
checkArrayCount(const std::string& path, std::size_t arrays)
{
  if (arrays > most_vtk_arrays)
    throwUnreadable(path,
                    {"too_many_parts",
                     "it",
                     most_vtk_arrays,
                     "arrays, which VTK takes minutes for"});
}

Message
describeTexts(const std::string& name)
{
  return {"array_of_texts", {{"array", shortenText(name)}, {"type", "vtkStringArray"}}};
}

void
checkLattice(const std::string& path, vtkDataSet& data)
{
  if (!vtkPointSet::SafeDownCast(&data) && !data.GetPointData()->GetArray(0))
    throwUnreadable(path, {"nothing_inside", "numbers at the points of its grid"});
}

std::uint8_t*
bytesOf(vtkDataArray& array)
{
  return static_cast<std::uint8_t*>(array.GetVoidPointer(0));
}

void
readTexts(const std::string& path,
          FileCursor& cursor,
          std::uint64_t end,
          std::uint8_t datatype,
          std::uint64_t count,
          std::uint8_t* bytes)
{
  const std::size_t size = datatypeSize(datatype);
  std::string_view word;
  for (std::uint64_t i = 0; i < count; ++i, bytes += size) {
    if (!cursor.nextWord(word))
      throwUnreadable(path, {"truncated_part", "an array"});
    if (const std::uint64_t behind = cursor.tell().offset; behind > end)
      word = word.substr(
          0, word.size() - std::min<std::uint64_t>(word.size(), behind - end));
    if (!parseNumber(word, datatype, bytes))
      throwUnreadable(path,
                      cursor.tell().line + 1,
                      {"unexpected_word", shortenText(word), "a number of an array"});
  }
}

void
checkFits(const std::string& path,
          std::string_view array,
          std::uint64_t components,
          std::uint64_t tuples,
          std::uint64_t size,
          std::uint64_t left)
{
  if (components < 1 || components > std::numeric_limits<std::int32_t>::max() ||
      (tuples > 0 && components > left / size / tuples))
    throwUnreadable(path,
                    {"truncated_data",
                     tuples,
                     "tuples of " + std::to_string(components) +
                         " numbers of the array " + quoteText(array),
                     left});
}

} // namespace io
} // namespace pcl_uvol
