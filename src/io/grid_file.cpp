// SPDX-License-Identifier: BSD-3-Clause
#include "io/grid_file.h"

#include "io/files.h"
#include "io/vtk_library.h"
#include <pcl_uvol/io/dataset.h>

namespace pcl_uvol {

void
saveVoronoiGrid(const std::string& path,
                const VoronoiGrid& grid,
                const std::array<double, 3>& origin,
                unsigned threads)
{
  checkGridPath(path);
  writeAtomically(path, [&](const std::string& file) {
    io::vtkLibrary().writeVoronoiGrid(file, path, grid, origin, threads);
  });
}

void
checkGridPath(const std::string& path)
{
  if (io::getEnding(path) != ".vti")
    io::throwUnwritable(path, {"unwritten_ending", "grids", ".vti"});
  io::checkWritable(path);
}

} // namespace pcl_uvol
