// SPDX-License-Identifier: BSD-3-Clause
// Files that several processes read and write together.
#pragma once

#include <pcl_uvol/common/export.h>
#include <pcl_uvol/distributed/communicator.h>
#include <pcl_uvol/io/dataset.h>

#include <string>
#include <vector>

namespace pcl_uvol {

/** \brief The files that names stand for: a .pvtp for its pieces, a pattern with *, ?
 * or [...] for the files that match, sorted; other names for themselves.
 * \throws IOError for a pattern that nothing matches, and a .pvtp that is none */
PCL_UVOL_EXPORTS std::vector<std::string>
findPieces(const std::vector<std::string>& paths);

/** \brief The points that one of several processes reads. One file that PointStream
 * takes is parted by its points, as evenly as possible; several files, or one of VTK's,
 * are dealt out whole. Points that are counted one process after another keep the order
 * that they have in the files.
 *
 * Fields, origin and box are the same on all processes, also on those that have no
 * point; pieces have a box if all of them name the same one.
 * Coordinates of pieces in double with origins of their own move to a common one; they
 * may change by what float loses there.
 * \param paths what findPieces gives
 * \throws IOError, on the process that reads the file
 * \throws InvalidArgument if no file has a point, if two pieces have different fields,
 * or if a process would get more points than PCL can number */
PCL_UVOL_EXPORTS Dataset
loadPart(const std::vector<std::string>& paths,
         const LoadOptions& options,
         Communicator& communicator);

/** \brief The pieces that so many processes write for a .pvtp: name_<rank>.vtp. */
PCL_UVOL_EXPORTS std::vector<std::string>
listPieces(const std::string& path, std::size_t ranks);

/** \brief Write a .pvtp, and beside it the points of each process as name_<rank>.vtp.
 * All files appear or, if a process fails, none. Fields are those of all processes.
 * Pieces that the .pvtp listed before and that fewer processes do not write go.
 * \throws IOError */
PCL_UVOL_EXPORTS void
savePieces(const std::string& path, const Dataset& part, Communicator& communicator);

/** \brief Throw IOError unless savePieces can write there: to be called before work
 * whose result would be lost. */
PCL_UVOL_EXPORTS void
checkSavePieces(const std::string& path);

} // namespace pcl_uvol
