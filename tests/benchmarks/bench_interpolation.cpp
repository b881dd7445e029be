// SPDX-License-Identifier: BSD-3-Clause
// A smooth field at random places from random samples: blended fits beside VTK's point
// interpolator with a Gaussian kernel, natural neighbours beside CGAL's. The counter
// rms is the error in units of the field, whose range is about 1.2; outside counts
// queries without a value.
#include "support/interpolation_cases.h"
#include <pcl_uvol/interpolation/field_interpolation.h>

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>
#include <CGAL/natural_neighbor_coordinates_3.h>
#include <benchmark/benchmark.h>
#include <vtkDoubleArray.h>
#include <vtkGaussianKernel.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPointInterpolator.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStaticPointLocator.h>

#include <cmath>
#include <map>
#include <numeric>

namespace {

using namespace uvol_test;
using pcl_uvol::InterpolationModel;
using pcl_uvol::detail::FieldInterpolator;

struct Setup {
  Places samples, queries;
  pcl::PCLPointCloud2 cloud; ///< fields f0 to f7
  pcl::Indices indices;

  Setup(std::size_t n, std::size_t asked)
      : samples(randomPlaces(n, 1))
      // Away from the border, where values are those of extrapolation.
      , queries(randomPlaces(asked, 2, 0.05, 0.95))
      , cloud(sampleFunctions(samples, std::vector<Function>(8, franke)))
      , indices(n)
  {
    std::iota(indices.begin(), indices.end(), 0);
  }
};

const Setup&
setup(const benchmark::State& state)
{
  static std::map<std::pair<std::int64_t, std::int64_t>, Setup> setups;
  const auto sizes = std::pair(state.range(0), state.range(1));
  return setups
      .try_emplace(sizes,
                   static_cast<std::size_t>(sizes.first),
                   static_cast<std::size_t>(sizes.second))
      .first->second;
}

void
setRms(benchmark::State& state, const Places& queries, const double* values)
{
  double squares = 0.0, count = 0.0;
  for (std::size_t i = 0; i < queries.size(); ++i) {
    const double off = values[i] - franke(vectorOf(queries[i]));
    if (std::isnan(off))
      continue;
    squares += off * off;
    count += 1.0;
  }
  state.counters["rms"] = std::sqrt(squares / count);
  state.counters["outside"] = static_cast<double>(queries.size()) - count;
  state.SetItemsProcessed(static_cast<std::int64_t>(queries.size()) *
                          state.iterations());
}

FieldInterpolator
makeInterpolator(const Setup& data,
                 InterpolationModel model,
                 std::size_t fields,
                 unsigned threads)
{
  pcl_uvol::InterpolationParameters parameters;
  parameters.model = model;
  parameters.gradients = parameters.errors = false;
  for (std::size_t f = 0; f < fields; ++f)
    parameters.fields.push_back("f" + std::to_string(f));
  pcl_uvol::Report report;
  return {pcl_uvol::viewOf(data.cloud), data.indices, parameters, threads, report};
}

void
uvolMade(benchmark::State& state,
         InterpolationModel model,
         std::size_t fields,
         unsigned threads = 0)
{
  const Setup& data = setup(state);
  pcl_uvol::InterpolatedFields answers;
  for (auto _ : state) {
    pcl_uvol::Report report;
    answers = makeInterpolator(data, model, fields, threads)
                  .interpolate(data.queries, threads, report);
  }
  setRms(state, data.queries, answers.values.data());
}

void
uvolKept(benchmark::State& state, InterpolationModel model, std::size_t fields)
{
  const Setup& data = setup(state);
  const FieldInterpolator interpolator = makeInterpolator(data, model, fields, 0);
  pcl_uvol::Report report;
  auto answers = interpolator.interpolate(data.queries, 0, report);
  for (auto _ : state)
    answers = interpolator.interpolate(data.queries, 0, report);
  setRms(state, data.queries, answers.values.data());
}

vtkSmartPointer<vtkPolyData>
toPolyData(const Places& places)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const auto& place : places)
    points->InsertNextPoint(place.data());
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  return data;
}

