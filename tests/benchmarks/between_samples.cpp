// SPDX-License-Identifier: BSD-3-Clause
// Errors of interpolated values, by model: at random positions in the cells of grids,
// where VTK's cells give the true value, and at held-out samples of other data.
#include "common/scalar_field.h"
#include "interpolation/fold_split.h"
#include "io/cell_loader.h"
#include "support/environment.h"
#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/interpolation/cross_validation.h>
#include <pcl_uvol/interpolation/field_interpolation.h>
#include <pcl_uvol/io/dataset.h>

#include <vtkDataArray.h>
#include <vtkDataSet.h>
#include <vtkDataSetReader.h>
#include <vtkGenericCell.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkSmartPointer.h>
#include <vtkXMLGenericDataObjectReader.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numeric>
#include <string>
#include <vector>

namespace {

using pcl_uvol::InterpolationModel;

/** A file, its field, and whether cells give the true values. */
struct Case {
  std::string file, field;
  bool has_cells = false;
};

const std::vector<Case> cases = {
    {"cfd/bluntfin.vts", "Density", true},
    {"cfd/bluntfin.vts", "Pressure", true},
    {"cfd/comb.vts", "Density", true},
    {"cfd/disk_out_ref.vtu", "Temp", true},
    {"cfd/disk_out_ref.vtu", "AsH3", true},
    {"cfd/can.vtu", "|VEL|", true},
    {"cfd/bluntfin.vts", "Density"},
    {"cfd/comb.vts", "Density"},
    {"cfd/blow.vtk", "thickness9"},
    {"particles/starsmasher_giant.csv", "rho"},
    {"particles/starsmasher_giant.csv", "u"},
    {"particles/planet_remnant.csv", "rho_g_cm3"},
    {"particles/dam_break_frame_9.csv", "density"},
    {"particles/dam_break_frame_9.csv", "|vx,vy,vz|"},
    {"particles/double_dam_break_frame_26.vtk", "|velocity|"},
    {"sensors/seaglider_sg542.csv", "temperature_C"},
    {"sensors/seaglider_sg542.csv", "oxygen_umol_kg"},
    {"sensors/seaglider_sg542.csv", "salinity_psu"},
    {"sensors/argo_4901079_gulfstream.csv", "temperature_C"},
    {"sensors/argo_4901079_gulfstream.csv", "salinity_psu"},
    {"sensors/babbitt_drillholes.csv", "cu_pct"},
    {"sensors/babbitt_drillholes.csv", "ni_pct"}};

constexpr InterpolationModel models[] = {InterpolationModel::Fit,
                                         InterpolationModel::Auto,
                                         InterpolationModel::Sibson,
                                         InterpolationModel::Kriging,
                                         InterpolationModel::Shepard,
                                         InterpolationModel::Nearest};

/** What a model estimated at the tested positions. */
struct Answers {
  std::vector<double> values, errors;
  double seconds = 0.0;
};

double
quantile(std::vector<double> values, double part)
{
  const auto rank = values.begin() + static_cast<std::ptrdiff_t>(
                                         part * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), rank, values.end());
  return *rank;
}

/** Prints a row per model: errors are taken where all models have a value, in standard
 * deviations of the field there. */
