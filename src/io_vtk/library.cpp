// SPDX-License-Identifier: BSD-3-Clause
#include "io_vtk/entries.h"

namespace pcl_uvol {
namespace io {

extern "C" PCL_UVOL_EXPORTS const VtkLibrary pcl_uvol_vtk_library;

const VtkLibrary pcl_uvol_vtk_library = {openHdf5,
#ifdef PCL_UVOL_HAS_NETCDF
                                         openNetcdf,
#else
                                         nullptr,
#endif
                                         readVtk,
                                         readVtpTriangles,
                                         readVtkHdfTriangles,
                                         readPieceList,
                                         checkVtpFields,
                                         writeVtp,
                                         writePieceList,
                                         readImage,
                                         holdsImage,
                                         readCells,
                                         findListedFiles,
                                         writeVoronoiGrid,
                                         drawLetters};

} // namespace io
} // namespace pcl_uvol
