// SPDX-License-Identifier: BSD-3-Clause
// Types and names of PLY properties.
#pragma once

#include "common/records.h"

#include <string_view>

namespace pcl_uvol {
namespace io {

constexpr const char* ply_normals[] = {"nx", "ny", "nz"};
constexpr const char* cloud_normals[] = {"normal_x", "normal_y", "normal_z"};

/** \brief The pcl::PCLPointField datatype of either name of a PLY type, else 0. */
std::uint8_t
plyDatatype(std::string_view name);

/** \brief The PLY type of a datatype, null for 64-bit integers. */
const char*
plyTypeName(std::uint8_t datatype);

} // namespace io
} // namespace pcl_uvol
