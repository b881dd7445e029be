// SPDX-License-Identifier: BSD-3-Clause
// What io calls of this library, besides the functions of io/formats.h: see VtkLibrary.
#pragma once

#include "io/vtk_library.h"

namespace pcl_uvol {
namespace io {

Volume
readImage(const std::string& path);

bool
holdsImage(const std::string& path);

std::shared_ptr<const detail::SampleCells>
readCells(const std::string& path, const LoadOptions& options, const Dataset& samples);

std::vector<std::string>
findListedFiles(const std::string& path);

void
writeVoronoiGrid(const std::string& file,
                 const std::string& path,
                 const VoronoiGrid& grid,
                 const std::array<double, 3>& origin,
                 unsigned threads);

Letters
drawLetters(const std::string& text, int size);

} // namespace io
} // namespace pcl_uvol