void
printRows(const Case& data,
          const std::string& test,
          const std::vector<double>& truth,
          const std::vector<std::pair<std::string, Answers>>& answers)
{
  std::vector<std::size_t> common;
  double mean = 0.0, variance = 0.0;
  for (std::size_t i = 0; i < truth.size(); ++i)
    if (std::all_of(answers.begin(),
                    answers.end(),
                    [&](const auto& answer) {
                      return std::isfinite(answer.second.values[i]);
                    }) &&
        std::isfinite(truth[i])) {
      common.push_back(i);
      mean += truth[i];
    }
  mean /= static_cast<double>(common.size());
  for (const std::size_t i : common)
    variance += (truth[i] - mean) * (truth[i] - mean);
  const double deviation = std::sqrt(variance / static_cast<double>(common.size()));
  std::printf("%s %s, %s, %zu positions, %zu with a value of all models\n",
              data.file.c_str(),
              data.field.c_str(),
              test.c_str(),
              truth.size(),
              common.size());
  for (const auto& [model, answer] : answers) {
    std::vector<double> errors;
    double squares = 0.0, none = 0.0, covered = 0.0;
    for (const std::size_t i : common) {
      const double error = std::abs(answer.values[i] - truth[i]);
      errors.push_back(error / deviation);
      squares += errors.back() * errors.back();
      covered += error <= answer.errors[i];
    }
    for (const double value : answer.values)
      none += std::isnan(value);
    const auto count = static_cast<double>(errors.size());
    const double beyond = static_cast<double>(
        std::count_if(errors.begin(), errors.end(), [](double e) { return e > 0.3; }));
    std::printf("  %-8s rms %9.4g median %8.4f 95%% %8.4f beyond 0.3 %5.1f%% none "
                "%4.1f%% covered %4.1f%% %6.2f s\n",
                model.c_str(),
                std::sqrt(squares / count),
                quantile(errors, 0.5),
                quantile(errors, 0.95),
                100.0 * beyond / count,
                100.0 * none / static_cast<double>(truth.size()),
                100.0 * covered / count,
                answer.seconds);
  }
  std::fflush(stdout);
}

std::string
nameOf(InterpolationModel model)
{
  for (const auto& word : pcl_uvol::listWords(model))
    if (word.value == model)
      return word.word;
  return {};
}

/** Positions in cells, and the values there. */
struct Truth {
  std::vector<std::array<double, 3>> places;
  std::vector<double> values;
};

vtkSmartPointer<vtkDataSet>
readGrid(const std::string& path)
{
  if (path.size() > 4 && path.substr(path.size() - 4) == ".vtk") {
    vtkNew<vtkDataSetReader> reader;
    reader->SetFileName(path.c_str());
    reader->Update();
    return reader->GetOutput();
  }
  vtkNew<vtkXMLGenericDataObjectReader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  return vtkDataSet::SafeDownCast(reader->GetOutput());
}

double
valueAt(vtkDataSet* grid, const std::string& field, vtkIdType point)
{
  const bool is_length = field[0] == '|';
  const std::string name = is_length ? field.substr(1, field.size() - 2) : field;
  vtkDataArray* const array = grid->GetPointData()->GetArray(name.c_str());
  if (!is_length)
    return array->GetComponent(point, 0);
  double squares = 0.0;
  for (int i = 0; i < array->GetNumberOfComponents(); ++i)
    squares += array->GetComponent(point, i) * array->GetComponent(point, i);
  return std::sqrt(squares);
}

/** Random parametric coordinates of random cells. */
Truth
sampleCells(const std::string& path, const std::string& field, std::size_t count)
{
  const auto grid = readGrid(path);
  uvol_test::Random random(1);
  Truth truth;
  vtkNew<vtkGenericCell> cell;
  while (truth.places.size() < count) {
    grid->GetCell(static_cast<vtkIdType>(random.uniform() *
                                         static_cast<double>(grid->GetNumberOfCells())),
                  cell);
    const double at[3] = {random.uniform(), random.uniform(), random.uniform()};
    if (cell->GetCellDimension() != 3 || cell->GetParametricDistance(at) > 0.0)
      continue;
    std::array<double, 3> place{};
    std::vector<double> weights(static_cast<std::size_t>(cell->GetNumberOfPoints()));
    int part = 0;
    cell->EvaluateLocation(part, at, place.data(), weights.data());
    double value = 0.0;
    for (std::size_t i = 0; i < weights.size(); ++i)
      value += weights[i] *
               valueAt(grid, field, cell->GetPointId(static_cast<vtkIdType>(i)));
    truth.places.push_back(place);
    truth.values.push_back(value);
  }
  return truth;
}

