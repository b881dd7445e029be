// SPDX-License-Identifier: BSD-3-Clause
// The hold-out test of isosurfaces: which samples that were left out lie on the right
// side, beside what the nearest sample and a Delaunay tetrahedralisation say.
#include "pipeline/dataset_info.h"
#include "pipeline/hold_out.h"
#include "support/environment.h"
#include <pcl_uvol/expressions/derived_fields.h>
#include <pcl_uvol/io/dataset.h>
#include <pcl_uvol/io/volume.h>

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>
#include <pcl/conversions.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <map>
#include <memory>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

namespace {

using pcl_uvol::Dataset;
using pcl_uvol::HeldOutSample;
using pcl_uvol::Interpolation;
using pcl_uvol::IsosurfacePipelineParameters;
using pcl_uvol::NormalMethod;
using pcl_uvol::ValidateBy;

/** A data set and the surface that is asked of it. */
struct Case {
  std::string file, field;
  double isovalue;
  Eigen::Array3f scale{1.0f, 1.0f, 1.0f};
  std::string by = "random";
  std::string where{};
  std::array<std::string, 3> columns{};
};

const std::vector<Case>&
listCases()
{
  static const std::vector<Case> cases = {
      {"particles/starsmasher_giant.csv", "rho", 0.01},
      {"particles/starsmasher_giant.csv", "u", 0.3},
      {"particles/planet_remnant.csv", "rho_g_cm3", 4.5},
      {"particles/planet_remnant.csv", "rho_g_cm3", 8},
      {"particles/dam_break_frame_9.csv", "density", 900},
      {"particles/dam_break_frame_9.csv", "|vx,vy,vz|", 2},
      {"particles/double_dam_break_frame_26.vtk", "|velocity|", 2},
      {"sensors/seaglider_sg542.csv", "temperature_C", 6, {1, 1, 100}, "dive"},
      {"sensors/seaglider_sg542.csv", "temperature_C", 6, {1, 1, 1}, "dive"},
      {"sensors/seaglider_sg542.csv", "oxygen_umol_kg", 225, {1, 1, 100}, "dive"},
      {"sensors/seaglider_sg542.csv", "salinity_psu", 34.3, {1, 1, 100}, "dive"},
      {"sensors/argo_4901079_gulfstream.csv", "temperature_C", 12, {1, 1, 1}, "cycle"},
      {"sensors/argo_4901079_gulfstream.csv", "temperature_C", 16, {1, 1, 1}, "cycle"},
      {"sensors/argo_4901079_gulfstream.csv", "salinity_psu", 35.5, {1, 1, 1}, "cycle"},
      {"sensors/babbitt_drillholes.csv", "cu_pct", 0.6, {1, 1, 1}, "hole"},
      {"sensors/babbitt_drillholes.csv", "cu_pct", 0.3, {1, 1, 1}, "hole"},
      {"sensors/babbitt_drillholes.csv", "ni_pct", 0.1, {1, 1, 1}, "hole"},
      {"sensors/orebro_gas_network.csv",
       "mean_ppm",
       5,
       {1, 1, 1},
       "random",
       "experiment=1",
       {"ix", "iy", "iz"}},
      {"cfd/comb.vts", "Density", 0.3},
      {"cfd/bluntfin.vts", "Density", 0.9},
      {"cfd/disk_out_ref.vtu", "Temp", 450},
      {"cfd/can.vtu", "|VEL|", 2000},
      {"cfd/blow.vtk", "thickness9", 0.5},
      {"volumes/bucky.nhdr", "", 120},
      {"volumes/nucleon.nhdr", "", 100},
      {"volumes/marschnerlobb.nhdr", "", 127.5},
      {"volumes/neghip.nhdr", "", 60},
      {"volumes/ironProt.vtk", "scalars", 80}};
  return cases;
}

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

/** The last column of a table, whose names become numbers. */
std::vector<float>
readNames(const std::string& path)
{
  std::ifstream file(path);
  std::map<std::string, float> numbers;
  std::vector<float> column;
  std::string line;
  std::getline(file, line); // the header
  while (std::getline(file, line)) {
    const std::string name = line.substr(line.rfind(',') + 1);
    column.push_back(
        numbers.emplace(name, static_cast<float>(numbers.size())).first->second);
  }
  return column;
}

std::shared_ptr<Dataset>
load(const Case& data)
{
  const std::string path = uvol_test::dataFolder() + "/" + data.file;
  if (data.field.empty())
    return std::make_shared<Dataset>(toSamples(pcl_uvol::loadVolume(path)));
  pcl_uvol::LoadOptions options;
  options.xyz_columns = data.columns;
  auto samples = std::make_shared<Dataset>(pcl_uvol::loadDataset(path, options));
  pcl_uvol::Report report;
  if (!data.where.empty())
    pcl_uvol::selectRows(*samples, data.where, {}, report);
  if (data.by == "hole")
    pcl_uvol::setField(*samples, "hole", readNames(path));
  return samples;
}

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Vertex = CGAL::Triangulation_vertex_base_with_info_3<double, Kernel>;
using Delaunay =
    CGAL::Delaunay_triangulation_3<Kernel,
                                   CGAL::Triangulation_data_structure_3<Vertex>,
                                   CGAL::Fast_location>;

/** Linear interpolation in the Delaunay tetrahedralisation of the samples that were not
 * left out; beyond their hull the nearest sample's class. */
class DelaunayClass {
public:
  DelaunayClass(const Dataset& samples,
                const IsosurfacePipelineParameters& parameters,
                const pcl_uvol::Folds& folds)
      : cloud_(pcl_uvol::viewOf(samples.cloud))
      , values_(pcl_uvol::readFieldValues(
            samples, pcl_uvol::ScalarField(cloud_.fields, parameters.isosurface.field)))
      , scale_(parameters.isosurface.scale)
      , folds_(folds)
      , isovalue_(parameters.isosurface.isovalues[0])
  {
  }

