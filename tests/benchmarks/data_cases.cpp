// SPDX-License-Identifier: BSD-3-Clause
#include "data_cases.h"

#include "generation/analytic_fields.h"
#include "support/environment.h"
#include <pcl_uvol/expressions/derived_fields.h>
#include <pcl_uvol/interpolation/cross_validation.h>
#include <pcl_uvol/io/dataset.h>

#include <pcl/conversions.h>
#include <pcl/point_types.h>

#include <numeric>

namespace uvol_benchmark {

using pcl_uvol::Dataset;

namespace {

/** The lattice of a volume as samples. */
Dataset
toSamples(const pcl_uvol::Volume& volume)
{
  pcl::PointCloud<pcl::PointXYZI> cloud;
  std::size_t i = 0;
  for (std::size_t z = 0; z < volume.dims[2]; ++z)
    for (std::size_t y = 0; y < volume.dims[1]; ++y)
      for (std::size_t x = 0; x < volume.dims[0]; ++x) {
        pcl::PointXYZI point;
        point.x = static_cast<float>(x);
        point.y = static_cast<float>(y);
        point.z = static_cast<float>(z);
        point.intensity = static_cast<float>(volume.values[i++]);
        cloud.push_back(point);
      }
  Dataset dataset;
  pcl::toPCLPointCloud2(cloud, dataset.cloud);
  return dataset;
}

/** Samples of a gyroid on lines, each of which has a number.
 * \param lines their kind, as "generated: tracks" */
Dataset
generate(const std::string& lines)
{
  constexpr std::uint64_t count = 20000, seed = 1;
  const pcl_uvol::AnalyticField& field = pcl_uvol::findAnalyticField("gyroid");
  const auto scatter = lines == "generated: tracks"  ? pcl_uvol::Scatter::Tracks
                       : lines == "generated: casts" ? pcl_uvol::Scatter::Casts
                                                     : pcl_uvol::Scatter::Holes;
  std::vector<double> xyz, values;
  std::vector<std::int32_t> line;
  for (std::uint64_t i = 0; i < count; ++i) {
    const auto place =
        pcl_uvol::scatterAt(scatter, seed, i, count, field.lower, field.upper);
    xyz.insert(xyz.end(), place.begin(), place.end());
    values.push_back(field.value(place));
    line.push_back(static_cast<std::int32_t>(pcl_uvol::lineOf(scatter, i, count)));
  }
  Dataset dataset;
  pcl_uvol::setCoordinates(dataset, xyz);
  pcl_uvol::setField(dataset, field.name, values);
  pcl_uvol::setField(dataset, "line", line);
  return dataset;
}

} // namespace

const std::vector<DataCase>&
listCases()
{
  static const std::vector<DataCase> cases = {
      {"particles/starsmasher_giant.csv", "rho", 0.01},
      {"particles/starsmasher_giant.csv", "u", 0.3},
      {"particles/planet_remnant.csv", "rho_g_cm3", 4.5},
      {"particles/planet_remnant.csv", "rho_g_cm3", 8},
      {"particles/dam_break_frame_9.csv", "density", 900},
      {"particles/dam_break_frame_9.csv", "density", 900, {0, 0, 0}},
      {"particles/dam_break_frame_9.csv", "|vx,vy,vz|", 2},
      {"particles/double_dam_break_frame_26.vtk", "|velocity|", 2},
      {"sensors/seaglider_sg542.csv", "temperature_C", 6, {1, 1, 100}, "dive"},
      {"sensors/seaglider_sg542.csv", "temperature_C", 6, {1, 1, 1}, "dive"},
      {"sensors/seaglider_sg542.csv", "oxygen_umol_kg", 225, {1, 1, 100}, "dive"},
      {"sensors/seaglider_sg542.csv", "salinity_psu", 34.3, {1, 1, 100}, "dive"},
      {"sensors/seaglider_sg542.csv", "temperature_C", 6, {0, 0, 0}, "dive"},
      {"sensors/seaglider_sg542.csv", "temperature_C", 4, {0, 0, 0}, "dive"},
      {"sensors/seaglider_sg542.csv", "oxygen_umol_kg", 225, {0, 0, 0}, "dive"},
      {"sensors/seaglider_sg542.csv", "salinity_psu", 34.3, {0, 0, 0}, "dive"},
      {"sensors/argo_4901079_gulfstream.csv", "temperature_C", 12, {1, 1, 1}, "cycle"},
      {"sensors/argo_4901079_gulfstream.csv", "temperature_C", 16, {1, 1, 1}, "cycle"},
      {"sensors/argo_4901079_gulfstream.csv", "salinity_psu", 35.5, {1, 1, 1}, "cycle"},
      {"sensors/babbitt_drillholes.csv", "cu_pct", 0.6, {1, 1, 1}, "hole"},
      {"sensors/babbitt_drillholes.csv", "cu_pct", 0.3, {1, 1, 1}, "hole"},
      {"sensors/babbitt_drillholes.csv", "ni_pct", 0.1, {1, 1, 1}, "hole"},
      {"sensors/orebro_gas_network.csv",
       "mean_ppm",
       1,
       {1, 1, 1},
       "random",
       "experiment=1",
       {"ix", "iy", "iz"}},
      {"generated: tracks", "gyroid", 0, {1, 1, 1}, "line"},
      {"generated: casts", "gyroid", 0, {1, 1, 1}, "line"},
      {"generated: holes", "gyroid", 0, {1, 1, 1}, "line"},
      {"cfd/comb.vts", "Density", 0.3},
      {"cfd/bluntfin.vts", "Density", 0.9},
      {"cfd/disk_out_ref.vtu", "Temp", 450},
      {"cfd/can.vtu", "|VEL|", 3000},
      {"cfd/blow.vtk", "thickness9", 0.5},
      {"volumes/bucky.nhdr", "", 120},
      {"volumes/nucleon.nhdr", "", 100},
      {"volumes/marschnerlobb.nhdr", "", 127.5},
      {"volumes/neghip.nhdr", "", 60},
      {"volumes/ironProt.vtk", "scalars", 80}};
  return cases;
}

std::shared_ptr<Dataset>
load(const DataCase& data)
{
  if (data.file.find("generated") == 0)
    return std::make_shared<Dataset>(generate(data.file));
  const std::string path = uvol_test::dataFolder() + "/" + data.file;
  if (data.field.empty())
    return std::make_shared<Dataset>(toSamples(pcl_uvol::loadVolume(path)));
  pcl_uvol::LoadOptions options;
  options.xyz_columns = data.columns;
  auto samples = std::make_shared<Dataset>(pcl_uvol::loadDataset(path, options));
  pcl_uvol::Report report;
  if (!data.where.empty())
    pcl_uvol::selectRows(*samples, data.where, {}, report);
  return samples;
}

Eigen::Array3f
findScale(const DataCase& data, const pcl_uvol::CloudView& cloud)
{
  if ((data.scale > 0.0f).all())
    return data.scale;
  pcl::Indices all(cloud.count);
  std::iota(all.begin(), all.end(), 0);
  pcl_uvol::Report report;
  return pcl_uvol::chooseScale(
             cloud, all, data.field, Eigen::Array3d::Zero(), 0, report)
      .scale;
}

} // namespace uvol_benchmark
