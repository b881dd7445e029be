// SPDX-License-Identifier: BSD-3-Clause
// Files that name others, or have others beside or within them: scenes, lists of files,
// grids with their solutions, and packed files.
#include "io/scene_file.h"
#include "point_files.h"
#include "promises.h"
#include "targets.h"

#include <array>
#include <filesystem>
#include <string_view>

namespace uvol_fuzz {

namespace {

/** A file that others may name. */
struct Companion {
  const char* name;
  std::string_view text;
};

constexpr std::array<Companion, 5> companions_of_scenes{
    {{"points.csv", "x,y,z,f\n0,0,0,1\n1,0,0,2\n0,1,0,3\n"},
     {"surface.csv",
      "x,y,z,normal_x,normal_y,normal_z,f,red,green,blue\n"
      "1,0,0,1,0,0,1,255,0,0\n-1,0,0,-1,0,0,2,0,255,0\n0,1,0,0,1,0,3,0,0,255\n"
      "0,-1,0,0,-1,0,nan,9,9,9\n0,0,1,0,0,1,5,8,8,8\n0,0,-1,0,0,-1,6,7,7,7\n"},
     {"far.csv",
      "x,y,z,normal_x,normal_y,normal_z\n1000000.25,2000000.5,1,0,0,1\n"
      "1000000.5,2000000.5,1,0,0,1\n1000000.25,2000000.75,1,0,0,1\n"},
     {"lights.scene", "light point 1 2 3\n"},
     {"circle.scene", "include circle.scene\n"}}};

constexpr std::array<Companion, 3> companions_of_lists{
    {{"points.vtk",
      "# vtk DataFile Version 3.0\n\nASCII\nDATASET POLYDATA\nPOINTS 2 float\n"
      "0 0 0 1 2 3\nPOINT_DATA 2\nSCALARS f float\nLOOKUP_TABLE default\n1 2\n"},
     {"points.vtp",
      "<VTKFile type='PolyData'><PolyData><Piece NumberOfPoints='1'><PointData>"
      "<DataArray type='Float32' Name='g' format='ascii'>4</DataArray></PointData>"
      "<Points><DataArray type='Float32' NumberOfComponents='3' format='ascii'>1 2 3"
      "</DataArray></Points></Piece></PolyData></VTKFile>"},
     {"circle.pvd",
      "<VTKFile type='Collection'><Collection><DataSet file='points.vtk'/>"
      "<DataSet file='circle.pvd'/></Collection></VTKFile>"}}};

template <std::size_t count>
bool
writeFiles(const std::array<Companion, count>& companions)
{
  for (const auto& [name, text] : companions)
    writeFile(name, reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
  return true;
}

} // namespace

void
readScene(const std::uint8_t* bytes, std::size_t size)
{
  [[maybe_unused]] static thread_local const bool written =
      writeFiles(companions_of_scenes);
  const std::string path = writeFile("a.scene", bytes, size);
  refusalOf<pcl_uvol::IOError>(
      [&] {
        pcl_uvol::Report report;
        const auto file = pcl_uvol::loadScene(path, "", 1, report);
        for (const auto& cover : file.scene.splats)
          require(cover.colors.empty() || cover.colors.size() == cover.splats->size(),
                  "every splat has a colour, or none has");
        for (const auto& sphere : file.scene.spheres)
          require(sphere.radius > 0.0, "spheres have a radius");
      },
      path);
}

void
readFileList(const std::uint8_t* bytes, std::size_t size)
{
  [[maybe_unused]] static thread_local const bool written =
      writeFiles(companions_of_lists);
  readPoints(writeFile("a.pvd", bytes, size), false);
}

void
readPlot3d(const std::uint8_t* bytes, std::size_t size)
{
  // The solution follows the grid, whose bytes are counted in front.
  constexpr std::size_t count_bytes = 2;
  if (size < count_bytes)
    return;
  const std::size_t left = size - count_bytes, promised = bytes[0] + 256u * bytes[1],
                    grid = promised < left ? promised : left;
  const std::string path = writeFile("a.p3d", bytes + count_bytes, grid);
  if (grid < left)
    writeFile("a.q", bytes + count_bytes + grid, left - grid);
  else
    std::filesystem::remove(fileNamed("a.q"));
  readPoints(path, true);
}

void
readPacked(const std::uint8_t* bytes, std::size_t size)
{
  constexpr std::array<const char*, 3> names{{"a.csv.gz", "a.csv.bz2", "a.csv.zst"}};
  if (size > 0)
    readPoints(writeFile(names[bytes[0] % names.size()], bytes + 1, size - 1), true);
}

} // namespace uvol_fuzz