  bool
  isAbove(const HeldOutSample& sample)
  {
    leaveOut(folds_[sample.point]);
    const Kernel::Point_3 place = placeOf(sample.point);
    cell_ = delaunay_.locate(place, cell_);
    if (delaunay_.dimension() < 3 || delaunay_.is_infinite(cell_))
      return sample.is_nearest_above;
    const auto at = [&](int i) { return cell_->vertex(i)->point(); };
    double value = 0.0;
    const double whole = CGAL::volume(at(0), at(1), at(2), at(3));
    for (int i = 0; i < 4; ++i) {
      Kernel::Point_3 corner[4] = {at(0), at(1), at(2), at(3)};
      corner[i] = place;
      value += CGAL::volume(corner[0], corner[1], corner[2], corner[3]) / whole *
               cell_->vertex(i)->info();
    }
    return value >= isovalue_;
  }

private:
  Kernel::Point_3
  placeOf(std::size_t point) const
  {
    const float* const xyz = cloud_.xyz(point);
    return {xyz[0] * scale_[0], xyz[1] * scale_[1], xyz[2] * scale_[2]};
  }

  void
  leaveOut(std::size_t fold)
  {
    if (fold == fold_)
      return;
    fold_ = fold;
    std::vector<std::pair<Kernel::Point_3, double>> rest;
    for (std::size_t i = 0; i < cloud_.count; ++i) {
      const float* const xyz = cloud_.xyz(i);
      if (folds_[i] != fold && std::isfinite(values_[i]) && std::isfinite(xyz[0]) &&
          std::isfinite(xyz[1]) && std::isfinite(xyz[2]))
        rest.emplace_back(placeOf(i), values_[i]);
    }
    delaunay_.clear();
    delaunay_.insert(rest.begin(), rest.end());
    cell_ = Delaunay::Cell_handle();
  }

