// SPDX-License-Identifier: BSD-3-Clause
// The layout is that of "HDF5 File Format Specification Version 3.0": superblock of
// version 2, object headers of version 2 with links in them, contiguous numbers.
#include "io/hdf5_writer.h"

#include "common/scalar_field.h"
#include "io/files.h"
#include "io/little_endian.h"

#include <pcl/PCLPointField.h>

#include <algorithm>
#include <array>

namespace pcl_uvol {
namespace io {
namespace {

using Type = pcl::PCLPointField;

constexpr std::uint64_t block_rows = 1u << 14;
constexpr std::uint64_t superblock_bytes = 48, alignment = 8;
constexpr std::uint64_t undefined = ~std::uint64_t(0); ///< an address

/** Messages of object headers. @{ */
constexpr std::uint8_t space_message = 0x01, links_message = 0x02, type_message = 0x03,
                       fill_message = 0x05, link_message = 0x06, layout_message = 0x08,
                       group_message = 0x0a, attribute_message = 0x0c;
/** @} */

std::uint32_t
rotated(std::uint32_t x, int bits)
{
  return x << bits | x >> (32 - bits);
}

/** Jenkins' lookup3, which headers end with. */
std::uint32_t
computeChecksum(const std::string& bytes)
{
  constexpr std::size_t words = 3, block = 12;
  std::array<std::uint32_t, words> sum;
  sum.fill(0xdeadbeef + static_cast<std::uint32_t>(bytes.size()));
  auto& [a, b, c] = sum;
  const auto mix = [](auto& x, auto& y, auto& z, int bits) {
    x = (x - z) ^ rotated(z, bits);
    z += y;
  };
  const auto finish = [](auto& x, auto& y, int bits) {
    x = (x ^ y) - rotated(y, bits);
  };
  for (std::size_t at = 0; at < bytes.size(); at += block) {
    for (std::size_t i = at; i < std::min(at + block, bytes.size()); ++i)
      sum[(i - at) / 4] += std::uint32_t{static_cast<std::uint8_t>(bytes[i])}
                           << (8 * (i % 4));
    if (at + block >= bytes.size())
      break;
    mix(a, b, c, 4);
    mix(b, c, a, 6);
    mix(c, a, b, 8);
    mix(a, b, c, 16);
    mix(b, c, a, 19);
    mix(c, a, b, 4);
  }
  finish(c, b, 14);
  finish(a, c, 11);
  finish(b, a, 25);
  finish(c, b, 16);
  finish(a, c, 4);
  finish(b, a, 14);
  finish(c, b, 24);
  return c;
}

/** The bytes with their checksum. */
std::string
sealed(std::string bytes)
{
  appendLittle(bytes, computeChecksum(bytes));
  return bytes;
}

std::string
makeType(std::uint8_t datatype)
{
  const auto size = static_cast<std::uint32_t>(datatypeSize(datatype));
  const auto bits = static_cast<std::uint16_t>(8 * size);
  const bool is_real = datatype == Type::FLOAT32 || datatype == Type::FLOAT64;
  const bool is_wide = datatype == Type::FLOAT64;
  const bool has_sign = datatype == Type::INT8 || datatype == Type::INT16 ||
                        datatype == Type::INT32 || datatype == Type::INT64;
  std::string type;
  type += static_cast<char>(is_real ? 0x11 : 0x10); // version 1, class 1 or 0
  type += static_cast<char>(is_real ? 0x20 : has_sign ? 0x08 : 0x00);
  type += static_cast<char>(is_real ? bits - 1 : 0); // where the sign is
  type += '\0';
  appendLittle(type, size);
  appendLittle(type, std::uint16_t(0)); // of the first bit
  appendLittle(type, bits);
  if (is_real) {
    type += static_cast<char>(is_wide ? 52 : 23); // where the exponent is
    type += static_cast<char>(is_wide ? 11 : 8);
    type += '\0'; // where the mantissa is
    type += static_cast<char>(is_wide ? 52 : 23);
    appendLittle(type, std::uint32_t(is_wide ? 1023 : 127));
  }
  return type;
}

/** Texts of one length, padded by zeros. */
std::string
makeTextType(std::size_t bytes)
{
  std::string type("\x13\x01\0\0", 4);
  appendLittle(type, static_cast<std::uint32_t>(bytes));
  return type;
}

/** \param sizes none: one value */
std::string
makeSpace(const std::vector<std::uint64_t>& sizes)
{
  std::string space;
  space += '\2'; // version
  space += static_cast<char>(sizes.size());
  space += '\0'; // it does not grow
  space += static_cast<char>(sizes.empty() ? 0 : 1);
  for (const std::uint64_t size : sizes)
    appendLittle(space, size);
  return space;
}

std::uint64_t
alignedUp(std::uint64_t bytes)
{
  return (bytes + alignment - 1) / alignment * alignment;
}

} // namespace

Hdf5Writer::Hdf5Writer(std::string path)
    : path_(std::move(path))
    , objects_(1)
    , known_{{"", 0}}
{
  objects_[0].is_group = true;
}

std::string
Hdf5Writer::makeMessage(std::uint8_t type, const std::string& body) const
{
  if (body.size() > UINT16_MAX)
    throwUnwritable(path_, "long_hdf5_name");
  std::string message;
  message += static_cast<char>(type);
  appendLittle(message, static_cast<std::uint16_t>(body.size()));
  message += '\0'; // no flags
  return message + body;
}

Hdf5Writer::Object&
Hdf5Writer::add(const std::string& name)
{
  const std::size_t slash = name.rfind('/');
  objects_[known_.at(name.substr(0, slash))].members.push_back(objects_.size());
  known_.emplace(name, objects_.size());
  objects_.emplace_back();
  objects_.back().name = name.substr(slash + 1);
  return objects_.back();
}

void
Hdf5Writer::addGroup(const std::string& name)
{
  add(name).is_group = true;
}

void
Hdf5Writer::addTable(const std::string& name,
                     std::uint8_t datatype,
                     std::uint64_t rows,
                     std::uint64_t components,
                     MakeRows make)
{
  Object& table = add(name);
  table.rows = rows;
  table.row_bytes = components * datatypeSize(datatype);
  table.make = std::move(make);
  std::vector<std::uint64_t> sizes{rows};
  if (components > 1)
    sizes.push_back(components);
  table.messages = makeMessage(space_message, makeSpace(sizes)) +
                   makeMessage(type_message, makeType(datatype)) +
                   makeMessage(fill_message, "\3\6"); // late, never
}

void
Hdf5Writer::addAttribute(const std::string& object,
                         const std::string& name,
                         const std::string& type,
                         const std::string& space,
                         const std::string& value)
{
  std::string body("\3\0", 2); // version, no flags
  appendLittle(body, static_cast<std::uint16_t>(name.size() + 1));
  appendLittle(body, static_cast<std::uint16_t>(type.size()));
  appendLittle(body, static_cast<std::uint16_t>(space.size()));
  body += '\0'; // its name is ASCII
  body += name + '\0' + type + space + value;
  objects_[known_.at(object)].messages += makeMessage(attribute_message, body);
}

void
Hdf5Writer::addAttribute(const std::string& object,
                         const std::string& name,
                         const std::string& text)
{
  addAttribute(object, name, makeTextType(text.size()), makeSpace({}), text);
}

void
Hdf5Writer::addAttribute(const std::string& object,
                         const std::string& name,
                         const std::vector<std::int64_t>& numbers)
{
  std::string value;
  for (const std::int64_t number : numbers)
    appendLittle(value, number);
  addAttribute(object, name, makeType(Type::INT64), makeSpace({numbers.size()}), value);
}

/** Append the headers of an object, those of its members first.
 * \param data where the numbers of objects are
 * \param start of the headers in the file
 * \return where its own header is */
std::uint64_t
Hdf5Writer::place(std::size_t object,
                  const std::vector<std::uint64_t>& data,
                  std::uint64_t start,
                  std::string& headers) const
{
  const Object& placed = objects_[object];
  std::string messages = placed.messages;
  if (placed.is_group) {
    std::string links("\0\0", 2); // version, no order of creation
    appendLittle(links, undefined);
    appendLittle(links, undefined);
    messages += makeMessage(links_message, links) +
                makeMessage(group_message, std::string("\0\0", 2));
    for (const std::size_t member : placed.members) {
      const std::string& name = objects_[member].name;
      std::string link("\1\x11\1", 3); // two bytes of length, UTF-8
      appendLittle(link, static_cast<std::uint16_t>(name.size()));
      link += name;
      appendLittle(link, place(member, data, start, headers));
      messages += makeMessage(link_message, link);
    }
  }
  else {
    std::string layout("\3\1", 2); // contiguous
    appendLittle(layout, placed.rows > 0 ? data[object] : undefined);
    appendLittle(layout, placed.rows * placed.row_bytes);
    messages += makeMessage(layout_message, layout);
  }
  std::string header("OHDR\2\2"); // four bytes of length
  appendLittle(header, static_cast<std::uint32_t>(messages.size()));
  const std::uint64_t at = start + headers.size();
  headers += sealed(header + messages);
  headers.resize(alignedUp(headers.size()));
  return at;
}

void
Hdf5Writer::save(const std::string& file) const
{
  std::vector<std::uint64_t> data;
  std::uint64_t end = superblock_bytes;
  for (const Object& object : objects_) {
    data.push_back(end);
    end = alignedUp(end + object.rows * object.row_bytes);
  }
  std::string headers;
  const std::uint64_t root = place(0, data, end, headers);
  std::string superblock("\x89HDF\r\n\x1a\n\2\10\10\0", 12); // numbers of eight bytes
  for (const std::uint64_t address :
       {std::uint64_t(0), undefined, end + headers.size(), root})
    appendLittle(superblock, address);
  OutputFile out(file, path_);
  std::string& buffer = out.buffer();
  buffer += sealed(superblock);
  for (const Object& object : objects_) {
    for (std::uint64_t first = 0; first < object.rows; first += block_rows) {
      buffer += object.make(first, std::min(block_rows, object.rows - first));
      out.flushFull();
    }
    const std::uint64_t bytes = object.rows * object.row_bytes;
    buffer.append(alignedUp(bytes) - bytes, '\0');
  }
  buffer += headers;
  out.close();
}

} // namespace io
} // namespace pcl_uvol
