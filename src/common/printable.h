// SPDX-License-Identifier: BSD-3-Clause
// Bytes of files and of command lines as parts of messages: none of them may steer a
// terminal.
#pragma once

#include <pcl_uvol/common/export.h>

#include <string>
#include <string_view>

namespace pcl_uvol {

/** \brief True for UTF-8 without control characters. */
PCL_UVOL_EXPORTS bool
isPrintable(std::string_view text);

/** \brief A text with its bytes that are no printable UTF-8 as \x1b and the like. */
PCL_UVOL_EXPORTS std::string
printable(std::string_view text);

/** \brief The same, its first 40 characters if it is longer. */
PCL_UVOL_EXPORTS std::string
shortenText(std::string_view text);

/** \brief The same between quotes: 'text'. */
PCL_UVOL_EXPORTS std::string
quoteText(std::string_view text);

} // namespace pcl_uvol
