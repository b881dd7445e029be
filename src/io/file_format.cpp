// SPDX-License-Identifier: BSD-3-Clause
// Which format a file has: by the ending of its name, else by its first bytes.
#include "common/printable.h"
#include "common/similar_words.h"
#include "io/files.h"
#include "io/formats.h"
#include "io/hdf5_names.h"
#include "io/volume_data.h"
#include "io/vtk_library.h"
#include <pcl_uvol/common/exceptions.h>

#include <algorithm>

namespace pcl_uvol {
namespace io {
namespace {

constexpr struct {
  const char* ending;
  FileFormat format;
} known_endings[] = {{".pcd", FileFormat::Pcd},       {".ply", FileFormat::Ply},
                     {".csv", FileFormat::Text},      {".txt", FileFormat::Text},
                     {".xyz", FileFormat::Text},      {".dat", FileFormat::Text},
                     {".tsv", FileFormat::Text},      {".vtk", FileFormat::Vtk},
                     {".vtp", FileFormat::Vtk},       {".vtu", FileFormat::Vtk},
                     {".vts", FileFormat::Vtk},       {".las", FileFormat::Las},
                     {".npy", FileFormat::Npy},       {".npz", FileFormat::Npz},
                     {".h5", FileFormat::Hdf5},       {".hdf5", FileFormat::Hdf5},
                     {".hdf", FileFormat::Hdf5},      {".he5", FileFormat::Hdf5},
                     {".h5part", FileFormat::Hdf5},   {".vtkhdf", FileFormat::Hdf5},
                     {".nc", FileFormat::Netcdf},     {".nc4", FileFormat::Netcdf},
                     {".cdf", FileFormat::Netcdf},    {".ex2", FileFormat::Vtk},
                     {".exo", FileFormat::Vtk},       {".e", FileFormat::Vtk},
                     {".exii", FileFormat::Vtk},      {".case", FileFormat::Vtk},
                     {".foam", FileFormat::Vtk},      {".pvd", FileFormat::Vtk},
                     {".vtm", FileFormat::Vtk},       {".pvtu", FileFormat::Vtk},
                     {".pvtp", FileFormat::Vtk},      {".pvts", FileFormat::Vtk},
                     {".vthb", FileFormat::Vtk},      {".htg", FileFormat::Vtk},
                     {".p3d", FileFormat::Plot3d},    {".bgeo", FileFormat::Bgeo},
                     {".bhclassic", FileFormat::Bgeo}};

/** Grids, whose points are no samples but lattices, and whose cells may be. */
constexpr const char* grid_endings[] = {".vti", ".vtr", ".pvti", ".pvtr"};

constexpr const char* list_endings[] = {".pvd", ".vtm", ".pvtu", ".pvtp", ".pvts"};

/** What usually makes a file that is read of one that is not. */
constexpr struct {
  const char* ending;
  const char* way;
} converters[] = {
    {".laz", "laszip -i in.laz -o out.las unpacks it"},
    {".e57", "pdal translate in.e57 out.las converts it"},
    {".bgeosc", "saved by Houdini as .bhclassic it can be read"},
    {".cgns", "meshio convert in.cgns out.vtu converts it, and so does ParaView"},
    {".msh", "meshio convert in.msh out.vtu converts it"},
    {".xdmf", "meshio convert in.xdmf out.vtu converts it"},
    {".vtr",
     "data of its cells can be read as points at their centres, and ParaView saves "
     "those "
     "of its points as .vts"},
    {".vti", "uvol_generate in.vti out.pcd makes points of a volume"},
    {".nrrd", "uvol_generate in.nrrd out.pcd makes points of a volume"},
    {".nhdr", "uvol_generate in.nhdr out.pcd makes points of a volume"},
    {".mha", "uvol_generate in.mha out.pcd makes points of a volume"},
    {".mhd", "uvol_generate in.mhd out.pcd makes points of a volume"},
    {".obj", "meshio convert in.obj out.ply converts it"},
    {".off", "meshio convert in.off out.ply converts it"},
    {".stl", "meshio convert in.stl out.ply converts it"},
    {".xlsx", "save the sheet as .csv"},
    {".ods", "save the sheet as .csv"},
    {".json", "write a table of it, as .csv"},
    {".parquet", "a line of Python's pandas writes it as .csv"},
    {".mat", "a line of Matlab or SciPy writes it as .csv"}};

/** The ending that the content of standard input would have: PLY and PCD say what they
 * are, everything else is taken for text. */
std::string
sniffEnding(const std::string& path)
{
  const std::string head = InputFile(path).head(16);
  const auto begins = [&](const char* word) { return head.rfind(word, 0) == 0; };
  if (begins("ply"))
    return ".ply";
  if (begins("# .PCD") || begins("VERSION") || begins("FIELDS"))
    return ".pcd";
  return ".csv";
}

[[noreturn]] void
throwUnknown(const std::string& path, const std::string& ending)
{
  for (const auto& known : converters)
    if (ending == known.ending)
      throwUnreadable(path, {"convertible_ending", ending, known.way});
  const std::string nearest = findSimilar(listLoadedEndings(), ending);
  if (ending.empty())
    throwUnreadable(path, "no_ending");
  throwUnreadable(path,
                  {"unknown_ending", shortenText(ending), !nearest.empty(), nearest});
}

FileFormat
detectFormat(const std::string& path)
{
  if (!splitHdf5Name(path).inside.empty())
    return FileFormat::Hdf5;
  const std::string ending = path == "-" ? sniffEnding(path) : getEnding(path);
  for (const auto& known : known_endings)
    if (ending == known.ending)
      return known.format;
  if (isPlot3d(path))
    return FileFormat::Plot3d;
  if (isGadget(path)) // a missing file matters more than its ending
    return FileFormat::Gadget;
  if (isHdf5(path))
    return FileFormat::Hdf5;
  throwUnknown(path, ending);
}

} // namespace

bool
isFileList(const std::string& path)
{
  return std::find(std::begin(list_endings), std::end(list_endings), getEnding(path)) !=
         std::end(list_endings);
}

std::vector<std::string>
listLoadedEndings()
{
  std::vector<std::string> endings;
  for (const auto& known : known_endings)
    endings.emplace_back(known.ending);
  return endings;
}

FileFormat
findFormat(const std::string& path, const LoadOptions& options)
{
  const std::string ending = getEnding(path);
  const bool is_grid = options.cells && std::find(std::begin(grid_endings),
                                                  std::end(grid_endings),
                                                  ending) != std::end(grid_endings);
  const FileFormat format = is_grid ? FileFormat::Vtk : detectFormat(path);
  if (options.xyz_columns != LoadOptions().xyz_columns && format != FileFormat::Text)
    throw InvalidArgument("columns_of_no_text", {{"path", printable(path)}});
  if (!options.particles.empty() && format != FileFormat::Gadget &&
      format != FileFormat::Hdf5)
    throw InvalidArgument("particles_of_no_snapshot", {{"path", printable(path)}});
  if (options.cells && format != FileFormat::Vtk)
    throw InvalidArgument("cells_of_no_grid", {{"path", printable(path)}});
  return format;
}

LoadOptions
adaptOptions(const std::string& path, LoadOptions options)
{
  LoadOptions plain;
  plain.cells = options.cells;
  const auto takes = [&](const LoadOptions& tried) {
    try {
      findFormat(path, tried);
      return true;
    }
    catch (const InvalidArgument&) {
      return false;
    }
  };
  if (!takes(plain))
    options.cells = plain.cells = false;
  plain.xyz_columns = options.xyz_columns;
  if (!takes(plain))
    options.xyz_columns = plain.xyz_columns = {};
  plain.particles = options.particles;
  if (!takes(plain))
    options.particles.clear();
  return options;
}

} // namespace io

std::vector<std::string>
listNamedFiles(const std::string& path)
{
  return io::isFileList(path) ? io::vtkLibrary().findListedFiles(path)
                              : io::findVolumeFiles(path);
}

} // namespace pcl_uvol
