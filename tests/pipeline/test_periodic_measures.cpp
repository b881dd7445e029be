// SPDX-License-Identifier: BSD-3-Clause
// Measures of meshes that the faces of a periodic box cut: what they enclose through
// the box, against known volumes and against samples counted by their values.
#include "common/scalar_field.h"
#include "pipeline/periodic_samples.h"
#include "pipeline/run_pipeline.h"
#include <pcl_uvol/mesh/surface_measures.h>

#include <gtest/gtest.h>

#include <cmath>

namespace test_periodic_measures {

using namespace pcl_uvol;
using namespace uvol_test;

constexpr double box_volume = side * side * side;

double
wave(const Place& p)
{
  double sum = 0.0;
  for (const double x : p)
    sum += std::cos(2.0 * pi * x / side);
  return sum;
}

/** Samples with f and, of each sample, a mass of 0.5. */
std::shared_ptr<Dataset>
makeMasses(std::size_t count, const Field& field, const Place& shift = {})
{
  auto samples = makePeriodicSamples(count, field, shift);
  setField(*samples, "mass", std::vector<double>(count, 0.5));
  return samples;
}

SurfaceFigures
measureInBox(const std::shared_ptr<Dataset>& samples,
             const IsosurfacePipelineParameters& parameters)
{
  IsosurfaceResult result = runPipeline(samples, parameters);
  SurfaceMeasures measures;
  measures.setInputSurface(std::make_shared<Dataset>(std::move(result.surface)),
                           result.triangles);
  measures.setInputSamples(samples);
  SurfaceMeasuresParameters own;
  own.field = "f";
  own.outside = parameters.isosurface.outside;
  own.periodic = parameters.periodic;
  measures.setParameters(own);
  return measures.compute();
}

IsosurfacePipelineParameters
makeMeshParameters(double isovalue, Outside outside, PeriodicMesh ends)
{
  IsosurfacePipelineParameters parameters = makePeriodicParameters(isovalue);
  parameters.isosurface.outside = outside;
  parameters.mesh.emplace();
  parameters.periodic_mesh = ends;
  return parameters;
}

double
sumOf(const PieceMeasures& all, const std::string& name)
{
  for (const InnerFieldMeasures& field : all.inside)
    if (field.name == name)
      return field.sum;
  return std::nan("");
}

/** Samples of the wrong side are few: those at the surface. */
void
expectSamplesAsBeyond(const PieceMeasures& all, double part)
{
  ASSERT_TRUE(all.samples_beyond);
  const auto beyond = static_cast<double>(*all.samples_beyond);
  EXPECT_NEAR(beyond, static_cast<double>(all.samples), part * beyond);
  EXPECT_DOUBLE_EQ(0.5 * static_cast<double>(all.samples), sumOf(all, "mass"));
  ASSERT_EQ(2u, all.sums_beyond.size());
  EXPECT_EQ("mass", all.sums_beyond[1].name);
  EXPECT_DOUBLE_EQ(0.5 * beyond, all.sums_beyond[1].sum);
}

TEST(PeriodicMeasures, ASphereOnACornerIsWhole)
{
  const double radius = 2.0, volume = 4.0 / 3.0 * pi * std::pow(radius, 3);
  const auto samples = makeMasses(8000, distanceToCorner);
  for (const PeriodicMesh ends : {PeriodicMesh::Cut, PeriodicMesh::Weld}) {
    const SurfaceFigures figures =
        measureInBox(samples, makeMeshParameters(radius, Outside::Higher, ends));
    const PieceMeasures& all = figures.isovalues.at(0);
    EXPECT_EQ(0u, all.rims);
    EXPECT_NEAR(volume, all.volume.value, 2e-3 * volume);
    EXPECT_LE(std::abs(all.volume.value - volume), all.volume.error);
    EXPECT_NEAR(4.0 * pi * radius * radius, all.area.value, 2e-3 * all.area.value);
    expectSamplesAsBeyond(all, 0.02);
    ASSERT_EQ(ends == PeriodicMesh::Cut ? 8u : 1u, figures.pieces.size());
    std::int64_t of_pieces = 0;
    for (const PieceMeasures& piece : figures.pieces) {
      EXPECT_NEAR(volume / static_cast<double>(figures.pieces.size()),
                  piece.volume.value,
                  0.01 * volume);
      of_pieces += piece.samples;
    }
    EXPECT_EQ(all.samples, of_pieces);
    if (ends == PeriodicMesh::Weld) {
      EXPECT_EQ(0u, figures.pieces[0].genus);
    }
  }
}

TEST(PeriodicMeasures, WhatIsOutsideOfASphereIsTheRestOfTheBox)
{
  const double radius = 2.0, volume = box_volume - 4.0 / 3.0 * pi * std::pow(radius, 3);
  for (const Place& shift : {Place{}, Place{4.0, 3.0, 4.0}, Place{0.0, 3.0, 4.0}}) {
    const auto samples = makeMasses(8000, distanceToCorner, shift);
    const PieceMeasures all =
        measureInBox(samples,
                     makeMeshParameters(radius, Outside::Lower, PeriodicMesh::Weld))
            .isovalues.at(0);
    EXPECT_NEAR(volume, all.volume.value, 1e-3 * volume);
    expectSamplesAsBeyond(all, 0.002);
    EXPECT_NEAR(all.volume.value,
                all.inside.at(0).integral.value / all.inside[0].mean,
                1e-9 * volume);
    EXPECT_NEAR(0.5 * 8000.0 * volume / box_volume, sumOf(all, "mass"), 100.0);
  }
}

TEST(PeriodicMeasures, SurfacesThatGoThroughTheWholeBoxEncloseAPart)
{
  for (const Place& shift : {Place{}, Place{1.0, 2.5, 6.0}})
    for (const PeriodicMesh ends : {PeriodicMesh::Cut, PeriodicMesh::Weld})
      for (const Outside outside : {Outside::Lower, Outside::Higher}) {
        const PieceMeasures all = measureInBox(makeMasses(8000, wave, shift),
                                               makeMeshParameters(0.0, outside, ends))
                                      .isovalues.at(0);
        EXPECT_EQ(0u, all.rims);
        EXPECT_NEAR(0.5 * box_volume, all.volume.value, 2e-3 * box_volume);
        // The area of Schwarz' P surface in its cube is 2.3451 of a side.
        EXPECT_NEAR(2.35 * side * side, all.area.value, 0.01 * all.area.value);
        expectSamplesAsBeyond(all, 0.01);
      }
}

TEST(PeriodicMeasures, SlabsHaveTwoSides)
{
  for (int axis = 0; axis < 3; ++axis)
    for (const double isovalue : {0.5, -0.5}) {
      const Field field = [&](const Place& p) {
        return std::cos(2.0 * pi * p[static_cast<std::size_t>(axis)] / side);
      };
      const PieceMeasures all =
          measureInBox(makeMasses(8000, field),
                       makeMeshParameters(isovalue, Outside::Lower, PeriodicMesh::Cut))
              .isovalues.at(0);
      EXPECT_EQ(0u, all.rims);
      EXPECT_NEAR(2.0 * side * side, all.area.value, 1e-2);
      EXPECT_NEAR((isovalue > 0.0 ? 1.0 : 2.0) / 3.0 * box_volume,
                  all.volume.value,
                  2e-3 * box_volume);
      expectSamplesAsBeyond(all, 0.01);
    }
}

TEST(PeriodicMeasures, BoxesMayBePeriodicAlongOneAxis)
{
  // A cylinder about each axis in turn, which the two faces across it cut.
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Field field = [&](const Place& p) {
      return std::hypot(p[(axis + 1) % 3] - 4.0, p[(axis + 2) % 3] - 4.0);
    };
    auto parameters = makeMeshParameters(2.0, Outside::Higher, PeriodicMesh::Cut);
    parameters.periodic.setZero();
    parameters.periodic[static_cast<int>(axis)] = side;
    const PieceMeasures all =
        measureInBox(makeMasses(8000, field), parameters).isovalues.at(0);
    EXPECT_EQ(0u, all.rims);
    EXPECT_NEAR(4.0 * pi * side, all.volume.value, 2e-3 * all.volume.value);
    EXPECT_NEAR(4.0 * pi * side, all.area.value, 2e-3 * all.area.value);
    expectSamplesAsBeyond(all, 0.02);
  }
}

} // namespace test_periodic_measures
