// SPDX-License-Identifier: BSD-3-Clause
// The header of a PLY file: its elements and their properties.
#pragma once

#include "common/records.h"
#include "io/file_cursor.h"
#include "io/label_comments.h"

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

namespace pcl_uvol {
namespace io {

/** \brief A property of an element, scalar or list. */
struct PlyProperty {
  std::string name;
  std::uint8_t datatype = 0;
  std::uint8_t length_type = 0; ///< of the number in front of a list, 0 for a scalar
};

/** \brief What a PLY file has many of, as vertices or faces. */
struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;

  bool
  hasLists() const
  {
    return std::any_of(properties.begin(), properties.end(), [](const PlyProperty& p) {
      return p.length_type != 0;
    });
  }

  /** \brief Bytes of the scalars. */
  std::uint64_t
  bytes() const
  {
    std::uint64_t sum = 0;
    for (const auto& property : properties)
      if (property.length_type == 0)
        sum += datatypeSize(property.datatype);
    return sum;
  }
};

/** \brief How the body is written. */
enum class PlyFormat { None, Ascii, LittleEndian, BigEndian };

struct PlyHeader {
  PlyFormat format = PlyFormat::None;
  std::vector<PlyElement> elements;
  LabelNames labels;
};

/** \brief Read a header; the cursor stands behind it afterwards.
 * \throws IOError for a line that is none of a PLY header */
PlyHeader
readPlyHeader(const std::string& path, FileCursor& cursor);

} // namespace io
} // namespace pcl_uvol
