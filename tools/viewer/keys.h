// SPDX-License-Identifier: BSD-3-Clause
// The keys of the viewer, as they are told to the user and as they act.
#pragma once

#include <pcl_uvol/render/image_space/backend.h>

#include <string>

namespace uvol_tools {

/** \brief One line per key. */
std::string
describeKeys();

/** \brief Switch the pass of a key on or off; false for a key that is none of a pass.
 */
bool
switchPass(char key, pcl_uvol::ImageSpaceSettings& settings);

/** \brief The side that a key looks from, see Camera::fit; null for other keys. */
const char*
sideOf(char key);

} // namespace uvol_tools
