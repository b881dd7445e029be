// SPDX-License-Identifier: BSD-3-Clause
// The cells of a file, from the extension that reads them to the one that asks them.
#pragma once

#include "interpolation/sample_cells.h"

#include <memory>

namespace pcl_uvol::python {

/** \brief Says where the data of samples are. */
struct CellMask {
  std::shared_ptr<const detail::SampleCells> cells; ///< null: there are none
};

} // namespace pcl_uvol::python
