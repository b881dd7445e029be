// SPDX-License-Identifier: BSD-3-Clause
#include "io_vtk/vtk_legacy_body.h"

#include "common/numbers.h"
#include "common/printable.h"
#include "common/scalar_field.h"
#include "io/formats.h"
#include "io/little_endian.h"

#include <pcl/PCLPointField.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace pcl_uvol {
namespace io {

std::string
decodeLegacyName(std::string_view text)
{
  const auto digit = [](char c) {
    return c >= '0' && c <= '9'   ? c - '0'
           : c >= 'a' && c <= 'f' ? c - 'a' + 10
           : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                  : -1;
  };
  std::string name;
  for (std::size_t at = 0; at < text.size(); ++at)
    if (text[at] == '%' && at + 2 < text.size() && digit(text[at + 1]) >= 0 &&
        digit(text[at + 2]) >= 0) {
      name += static_cast<char>(16 * digit(text[at + 1]) + digit(text[at + 2]));
      at += 2;
    }
    else
      name += text[at];
  return name;
}

LegacyBody::LegacyBody(const std::string& path, FileCursor& cursor, bool is_binary)
    : path_(path)
    , cursor_(cursor)
    , is_binary_(is_binary)
{
}

void
LegacyBody::fail(const FileReason& reason) const
{
  throwUnreadable(path_, cursor_.tell().line, reason);
}

void
LegacyBody::skipNumbers(const VtkType& type, std::uint64_t count)
{
  const std::uint64_t size = datatypeSize(type.datatype);
  if (is_binary_) {
    if (count > cursor_.left() / size)
      fail({"truncated_data", count, "numbers", cursor_.left()});
    cursor_.skip(size * count);
    return;
  }
  std::string_view ignored;
  for (std::uint64_t i = 0; i < count; ++i)
    if (!cursor_.nextWord(ignored))
      fail({"truncated_part", "an array"});
}

namespace {

/** Whether floating-point numbers are of sizes that data have: of swapped bytes most
 * are not. Looks at a thousand of them. */
template <typename T>
bool
areUsual(const std::uint8_t* bytes, std::uint64_t numbers)
{
  constexpr double least = 1e-20, largest = 1e20;
  const std::uint64_t step = std::max<std::uint64_t>(numbers / 1000, 1);
  std::uint64_t usual = 0, seen = 0;
  for (std::uint64_t i = 0; i < numbers; i += step, ++seen) {
    T number;
    std::memcpy(&number, bytes + i * sizeof(T), sizeof(T));
    const auto size = static_cast<double>(std::abs(number));
    usual += size == 0.0 || (size > least && size < largest);
  }
  return 4 * usual > 3 * seen;
}

bool
arePlain(std::uint8_t datatype, const std::uint8_t* bytes, std::uint64_t numbers)
{
  if (datatype == pcl::PCLPointField::FLOAT32)
    return areUsual<float>(bytes, numbers);
  return datatype == pcl::PCLPointField::FLOAT64 && areUsual<double>(bytes, numbers);
}

} // namespace

vtkSmartPointer<vtkDataArray>
LegacyBody::readArray(std::string_view type_name,
                      const std::string& name,
                      std::uint64_t components,
                      std::uint64_t tuples)
{
  const bool bits = type_name == "bit";
  const VtkType* const type = findLegacyType(bits ? "unsigned_char" : type_name);
  if (!type)
    fail({"unsupported_value",
          "the type of the array " + quoteText(name),
          shortenText(type_name),
          "types of numbers"});
  const std::uint64_t size = is_binary_ ? datatypeSize(type->datatype) : 2;
  checkFits(path_,
            name,
            components,
            tuples,
            size,
            (cursor_.left() + 1) * (bits && is_binary_ ? 8 : 1));
  vtkSmartPointer<vtkDataArray> array = makeArray(*type, name, components, tuples);
  const std::uint64_t numbers = components * tuples;
  std::uint8_t* const bytes = bytesOf(*array);
  if (!is_binary_)
    readTexts(path_,
              cursor_,
              std::numeric_limits<std::uint64_t>::max(),
              type->datatype,
              numbers,
              bytes);
  else if (bits) {
    const auto packed_bytes = static_cast<std::size_t>((numbers + 7) / 8);
    const char* const packed = cursor_.take(packed_bytes);
    if (!packed)
      fail({"truncated_part", "an array"});
    for (std::uint64_t i = 0; i < numbers; ++i)
      bytes[i] = static_cast<std::uint8_t>(packed[i / 8] >> (7 - i % 8) & 1);
  }
  else {
    if (numbers > cursor_.left() / size)
      fail({"truncated_part", "an array"});
    cursor_.getFile().read(cursor_.tell().offset, bytes, numbers * size);
    cursor_.skip(numbers * size);
    const bool are_plain = name == "Points" && arePlain(type->datatype, bytes, numbers);
    swapBytes(bytes, size, numbers); // the files are big-endian
    if (are_plain && !arePlain(type->datatype, bytes, numbers))
      throwUnreadable(path_, {"swapped_bytes", shortenText(name)});
  }
  if (type_name == "vtkidtype") { // written as int
    vtkSmartPointer<vtkDataArray> ids =
        makeArray(*findLegacyType("vtktypeint64"), name, components, tuples);
    ids->DeepCopy(array);
    return ids;
  }
  return array;
}

void
LegacyBody::skipTexts(std::uint64_t count)
{
  std::string_view ignored;
  for (std::uint64_t i = 0; i < count; ++i) {
    if (!is_binary_) {
      if (!cursor_.nextLine(ignored))
        fail({"truncated_part", "an array"});
      continue;
    }
    // The two highest bits tell how many bytes the length has: 8, 4, 2, 1.
    const char* at = cursor_.take(1);
    std::uint64_t length = at ? static_cast<unsigned char>(*at) & 0x3f : 0;
    const int more = at ? (8 >> (static_cast<unsigned char>(*at) >> 6)) - 1 : 0;
    for (int byte = 0; byte < more && at; ++byte)
      if ((at = cursor_.take(1)) != nullptr)
        length = length << 8 | static_cast<unsigned char>(*at);
    if (!at || !cursor_.skip(length))
      fail({"truncated_part", "an array"});
  }
}

void
LegacyBody::skipMetadata()
{
  std::string_view line;
  while (cursor_.nextLine(line) && !trimmed(line).empty())
    continue;
}

} // namespace io
} // namespace pcl_uvol