  pcl_uvol::CloudView cloud_;
  std::vector<double> values_;
  Eigen::Array3f scale_;
  const pcl_uvol::Folds& folds_;
  double isovalue_;
  std::size_t fold_ = ~std::size_t(0);
  Delaunay delaunay_;
  Delaunay::Cell_handle cell_;
};

/** A way to extract the surface. */
struct Method {
  const char* name;
  Interpolation interpolation;
  NormalMethod normals;
  bool fill_gaps = false;
};

const Method methods[] = {
    {"auto, filled", Interpolation::Auto, NormalMethod::Auto, true},
    {"auto", Interpolation::Auto, NormalMethod::Auto},
    {"fit", Interpolation::Fit, NormalMethod::Fit},
    {"linear, edge", Interpolation::Linear, NormalMethod::Edge},
    {"linear, pca", Interpolation::Linear, NormalMethod::Pca}};

void
printCase(const Case& data, std::size_t folds_at_most)
{
  const auto samples = load(data);
  const pcl_uvol::CloudView cloud = pcl_uvol::viewOf(samples->cloud);
  IsosurfacePipelineParameters parameters;
  parameters.isosurface.field = data.field.empty() ? "intensity" : data.field;
  parameters.isosurface.isovalues = {data.isovalue};
  parameters.isosurface.scale = data.scale;
  parameters.validation.folds = folds_at_most;
  parameters.validation.by =
      data.by == "random" ? ValidateBy::Random : ValidateBy::Field;
  parameters.validation.field = data.by;
  const auto folds = pcl_uvol::makeFolds(cloud, parameters.validation, 0);
  DelaunayClass delaunay(*samples, parameters, folds);
  std::vector<bool> by_delaunay;
  std::printf("%s %s %g, by %s\n",
              data.file.c_str(),
              data.field.c_str(),
              data.isovalue,
              data.by.c_str());
  pcl::Indices all(cloud.count);
  std::iota(all.begin(), all.end(), 0);
  for (const Method& method : methods) {
    parameters.isosurface.interpolation = method.interpolation;
    parameters.normals = method.normals;
    parameters.fill_gaps = method.fill_gaps;
    pcl_uvol::Report report;
    const auto told =
        pcl_uvol::holdOut(samples, all, parameters, folds, 0, report).front();
    const auto score = pcl_uvol::scoreHeldOut(told);
    if (by_delaunay.empty())
      for (const HeldOutSample& sample : told)
        by_delaunay.push_back(delaunay.isAbove(sample) == sample.is_above);
    double near = 0.0, everywhere = 0.0;
    for (std::size_t i = 0; i < told.size(); ++i) {
      near += told[i].is_covered && by_delaunay[i];
      everywhere += by_delaunay[i];
    }
    if (&method == methods)
      std::printf("  class          all %7zu          field %.3f nearest %.3f delaunay "
                  "%.3f base %.3f\n",
                  score.tested,
                  score.field.predicted,
                  score.field.nearest,
                  everywhere / static_cast<double>(told.size()),
                  score.field.base);
    std::printf(
        "  %-14s near %6zu side %.3f field %.3f nearest %.3f delaunay %.3f base "
        "%.3f everywhere %.3f beyond error %.3f of %zu\n",
        method.name,
        score.covered,
        score.side.predicted,
        score.side_of_field,
        score.side.nearest,
        near / static_cast<double>(score.covered),
        score.side.base,
        score.side_everywhere,
        score.side_beyond_error,
        score.beyond_error);
    std::fflush(stdout);
  }
}

} // namespace

/** holdout [FOLDS [PART OF A FILE'S NAME]] */
int
main(int argc, char** argv)
{
  const std::size_t folds = argc > 1 ? std::stoul(argv[1]) : 10;
  const std::string part = argc > 2 ? argv[2] : "";
  for (const Case& data : listCases())
    if (data.file.find(part) != std::string::npos)
      printCase(data, folds);
  return 0;
}
