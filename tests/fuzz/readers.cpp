// SPDX-License-Identifier: BSD-3-Clause
// Bytes as files. A reader either gives what its own writers and the stream of points
// give again, or refuses in one sentence.
#include "common/scalar_field.h"
#include "io/cell_loader.h"
#include "io/memory_need.h"
#include "io/point_stream.h"
#include "io_vtk/vtk_readers.h"
#include "point_files.h"
#include "promises.h"
#include "targets.h"
#include <pcl_uvol/io/dataset.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <unistd.h>

namespace uvol_fuzz {

namespace {

using pcl_uvol::Dataset;
using pcl_uvol::IOError;
namespace fs = std::filesystem;

/** A folder of this thread, in memory where the system has such a place. */
class Folder {
public:
  Folder()
      : path_((fs::exists("/dev/shm") ? fs::path("/dev/shm")
                                      : fs::temp_directory_path()) /
              ("uvol_fuzz." + std::to_string(::gettid())))
  {
    fs::create_directories(path_);
  }
  Folder(const Folder&) = delete;
  Folder&
  operator=(const Folder&) = delete;
  ~Folder()
  {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }

  std::string
  operator/(const std::string& name) const
  {
    return path_ / name;
  }

private:
  fs::path path_;
};

void
requireWhole(const Dataset& dataset)
{
  const auto& cloud = dataset.cloud;
  require(cloud.height == 1, "height is 1");
  require(cloud.data.size() == std::size_t(cloud.width) * cloud.point_step,
          "the bytes are those of the points");
  std::size_t end = 0;
  for (const auto& field : cloud.fields) {
    require(field.offset == end, "fields follow one another without gaps");
    end += pcl_uvol::datatypeSize(field.datatype) * field.count;
  }
  require(end <= cloud.point_step && cloud.point_step % 4 == 0,
          "a point holds its fields");
}

/** The points are those that blocks of a stream hold. */
void
requireSameStream(const std::string& path,
                  const std::string& refusal,
                  const Dataset* whole)
{
  constexpr std::size_t block_points = 7;
  std::vector<std::uint8_t> bytes;
  const std::string stream_refusal = refusalOf<IOError>(
      [&] {
        pcl_uvol::PointStream stream(path);
        pcl::PCLPointCloud2 block;
        while (stream.read(block_points, block) > 0)
          bytes.insert(bytes.end(), block.data.begin(), block.data.end());
      },
      path);
  if (stream_refusal == "not_streamable")
    return;
  require(refusal.empty() == stream_refusal.empty(),
          "stream and whole file are refused alike: '" + refusal + "', '" +
              stream_refusal + "'");
  if (whole != nullptr)
    require(bytes == whole->cloud.data, "a stream gives the points of the whole file");
}

/** Points come back as they are from the format that holds everything. */
void
requireRoundTrip(const Dataset& dataset)
{
  const std::string path = fileNamed("again.pcd");
  pcl_uvol::saveDataset(path, dataset);
  const Dataset again = pcl_uvol::loadDataset(path);
  const bool written_in_double = // from an origin that may become another one
      dataset.double_coordinates || dataset.origin != std::array<double, 3>{};
  require(again.cloud.data == dataset.cloud.data || written_in_double,
          "points survive PCD");
  require(again.cloud.fields.size() == dataset.cloud.fields.size(),
          "fields survive PCD");
}

/** What the header forecasts is what was loaded. */
void
requireForecast(const std::string& path, const Dataset& dataset)
{
  const auto promised = pcl_uvol::peekHeader(path);
  if (!promised)
    return;
  require(promised->points == dataset.cloud.width, "the header tells the points");
  require(promised->point_step == dataset.cloud.point_step,
          "the header tells the bytes of a point");
}

} // namespace

std::string
fileNamed(const std::string& name)
{
  static thread_local const Folder made;
  return made / name;
}

std::string
writeFile(const std::string& name, const std::uint8_t* bytes, std::size_t size)
{
  std::string path = fileNamed(name);
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes), static_cast<std::streamsize>(size));
  return path;
}