/** Collects the answers of a function that a model's parameters are passed to. */
template <typename Ask>
std::vector<std::pair<std::string, Answers>>
askModels(const Case& data, const std::vector<std::string>& wanted, const Ask& ask)
{
  std::vector<std::pair<std::string, Answers>> all;
  for (const InterpolationModel model : models) {
    const std::string name = nameOf(model);
    if (!wanted.empty() &&
        std::find(wanted.begin(), wanted.end(), name) == wanted.end())
      continue;
    pcl_uvol::InterpolationParameters parameters;
    parameters.fields = {data.field};
    parameters.model = model;
    parameters.gradients = false;
    const auto start = std::chrono::steady_clock::now();
    Answers answers = ask(parameters);
    answers.seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    all.emplace_back(name, std::move(answers));
  }
  return all;
}

void
testCells(const Case& data,
          const pcl_uvol::Dataset& samples,
          const std::vector<std::string>& wanted)
{
  constexpr std::size_t count = 3000;
  const std::string path = uvol_test::dataFolder() + "/" + data.file;
  Truth truth = sampleCells(path, data.field, count);
  pcl_uvol::Report cell_report;
  const auto cells = pcl_uvol::findCells(path, {}, samples, cell_report);
  for (auto& place : truth.places)
    for (std::size_t axis = 0; axis < 3; ++axis)
      place[axis] -= samples.origin[axis];
  const auto cloud = pcl_uvol::viewOf(samples.cloud);
  pcl::Indices all(cloud.count);
  std::iota(all.begin(), all.end(), 0);
  const auto answers = askModels(data, wanted, [&](const auto& parameters) {
    pcl_uvol::Report report;
    pcl_uvol::detail::FieldInterpolator interpolator(cloud, all, parameters, 0, report);
    interpolator.setCells(cells);
    const auto result = interpolator.interpolate(truth.places, 0, report);
    return Answers{result.values, result.errors};
  });
  printRows(data, "cells", truth.values, answers);
}

void
testFolds(const Case& data,
          const pcl_uvol::Dataset& samples,
          const std::string& by,
          const std::vector<std::string>& wanted)
{
  constexpr std::size_t fold_count = 10, tested = 3, most = 1000;
  const auto cloud = pcl_uvol::viewOf(samples.cloud);
  const pcl_uvol::ScalarField field(cloud.fields, data.field);
  pcl::Indices all;
  for (std::size_t i = 0; i < cloud.count; ++i)
    if (std::isfinite(field.read(cloud.point(i))))
      all.push_back(static_cast<int>(i));
  const auto folds = by == "random" ? pcl_uvol::Folds::byRandom(cloud.count, fold_count)
                                    : pcl_uvol::Folds::byBlocks(cloud, fold_count, 0);
  std::vector<pcl_uvol::detail::FoldSplit> splits;
  std::vector<double> truth;
  for (std::size_t fold = 0; fold < tested; ++fold) {
    splits.emplace_back(all, folds, fold, most);
    for (const int sample : splits.back().left_out)
      truth.push_back(field.read(cloud.point(static_cast<std::size_t>(sample))));
  }
  const auto answers = askModels(data, wanted, [&](const auto& parameters) {
    Answers joined;
    for (const auto& split : splits) {
      pcl_uvol::Report report;
      const auto result = split.interpolate(cloud, parameters, 0, report);
      joined.values.insert(
          joined.values.end(), result.values.begin(), result.values.end());
      joined.errors.insert(
          joined.errors.end(), result.errors.begin(), result.errors.end());
    }
    return joined;
  });
  printRows(data, by, truth, answers);
}

} // namespace

/** between_samples [PART OF FILE:FIELD [cells|random|blocks|all [MODEL...]]] */
int
main(int argc, char** argv)
{
  const std::string part = argc > 1 ? argv[1] : "", test = argc > 2 ? argv[2] : "all";
  const std::vector<std::string> wanted(argv + std::min(argc, 3), argv + argc);
  for (const Case& data : cases) {
    if ((data.file + ":" + data.field).find(part) == std::string::npos)
      continue;
    const auto samples =
        pcl_uvol::loadDataset(uvol_test::dataFolder() + "/" + data.file);
    if (data.has_cells && (test == "all" || test == "cells"))
      testCells(data, samples, wanted);
    for (const std::string by : {"random", "blocks"})
      if (!data.has_cells && (test == "all" || test == by))
        testFolds(data, samples, by, wanted);
  }
  return 0;
}
