// SPDX-License-Identifier: BSD-3-Clause
// Loading and saving by the ending of the name.
#include "io/files.h"
#include "io/formats.h"
#include "io/globe_places.h"
#include "io/record_source.h"
#include "io/vtk_library.h"
#include <pcl_uvol/common/exceptions.h>

#include <algorithm>

namespace pcl_uvol {
namespace {

constexpr const char* saved_endings[] = {
    ".pcd", ".ply", ".vtp", ".vtkhdf", ".csv", ".npz"};

} // namespace

namespace io {

std::vector<std::string>
listSavedEndings()
{
  return {std::begin(saved_endings), std::end(saved_endings)};
}

std::unique_ptr<RecordSource>
openRecords(const std::string& path, FileFormat format, const LoadOptions& options)
{
  switch (format) {
  case FileFormat::Pcd:
    return openPcd(path);
  case FileFormat::Ply:
    return openPly(path);
  case FileFormat::Text:
    return openText(path, options);
  case FileFormat::Gadget:
    return openGadget(path, options);
  case FileFormat::Hdf5:
    return vtkLibrary().openHdf5(path, options);
  case FileFormat::Las:
    return openLas(path);
  case FileFormat::Npy:
    return openNpy(path);
  case FileFormat::Npz:
    return openNpz(path);
  case FileFormat::Bgeo:
    return openBgeo(path);
  case FileFormat::Plot3d:
    return openPlot3d(path);
  case FileFormat::Netcdf:
    if (vtkLibrary().openNetcdf == nullptr)
      throwUnreadable(path, {"library_missing", "NetCDF", false});
    return vtkLibrary().openNetcdf(path, options);
  default:
    return nullptr;
  }
}

namespace {

Dataset
readFormat(const std::string& path, FileFormat format, const LoadOptions& options)
{
  switch (format) {
  case FileFormat::Pcd:
    return readPcd(path, options.progress);
  case FileFormat::Text:
    return readText(path, options);
  case FileFormat::Vtk:
    return vtkLibrary().readVtk(path, options);
  default:
    return readWhole(openRecords(path, format, options), options.progress);
  }
}

} // namespace
} // namespace io

Dataset
loadDataset(const std::string& path, const LoadOptions& options)
{
  const io::FileFormat format = io::findFormat(path, options);
  return io::reading(path, [&] {
    Dataset dataset = io::readFormat(path, format, options);
    io::putOnMap(dataset, options.map);
    return dataset;
  });
}

void
saveDataset(const std::string& path, const Dataset& dataset, const SaveOptions& options)
{
  checkSavePath(path, dataset.cloud.fields);
  const std::string ending = io::getEnding(path);
  writeAtomically(path, [&](const std::string& file) {
    if (ending == ".pcd")
      io::writePcd(file, path, dataset, options);
    else if (ending == ".ply")
      io::writePly(file, path, dataset, {}, options);
    else if (ending == ".vtp")
      io::vtkLibrary().writeVtp(file, path, dataset, {});
    else if (ending == ".vtkhdf")
      io::writeVtkHdf(file, path, dataset, {});
    else if (ending == ".npz")
      io::writeNpz(file, path, dataset);
    else
      io::writeCsv(file, path, dataset, options);
  });
}

void
checkSavePath(const std::string& path, const std::vector<pcl::PCLPointField>& fields)
{
  const std::string ending = io::getEnding(path);
  if (std::find(std::begin(saved_endings), std::end(saved_endings), ending) ==
      std::end(saved_endings))
    io::throwUnwritable(
        path,
        {"unwritten_ending", "points", ".pcd, .ply, .vtp, .vtkhdf, .csv or .npz"});
  io::checkWritable(path);
  if (ending == ".vtp")
    io::vtkLibrary().checkVtpFields(path, fields);
}

} // namespace pcl_uvol