void
readPoints(const std::string& path, bool has_stream)
{
  Dataset dataset;
  const std::string refusal =
      refusalOf<IOError>([&] { dataset = pcl_uvol::loadDataset(path); }, path);
  if (has_stream)
    requireSameStream(path, refusal, refusal.empty() ? &dataset : nullptr);
  if (!refusal.empty())
    return;
  requireWhole(dataset);
  requireForecast(path, dataset);
  const std::string ending = path.substr(std::min(path.size(), path.rfind('.')));
  if (ending == ".vtkhdf" || ending == ".p3d") // cells of others are read elsewhere
    refusalOf<IOError>([&] { pcl_uvol::loadCells(path, {}, dataset); }, path);
  constexpr std::size_t most_bytes = 1 << 16, most_fields = 100; // for speed
  if (dataset.cloud.data.size() < most_bytes &&
      dataset.cloud.fields.size() < most_fields)
    requireRoundTrip(dataset);
}

void
readMesh(const std::string& path)
{
  refusalOf<IOError>(
      [&] {
        const auto mesh = pcl_uvol::loadMesh(path);
        for (const auto& triangle : mesh.triangles)
          for (const auto vertex : triangle)
            require(vertex < mesh.vertices.size(), "triangles have vertices");
      },
      path);
}

void
readVolume(const std::string& path)
{
  refusalOf<IOError>(
      [&] {
        const auto volume = pcl_uvol::loadVolume(path);
        require(volume.values.size() ==
                    volume.dims[0] * volume.dims[1] * volume.dims[2],
                "a volume has a value per point");
        for (const double spacing : volume.spacing)
          require(spacing > 0.0, "distances are positive");
      },
      path);
}

void
readPcd(const std::uint8_t* bytes, std::size_t size)
{
  readPoints(writeFile("a.pcd", bytes, size), true);
}

void
readPly(const std::uint8_t* bytes, std::size_t size)
{
  const std::string path = writeFile("a.ply", bytes, size);
  readPoints(path, true);
  readMesh(path);
}

void
readText(const std::uint8_t* bytes, std::size_t size)
{
  readPoints(writeFile("a.csv", bytes, size), true);
}

void
readLegacyVtk(const std::uint8_t* bytes, std::size_t size)
{
  const std::string path = writeFile("a.vtk", bytes, size);
  readPoints(path, false);
  readVolume(path);
  refusalOf<IOError>([&] { pcl_uvol::io::checkVtkLegacy(path); }, path);
}

void
readXmlVtk(const std::uint8_t* bytes, std::size_t size)
{
  const std::string path = writeFile("a.vtp", bytes, size);
  readPoints(path, false);
  readMesh(path);
  readVolume(writeFile("a.vti", bytes, size));
  refusalOf<IOError>([&] { pcl_uvol::io::checkVtkXml(path); }, path);
}

void
readNrrd(const std::uint8_t* bytes, std::size_t size)
{
  readVolume(writeFile("a.nrrd", bytes, size));
}

void
readMetaImage(const std::uint8_t* bytes, std::size_t size)
{
  readVolume(writeFile("a.mha", bytes, size));
}

void
readGadget(const std::uint8_t* bytes, std::size_t size)
{
  readPoints(writeFile("snap.0", bytes, size), true);
}

void
readBgeo(const std::uint8_t* bytes, std::size_t size)
{
  readPoints(writeFile("a.bgeo", bytes, size), true);
}

void
readLas(const std::uint8_t* bytes, std::size_t size)
{
  readPoints(writeFile("a.las", bytes, size), true);
}

void
readNpy(const std::uint8_t* bytes, std::size_t size)
{
  readPoints(writeFile("a.npy", bytes, size), true);
}

void
readNpz(const std::uint8_t* bytes, std::size_t size)
{
  readPoints(writeFile("a.npz", bytes, size), true);
}

void
readObj(const std::uint8_t* bytes, std::size_t size)
{
  readMesh(writeFile("a.obj", bytes, size));
}

void
readOff(const std::uint8_t* bytes, std::size_t size)
{
  readMesh(writeFile("a.off", bytes, size));
}

void
readStl(const std::uint8_t* bytes, std::size_t size)
{
  readMesh(writeFile("a.stl", bytes, size));
}

} // namespace uvol_fuzz
