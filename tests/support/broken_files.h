// SPDX-License-Identifier: BSD-3-Clause
// Files that broke a reader or a tool once, besides those of the fuzzers' corpora.
#pragma once

#include "support/environment.h"

namespace uvol_test {

/** \brief The small ones as they were found, from tests/data/broken, and large ones
 * made anew. */
void
writeBrokenFiles(const TemporaryFolder& folder);

} // namespace uvol_test
