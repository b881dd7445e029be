// SPDX-License-Identifier: BSD-3-Clause
// What needs VTK, HDF5 or NetCDF (src/io_vtk). It is a library of its own, which is
// loaded when it is called for the first time: with it a tool loads 116 libraries
// instead of 36, and takes 0.09 s to start instead of 0.02 (uvol_info -h, user and
// system time).
#pragma once

#include "interpolation/sample_cells.h"
#include "io/formats.h"
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/neighbors/voronoi_diagram.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace pcl_uvol {
namespace io {

/** \brief A line of text as opacities, 0 to 255, row by row from below. */
struct Letters {
  int width = 0, height = 0;
  std::vector<std::uint8_t> opacities;
};

/** \brief The functions of the library. Those of formats.h are described there. Callers
 * have checked the ending of the name, and that a file to be written can be created. */
struct VtkLibrary {
  decltype(&io::openHdf5) openHdf5;
  decltype(&io::openNetcdf)
      openNetcdf; ///< null where the build lacks the library of NetCDF
  decltype(&io::readVtk) readVtk;
  decltype(&io::readVtpTriangles) readVtpTriangles;
  decltype(&io::readVtkHdfTriangles) readVtkHdfTriangles;
  decltype(&io::readPieceList) readPieceList;
  decltype(&io::checkVtpFields) checkVtpFields;
  decltype(&io::writeVtp) writeVtp;
  decltype(&io::writePieceList) writePieceList;

  /** \brief The image of a .vti or .vtk; axes of negative spacing run downwards.
   * \throws IOError */
  Volume (*readImage)(const std::string& path);

  /** \brief Whether a .vtk holds an image; not if it cannot be read.
   * \throws IOError if it is not there */
  bool (*holdsImage)(const std::string& path);

  /** \brief The solid cells of a file, see loadCells(); null if there are none.
   * \throws IOError */
  std::shared_ptr<const detail::SampleCells> (*readCells)(const std::string& path,
                                                          const LoadOptions& options,
                                                          const Dataset& samples);

  /** \brief The files that a list names, and those that lists in it name; as far as
   * they can be read. */
  std::vector<std::string> (*findListedFiles)(const std::string& path);

  /** \brief Write an image, see saveVoronoiGrid().
   * \param file where it is written to
   * \param path the name that errors give
   * \throws IOError */
  void (*writeVoronoiGrid)(const std::string& file,
                           const std::string& path,
                           const VoronoiGrid& grid,
                           const std::array<double, 3>& origin,
                           unsigned threads);

  /** \brief Draw a line of text in Arial; empty if it has no letters.
   * \param size of the font in pixels */
  Letters (*drawLetters)(const std::string& text, int size);
};

/** \brief The library, which is loaded if it is not there yet; any number of threads
 * may ask for it.
 * \throws IOError if it is missing */
PCL_UVOL_EXPORTS const VtkLibrary&
vtkLibrary();

} // namespace io
} // namespace pcl_uvol