/** \param reach of the kernel in spacings, with sharpness 2 */
void
vtkGaussian(benchmark::State& state, double reach)
{
  const Setup& data = setup(state);
  const auto source = toPolyData(data.samples), input = toPolyData(data.queries);
  vtkNew<vtkDoubleArray> values;
  values->SetName("f0");
  for (const auto& place : data.samples)
    values->InsertNextValue(franke(vectorOf(place)));
  source->GetPointData()->SetScalars(values);
  vtkNew<vtkGaussianKernel> kernel;
  kernel->SetSharpness(2.0);
  kernel->SetRadius(reach / std::cbrt(static_cast<double>(data.samples.size())));
  vtkNew<vtkPointInterpolator> interpolator;
  interpolator->SetKernel(kernel);
  interpolator->SetNullPointsStrategyToClosestPoint();
  interpolator->SetInputData(input);
  interpolator->SetSourceData(source);
  for (auto _ : state) {
    vtkNew<vtkStaticPointLocator> locator;
    interpolator->SetLocator(locator);
    interpolator->Modified();
    interpolator->Update();
  }
  setRms(state,
         data.queries,
         vtkDoubleArray::SafeDownCast(
             interpolator->GetOutput()->GetPointData()->GetArray("f0"))
             ->GetPointer(0));
}

void
cgalSibson(benchmark::State& state)
{
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Vertex = CGAL::Triangulation_vertex_base_with_info_3<double, Kernel>;
  using Cell = CGAL::Delaunay_triangulation_cell_base_3<Kernel>;
  using Triangulation =
      CGAL::Delaunay_triangulation_3<Kernel,
                                     CGAL::Triangulation_data_structure_3<Vertex, Cell>,
                                     CGAL::Fast_location>;
  const Setup& data = setup(state);
  std::vector<std::pair<Kernel::Point_3, double>> samples;
  for (const auto& place : data.samples)
    samples.emplace_back(Kernel::Point_3(place[0], place[1], place[2]),
                         franke(vectorOf(place)));
  std::vector<double> values(data.queries.size());
  for (auto _ : state) {
    const Triangulation triangulation(samples.begin(), samples.end());
    for (std::size_t i = 0; i < values.size(); ++i) {
      std::vector<std::pair<Triangulation::Vertex_handle, double>> weights;
      double sum = 0.0, value = 0.0;
      const auto& q = data.queries[i];
      CGAL::sibson_natural_neighbor_coordinates_3(
          triangulation, {q[0], q[1], q[2]}, std::back_inserter(weights), sum);
      for (const auto& [vertex, weight] : weights)
        value += weight / sum * vertex->info();
      values[i] = value;
    }
  }
  setRms(state, data.queries, values.data());
}

constexpr std::int64_t million = 1000000;

#define SIZED(call) BENCHMARK_CAPTURE call->Unit(benchmark::kMillisecond)->UseRealTime()

SIZED((uvolMade, fit, InterpolationModel::Fit, 1))->Args({million, million});
SIZED((uvolMade, fit_8_fields, InterpolationModel::Fit, 8))->Args({million, million});
SIZED((uvolKept, fit, InterpolationModel::Fit, 1))->Args({million, million});
SIZED((uvolKept, fit_8_fields, InterpolationModel::Fit, 8))->Args({million, million});
SIZED((vtkGaussian, 1_5_spacings, 1.5))->Args({million, million});
SIZED((vtkGaussian, 2_5_spacings, 2.5))->Args({million, million});
SIZED((uvolMade, natural, InterpolationModel::Sibson, 1))->Args({million, million});
SIZED((uvolMade, natural_1_thread, InterpolationModel::Sibson, 1, 1))
    ->Args({100000, 20000})
    ->Args({million, million});
SIZED((uvolMade, laplace_1_thread, InterpolationModel::Laplace, 1, 1))
    ->Args({100000, 20000})
    ->Args({million, million});
BENCHMARK(cgalSibson)
    ->Args({100000, 20000})
    ->Args({million, million})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
SIZED((uvolMade, kriging, InterpolationModel::Kriging, 1))->Args({million, 100000});

} // namespace

BENCHMARK_MAIN();
