// SPDX-License-Identifier: BSD-3-Clause
// What files hold of the fields of a dataset, and what they lack. One rule for all
// formats: a number of a type that the format lacks becomes a double if that is exact.
#pragma once

#include "common/records.h"
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/common/message.h>

#include <cstdint>
#include <string>
#include <vector>

namespace pcl_uvol {
namespace io {

/** \brief Whether files of that ending have a type for the numbers of a datatype. */
bool
holdsType(const std::string& ending, std::uint8_t datatype);

/** \brief The savedFields() as a file of that ending holds them: a field of a type that
 * the format lacks has the type FLOAT64 if double holds each of its values exactly, and
 * is left out otherwise.
 * \throws InvalidArgument as savedFields() */
Fields
heldFields(const std::string& ending, const Dataset& dataset);

} // namespace io

/** \brief What a file does not hold of a dataset: fields that are left out, see
 * io::heldFields(), and names that become numbers.
 * \param path of the file, whose ending is that of a mesh or of points */
PCL_UVOL_EXPORTS std::vector<Message>
describeLosses(const std::string& path, const Dataset& dataset);

} // namespace pcl_uvol
