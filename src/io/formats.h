// SPDX-License-Identifier: BSD-3-Clause
// The file formats behind loadDataset and saveDataset.
#pragma once

#include "common/records.h"
#include <pcl_uvol/common/dataset.h>
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/io/dataset.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace pcl_uvol {
namespace io {

class RecordSource;

enum class FileFormat {
  Pcd,
  Ply,
  Text,
  Vtk,
  Gadget,
  Hdf5,
  Las,
  Npy,
  Npz,
  Bgeo,
  Netcdf,
  Plot3d
};

/** \brief The format of the points in a file, by the ending of its name; snapshots of
 * other endings are known by their first bytes.
 * \throws IOError for another ending
 * \throws InvalidArgument for columns of coordinates chosen in a file that is no text,
 * and for particles chosen in one that is no snapshot
 */
FileFormat
findFormat(const std::string& path, const LoadOptions& options);

/** \brief Options for another file of a command: but for columns of coordinates, the
 * kind of particles and cells where its format does not take them. */
PCL_UVOL_EXPORTS LoadOptions
adaptOptions(const std::string& path, LoadOptions options);

/** \brief Endings of files that points are read from, and written to. @{ */
PCL_UVOL_EXPORTS std::vector<std::string>
listLoadedEndings();
PCL_UVOL_EXPORTS std::vector<std::string>
listSavedEndings();
/** @} */

/** \brief The points of a file as records.
 * \return null for a file that has to be read whole
 * \throws IOError */
std::unique_ptr<RecordSource>
openRecords(const std::string& path, FileFormat format, const LoadOptions& options);

/** \throws IOError that says what has to be read whole, and what is read as a stream */
[[noreturn]] void
throwNoStream(const std::string& path, const std::string& what);

/** Readers of whole files. @{ */
Dataset
readPcd(const std::string& path, const ProgressCallback& progress);

/** \brief Vertices, and faces as fans of triangles. */
struct LoadedMesh {
  Dataset vertices;
  std::vector<Triangle> triangles;
};

/** \throws IOError for a face that names a vertex that is not there */
LoadedMesh
readPlyMesh(const std::string& path);

/** \brief Text with a header line; the separator is found in it. */
Dataset
readText(const std::string& path, const LoadOptions& options);

/** \brief The polygons of a .vtp as fans of triangles; lines and strips are passed
 * over.
 * \throws IOError for a polygon that names a point that is not there */
std::vector<Triangle>
readVtpTriangles(const std::string& path);

/** \brief The same of a .vtkhdf; none of another type than PolyData. */
std::vector<Triangle>
readVtkHdfTriangles(const std::string& path);

/** \brief .vtk, .vtp, .vtu or .vts, lists of such files, and what VTK itself reads. */
Dataset
readVtk(const std::string& path, const LoadOptions& options);
/** @} */

/** \brief A PCD whose points are compressed, as its header tells. */
struct CompressedInfo {
  RecordInfo info;
  std::uint64_t packed_bytes;
};

/** \brief Nothing for a PCD that is not compressed.
 * \throws IOError */
std::optional<CompressedInfo>
findCompressed(const std::string& path);

/** \brief True for the endings of files that list others: .pvd, .vtm, .pvtu, .pvtp and
 * .pvts. */
PCL_UVOL_EXPORTS bool
isFileList(const std::string& path);

/** \brief The files that a .pvtp lists.
 * \throws IOError if it is none */
std::vector<std::string>
readPieceList(const std::string& path);

/** Files whose header was read, and text whose types of columns are known. @{ */
/** \throws IOError for compressed points */
std::unique_ptr<RecordSource>
openPcd(const std::string& path);

std::unique_ptr<RecordSource>
openPly(const std::string& path);

std::unique_ptr<RecordSource>
openText(const std::string& path, const LoadOptions& options);

std::unique_ptr<RecordSource>
openGadget(const std::string& path, const LoadOptions& options);

std::unique_ptr<RecordSource>
openHdf5(const std::string& path, const LoadOptions& options);

std::unique_ptr<RecordSource>
openLas(const std::string& path);

std::unique_ptr<RecordSource>
openNpy(const std::string& path);

std::unique_ptr<RecordSource>
openNpz(const std::string& path);

/** \brief Particles of Houdini, version 5. */
std::unique_ptr<RecordSource>
openBgeo(const std::string& path);

/** Not there where the build lacks the library of NetCDF. */
std::unique_ptr<RecordSource>
openNetcdf(const std::string& path, const LoadOptions& options);
/** @} */

/** \brief Grids of PLOT3D, and their solutions where these stand beside them.
 * \throws IOError */
std::unique_ptr<RecordSource>
openPlot3d(const std::string& path);

/** \brief True for names as grids of PLOT3D have them: grid.p3d, combxyz.bin. */
PCL_UVOL_EXPORTS bool
isPlot3d(const std::string& path);

/** \brief How many points the grids of such a file have along i, j and k: the samples
 * are those of one grid after another, i fastest.
 *
 * \throws IOError */
PCL_UVOL_EXPORTS std::vector<std::array<std::uint64_t, 3>>
readPlot3dSizes(const std::string& path);

/** \brief True for a binary snapshot of Gadget.
 * \throws IOError */
bool
isGadget(const std::string& path);

/** Writers write to `file`, which exists; errors call it `path`. @{ */
void
writePcd(const std::string& file,
         const std::string& path,
         const Dataset& dataset,
         const SaveOptions& options);

/** \brief The fields of heldFields().
 * \param triangles faces over the points; may be empty */
void
writePly(const std::string& file,
         const std::string& path,
         const Dataset& dataset,
         const std::vector<Triangle>& triangles,
         const SaveOptions& options);

void
writeCsv(const std::string& file,
         const std::string& path,
         const Dataset& dataset,
         const SaveOptions& options);

/** \brief An array per field. */
void
writeNpz(const std::string& file, const std::string& path, const Dataset& dataset);

/** \brief
 * \throws IOError for more fields than VTK can tell apart in a few seconds */
void
checkVtpFields(const std::string& path, const std::vector<pcl::PCLPointField>& fields);

/** \brief Points, or faces over them where there are triangles.
 * \throws IOError as checkVtpFields() */
void
writeVtp(const std::string& file,
         const std::string& path,
         const Dataset& dataset,
         const std::vector<Triangle>& triangles);

/** \brief The same as .vtkhdf. */
void
writeVtkHdf(const std::string& file,
            const std::string& path,
            const Dataset& dataset,
            const std::vector<Triangle>& triangles);

/** \brief Meshes as text, vertices with their normals where they have any. */
void
writeObj(const std::string& file,
         const std::string& path,
         const Dataset& vertices,
         const std::vector<Triangle>& triangles,
         const SaveOptions& options);

/** \brief Meshes as text, nothing but vertices and triangles. */
void
writeOff(const std::string& file,
         const std::string& path,
         const Dataset& vertices,
         const std::vector<Triangle>& triangles,
         const SaveOptions& options);

/** \brief Binary; coordinates, in single precision, are relative to the origin. */
void
writeStl(const std::string& file,
         const std::string& path,
         const Dataset& vertices,
         const std::vector<Triangle>& triangles);

/** \brief A .pvtp.
 * \param dataset has the fields of the pieces
 * \param pieces .vtp files in its folder */
void
writePieceList(const std::string& file,
               const std::string& path,
               const Dataset& dataset,
               const std::vector<std::string>& pieces);
/** @} */

} // namespace io
} // namespace pcl_uvol
