// SPDX-License-Identifier: BSD-3-Clause
// Our readers beside those that were borrowed before them, in time of the processor,
// which others on the machine leave alone: reading_beside_others FILE...
#include <pcl_uvol/io/dataset.h>

#include <pcl/PolygonMesh.h>
#include <pcl/io/ply_io.h>
#include <vtkMetaImageReader.h>
#include <vtkNew.h>
#include <vtkNrrdReader.h>
#include <vtkPolyDataReader.h>
#include <vtkXMLImageDataReader.h>
#include <vtkXMLPolyDataReader.h>

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <functional>
#include <limits>
#include <map>
#include <string>

namespace {

using Read = std::function<void(const std::string&)>;

template <typename Reader>
void
readByVtk(const std::string& path)
{
  const vtkNew<Reader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
}

void
loadPoints(const std::string& path)
{
  pcl_uvol::loadDataset(path);
}

void
loadVolume(const std::string& path)
{
  pcl_uvol::loadVolume(path);
}

void
loadMesh(const std::string& path)
{
  pcl_uvol::loadMesh(path);
}

void
loadMeshByPcl(const std::string& path)
{
  pcl::PolygonMesh mesh;
  pcl::io::loadPLYFile(path, mesh);
}

struct Readers {
  Read ours;
  Read other; ///< empty: there is none
};

const std::map<std::string, Readers> readers_of{
    {".mha", {loadVolume, readByVtk<vtkMetaImageReader>}},
    {".nrrd", {loadVolume, readByVtk<vtkNrrdReader>}},
    {".vti", {loadVolume, readByVtk<vtkXMLImageDataReader>}},
    {".vtp", {loadPoints, readByVtk<vtkXMLPolyDataReader>}},
    {".vtk", {loadPoints, readByVtk<vtkPolyDataReader>}},
    {".ply", {loadMesh, loadMeshByPcl}},
    {".h5", {loadPoints, {}}},
    {".nc", {loadPoints, {}}}};

/** The best of some runs, in seconds of all threads. */
double
bestTime(const Read& read, const std::string& path)
{
  double best = std::numeric_limits<double>::infinity();
  for (int run = 0; run < 3; ++run) {
    const std::clock_t start = std::clock();
    read(path);
    best = std::min(best, static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
  }
  return best;
}

} // namespace

int
main(int argc, char** argv)
{
  for (int i = 1; i < argc; ++i) {
    const std::filesystem::path path(argv[i]);
    const Readers& readers = readers_of.at(path.extension());
    std::printf("%s: %.0f MB, ours %.2f s",
                argv[i],
                1e-6 * static_cast<double>(std::filesystem::file_size(path)),
                bestTime(readers.ours, path));
    if (readers.other)
      std::printf(", the other %.2f s", bestTime(readers.other, path));
    std::puts("");
  }
}
