// SPDX-License-Identifier: BSD-3-Clause
// Commands run by several processes.
#pragma once

#include <string>

namespace uvol_test {

/** \brief True if there is an mpirun. */
bool
hasMpirun();

/** \brief What stands before the command of that many processes: more than there are
 * cores are fine, and so is root.
 * \param seconds after which it is killed */
std::string
mpirun(std::size_t processes, int seconds = 120);

} // namespace uvol_test
