// SPDX-License-Identifier: BSD-3-Clause
// Clouds, meshes and regular volumes from files; clouds and meshes into files.
#pragma once

#include <pcl_uvol/common/dataset.h>
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/common/map_projection.h>
#include <pcl_uvol/common/stage.h>

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace pcl_uvol {

/** \brief How a file is read. */
struct PCL_UVOL_EXPORTS LoadOptions {
  /** Columns of the coordinates of a text file, by their names or their zero-based
   * numbers; empty: they are found by usual names, as x, y, z, or x_km, y_km, z_km, or
   * easting, northing, elevation. */
  std::array<std::string, 3> xyz_columns;
  /** False: a text file whose header names no coordinates is taken for data without
   * positions. */
  bool needs_coordinates = true;
  /** False: a note says that distances mix degrees of longitude and latitude, or
   * different units of length, by the names of columns. True: no such note, because
   * distances are scaled or not used. */
  bool may_mix_units = false;
  /** The kind of particles that is read from a snapshot, by its name (gas, dm, disk,
   * bulge, stars, bh, of Phantom boundary, dust) or its number; empty: gas, or the
   * first kind there is. */
  std::string particles;
  /** The centres of cells in VTK's files, with the data of cells, are read instead of
   * points. VTK's own readers do it, which believe what a file says. */
  bool cells = false;
  /** Called with the progress of "read", except for files that VTK reads. Default: no
   * calls. */
  ProgressCallback progress = {};
  /** The map that longitude and latitude are put on, so that several files have one
   * coordinate system; its members that are not set are chosen by the file. Not set:
   * files of NetCDF choose their map, and the coordinates of all others stay as they
   * are. With a map, also tables of longitude, latitude and a height or depth are
   * mapped. Points with fields of longitude and latitude, as surfaces have them, are
   * moved to the positions that these give. */
  std::optional<MapProjection> map = {};
};

/** \brief How a file is written. */
struct PCL_UVOL_EXPORTS SaveOptions {
  /** PCD and PLY as text instead of binary. */
  bool ascii = false;
  /** Comment lines for formats that have them (PCD, PLY, CSV has none). */
  std::vector<std::string> comments;
  /** Called with the progress of "write", if points are written as text. Default: no
   * calls. */
  ProgressCallback progress = {};
};

/** \brief Read points from a file. The ending of its name (any case) selects the
 * format: .pcd, .ply, .csv, .txt, .xyz, .dat, .tsv, .vtk, .vtp, .vtu, .vts or HDF5
 * (.h5, .hdf5, .h5part, .vtkhdf). Binary snapshots of Gadget can have any name.
 * Non-finite positions are kept.
 *
 * Names that end in .gz, .bz2 or .zst are unpacked into a temporary file (in TMPDIR),
 * "-" is standard input. Arrays of NumPy (.npy, .npz), laser scans (.las) and particles
 * of Houdini (.bgeo) are read as well.
 *
 * Within a file of HDF5 a group or tables may be named: file.h5:/group,
 * file.h5:/group/pos, file.h5:/group/x,y,z. Of snapshots in several files any one is
 * named.
 * \param path of the file, or "-"
 * \param options columns of coordinates, kind of particles
 * \throws IOError in one sentence that names the file and, for text, the line */
PCL_UVOL_EXPORTS Dataset
loadDataset(const std::string& path, const LoadOptions& options = {});

/** \brief Write points as .pcd, .ply, .vtp, .vtkhdf, .csv or .npz, by the ending of the
 * name, or to standard output: "-" is PLY, "-.csv" and the like another format. The
 * file appears whole or not at all; an empty cloud gives a valid file with zero points.
 * PLY has no 64-bit integers: such a field is written as double if double holds each of
 * its values exactly, and is left out otherwise.
 * \param path of the file, or "-"
 * \param dataset what is written
 * \param options text or binary, comments
 * \throws IOError */
PCL_UVOL_EXPORTS void
saveDataset(const std::string& path,
            const Dataset& dataset,
            const SaveOptions& options = {});

/** \brief Throw IOError unless saveDataset knows the ending of that name, its folder
 * can be written to and the format holds so many fields: to be called before work whose
 * result would be lost.
 * \param path as saveDataset() will get it
 * \param fields of the cloud */
PCL_UVOL_EXPORTS void
checkSavePath(const std::string& path,
              const std::vector<pcl::PCLPointField>& fields = {});

/** \brief Write a file so that it appears whole or not at all: the writer gets the name
 * of a temporary file beside it, which is flushed, checked and renamed when the writer
 * returns, and removed when it throws. Where the file system has files without a name
 * that is one; elsewhere it is called .NAME.HOST.PID.part, and those of processes that
 * are gone are removed. Links are followed, also to a file that is not there yet.
 * \param path of the file that shall appear
 * \param writer called once
 * \throws IOError naming path (not the temporary) when it cannot be created or
 * completed */
PCL_UVOL_EXPORTS void
writeAtomically(const std::string& path,
                const std::function<void(const std::string& temporary_path)>& writer);

/** \brief Remove the temporary files that this process has: for handlers of signals
 * that end it. Nothing but calls that are allowed there. */
PCL_UVOL_EXPORTS void
removeUnfinishedFiles();

/** \brief The file that a name refers to: links are followed, also to a file that does
 * not exist yet. If the folder does not exist, the name itself.
 * \param path may name no file */
PCL_UVOL_EXPORTS std::string
resolveLinks(const std::string& path);

/** \brief The files that a list (.pvd, .vtm, .pvtu, .pvtp, .pvts) names, and those that
 * lists in it name, or those of a volume's numbers (.mhd, .mha, .nhdr, .nrrd); none for
 * another file, and those before a list that cannot be read.
 * \param path may name no file */
PCL_UVOL_EXPORTS std::vector<std::string>
listNamedFiles(const std::string& path);

/** \brief Read a mesh as the other loadMesh() does, places and faces only.
 * \param path of the file
 * \throws IOError in one sentence, also for a file without faces */
PCL_UVOL_EXPORTS Mesh
loadMesh(const std::string& path);

/** \brief Read the vertices of a .ply, .vtp, .vtkhdf, .obj, .off or .stl with all their
 * fields, and its faces, as saveMesh() writes them; polygons become fans of triangles.
 * Vertices of an .obj have normals where all faces name the same one at each; corners
 * of an .stl at one place become one vertex.
 * \param[out] triangles stay empty for a file of points
 * \param path of the file
 * \param map see LoadOptions::map
 * \throws IOError in one sentence */
PCL_UVOL_EXPORTS Dataset
loadMesh(const std::string& path,
         std::vector<Triangle>& triangles,
         const std::optional<MapProjection>& map = std::nullopt);

/** \brief Write a mesh as .ply, .vtp or .vtkhdf with all fields of the vertices, as
 * .obj with their normals, or as .off or .stl, by the ending of the name. STL is
 * written in binary and in single precision, relative to the origin of the vertices;
 * the others hold all digits. The file appears whole or not at all.
 * \param vertices with any fields
 * \param path of the file
 * \param triangles of these vertices
 * \param options text or binary, comments
 * \throws IOError, also for another ending */
PCL_UVOL_EXPORTS void
saveMesh(const std::string& path,
         const Dataset& vertices,
         const std::vector<Triangle>& triangles,
         const SaveOptions& options = {});

/** \brief Throw IOError unless saveMesh() knows the ending of the name and its folder
 * can be written to.
 * \param path as saveMesh() will get it */
PCL_UVOL_EXPORTS void
checkMeshPath(const std::string& path);

/** \brief True for the endings of files that may hold a mesh: .ply, .vtp, .vtkhdf, and
 * those of isMeshOnly().
 * \param path of a file that need not be there */
PCL_UVOL_EXPORTS bool
isMeshPath(const std::string& path);

/** \brief True for the endings .obj, .off and .stl, of files that hold no points
 * without triangles.
 * \param path of a file that need not be there */
PCL_UVOL_EXPORTS bool
isMeshOnly(const std::string& path);

/** \brief The vertices of a mesh with their normals, as points.
 * \param mesh whose triangles are left out */
PCL_UVOL_EXPORTS Dataset
toDataset(const Mesh& mesh);

/** \brief Values at the points of an axis-aligned grid. */
struct PCL_UVOL_EXPORTS Volume {
  std::array<std::size_t, 3> dims{};              ///< points per axis
  std::array<double, 3> origin{{0.0, 0.0, 0.0}};  ///< position of point (0, 0, 0)
  std::array<double, 3> spacing{{1.0, 1.0, 1.0}}; ///< distance of points, positive
  std::vector<float> values;                      ///< x runs fastest, then y, then z
  std::string name = "intensity";                 ///< of the scalar

  /** \brief Trilinear interpolation; positions outside are taken to the border.
   * \param position x, y, z in the coordinates of the volume */
  double
  sample(const std::array<double, 3>& position) const;

  /** \brief Position of the last point. */
  std::array<double, 3>
  upper() const;
};

/** \brief True if loadVolume is the one to read that file: by the ending of its name
 * (any case), for .vtk by its header as well.
 * \param path of the file
 * \throws IOError for a .vtk file that cannot be opened */
PCL_UVOL_EXPORTS bool
isVolumeFile(const std::string& path);

/** \brief Read a scalar volume: .nrrd and .nhdr (raw, ascii, gzip), .mha and .mhd (raw,
 * ascii, zipped), both with their data attached, beside them or in slices, .vti, and
 * structured points in .vtk. Axes that descend are turned.
 * \param path of the file
 * \throws IOError in one sentence that names the file, also where the axes are not
 * parallel to x, y and z */
PCL_UVOL_EXPORTS Volume
loadVolume(const std::string& path);

} // namespace pcl_uvol
