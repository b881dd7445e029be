// SPDX-License-Identifier: BSD-3-Clause
// Gradients, curls and vortex criteria of files' fields, against functions whose
// derivatives are known.
#include "common/scalar_field.h"
#include "support/environment.h"
#include "support/flows.h"
#include "support/interpolation_cases.h"
#include "support/messages.h"
#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/expressions/derived_fields.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

using namespace pcl_uvol;
using namespace uvol_test;
using Eigen::Vector3d;

namespace test_derivatives_of_fields {

Dataset
makeDataset(const Places& places, const std::vector<Function>& functions)
{
  Dataset dataset;
  dataset.cloud = sampleFunctions(places, functions);
  return dataset;
}

std::vector<double>
derive(Dataset dataset,
       const std::string& expression,
       unsigned threads = 0,
       const std::array<double, 3>& periodic = {})
{
  Report report;
  const std::string name =
      addDerivedField(dataset, expression, {threads, "", periodic}, report);
  const CloudView cloud = viewOf(dataset.cloud);
  const ScalarField field(cloud.fields, name);
  std::vector<double> values;
  for (std::size_t i = 0; i < cloud.count; ++i)
    values.push_back(field.read(cloud.point(i)));
  return values;
}

/** The largest deviation from a function at the places. */
double
deviation(const Dataset& dataset,
          const Places& places,
          const std::string& expression,
          const Function& truth)
{
  const auto values = derive(dataset, expression);
  double largest = 0.0;
  for (std::size_t i = 0; i < places.size(); ++i)
    largest = std::max(largest, std::abs(values[i] - truth(vectorOf(places[i]))));
  return largest;
}

double
cubic(const Vector3d& x)
{
  return 1.0 + 2.0 * x[0] - x[1] * x[2] + 0.5 * x[0] * x[0] * x[1] -
         x[2] * x[2] * x[2] / 3.0 + x[0] * x[1] * x[2];
}

Vector3d
cubicGradient(const Vector3d& x)
{
  return {2.0 + x[0] * x[1] + x[1] * x[2],
          -x[2] + 0.5 * x[0] * x[0] + x[0] * x[2],
          -x[1] - x[2] * x[2] + x[0] * x[1]};
}

const Places places = randomPlaces(1500, 5, -1.0, 1.0);

TEST(DerivativesOfFields, CubicsAreExact)
{
  const Dataset dataset = makeDataset(places, {cubic});
  for (int axis = 0; axis < 3; ++axis)
    EXPECT_LT(deviation(dataset,
                        places,
                        "grad(f0)[" + std::to_string(axis) + "]",
                        [&](const Vector3d& x) { return cubicGradient(x)[axis]; }),
              1e-8);
  EXPECT_LT(deviation(dataset,
                      places,
                      "|grad(f0)|",
                      [](const Vector3d& x) { return cubicGradient(x).norm(); }),
            1e-8);
  EXPECT_LT(deviation(dataset,
                      places,
                      "laplacian(f0)",
                      [](const Vector3d& x) { return x[1] - 2.0 * x[2]; }),
            1e-6);
}

TEST(DerivativesOfFields, VectorsOfQuadratics)
{
  // v = (xy, y^2 - z, x + z^2): every entry of its gradient differs.
  const Dataset dataset =
      makeDataset(places,
                  {[](const Vector3d& x) { return x[0] * x[1]; },
                   [](const Vector3d& x) { return x[1] * x[1] - x[2]; },
                   [](const Vector3d& x) { return x[0] + x[2] * x[2]; }});
  const std::pair<const char*, Function> cases[] = {
      {"div(f)", [](const Vector3d& x) { return 3.0 * x[1] + 2.0 * x[2]; }},
      {"curl(f)[0]", [](const Vector3d&) { return 1.0; }},
      {"curl(f)[1]", [](const Vector3d&) { return -1.0; }},
      {"curl(f)[2]", [](const Vector3d& x) { return -x[0]; }},
      {"|curl(f)|", [](const Vector3d& x) { return std::sqrt(2.0 + x[0] * x[0]); }},
      // minus half the sum of the squared diagonal and twice the products across it
      {"Q(f)",
       [](const Vector3d& x) {
         return -0.5 * (5.0 * x[1] * x[1] + 4.0 * x[2] * x[2]);
       }},
      {"div(curl(f))", [](const Vector3d&) { return 0.0; }},
      {"div(f0,f1,0)", [](const Vector3d& x) { return 3.0 * x[1]; }},
      {"laplacian(f1)", [](const Vector3d&) { return 2.0; }}};
  Dataset named = dataset;
  for (auto& field : named.cloud.fields)
    if (field.name[0] == 'f')
      field.name = "f_" + field.name.substr(1);
  for (const auto& [expression, truth] : cases) {
    const bool is_list = std::string(expression).find(',') != std::string::npos ||
                         std::string(expression) == "laplacian(f1)";
    EXPECT_LT(deviation(is_list ? dataset : named, places, expression, truth), 1e-6)
        << expression;
  }
}

TEST(DerivativesOfFields, VortexCriteriaOfARotation)
{
  const Dataset dataset = makeDataset(places,
                                      {[](const Vector3d& x) { return -3.0 * x[1]; },
                                       [](const Vector3d& x) { return 3.0 * x[0]; },
                                       [](const Vector3d& x) { return 2.0 * x[2]; }});
  EXPECT_LT(deviation(dataset,
                      places,
                      "Q(f0,f1,f2)",
                      [](const Vector3d&) { return 7.0; }), // -0.5 (-9 - 9 + 4)
            1e-8);
  EXPECT_LT(deviation(dataset,
                      places,
                      "lambda2(f0,f1,f2)",
                      [](const Vector3d&) { return -9.0; }), // of -9, -9, 4
            1e-8);
}

TEST(DerivativesOfFields, CurvatureOfSpheresAndSaddles)
{
  const Dataset dataset =
      makeDataset(places,
                  {[](const Vector3d& x) { return x.squaredNorm(); },
                   [](const Vector3d& x) {
                     return x[0] * x[0] + 4.0 * x[0] + 0.5 * x[0] * x[1] - x[1] * x[2];
                   }});
  const auto curvatures = derive(dataset, "curvature(f0)");
  for (std::size_t i = 0; i < places.size(); ++i) {
    const double radius = vectorOf(places[i]).norm();
    EXPECT_NEAR(radius * curvatures[i], 1.0, 1e-5 / radius);
  }
  EXPECT_LT(deviation(dataset,
                      places,
                      "curvature(f1)",
                      [](const Vector3d& x) {
                        const Vector3d g(
                            2.0 * x[0] + 4.0 + 0.5 * x[1], 0.5 * x[0] - x[2], -x[1]);
                        const double along =
                            (2.0 * g[0] * g[0] + g[0] * g[1] - 2.0 * g[1] * g[2]) /
                            g.squaredNorm();
                        return (2.0 - along) / (2.0 * g.norm());
                      }),
            1e-6);
}

TEST(DerivativesOfFields, ConvergeOnFlows)
{
  for (const Flow& flow : makeFlows()) {
    const double distance = 3.0 * spacingOf(flow, 5000);
    const FlowErrors coarse = measureDerivatives(flow, 5000, 1, distance);
    const FlowErrors fine = measureDerivatives(flow, 40000, 2, distance);
    const auto order = [](double a, double b) { return std::log2(a / b); };
    EXPECT_GE(order(coarse.gradient, fine.gradient), 2.5) << flow.name;
    EXPECT_GE(order(coarse.curl, fine.curl), 2.5) << flow.name;
    EXPECT_GE(order(coarse.q, fine.q), 2.5) << flow.name;
    EXPECT_GE(order(coarse.lambda2, fine.lambda2), 2.5) << flow.name;
    EXPECT_LT(fine.gradient, 0.02) << flow.name;
  }
}

TEST(DerivativesOfFields, ThreadsAndOrderDoNotMatter)
{
  const Flow flow = makeFlows()[1];
  const Dataset dataset = sampleFlow(flow, 3000, 7);
  const auto values = derive(dataset, "Q(v)", 1);
  EXPECT_EQ(values, derive(dataset, "Q(v)", 7));
  Dataset reversed = dataset;
  const std::size_t step = dataset.cloud.point_step;
  for (std::size_t i = 0; i < dataset.cloud.width; ++i)
    std::copy_n(&dataset.cloud.data[i * step],
                step,
                &reversed.cloud.data[(dataset.cloud.width - 1 - i) * step]);
  auto mirrored = derive(reversed, "Q(v)");
  std::reverse(mirrored.begin(), mirrored.end());
  EXPECT_EQ(values, mirrored);
}

TEST(DerivativesOfFields, FollowTheUnits)
{
  const auto at = [](double length, double value) {
    Places scaled = places;
    for (auto& place : scaled)
      for (double& x : place)
        x *= length;
    return makeDataset(scaled, {[&](const Vector3d& x) {
                         const Vector3d u = x / length;
                         return value * (std::sin(u[0]) + u[1] * u[2]);
                       }});
  };
  const auto slope = derive(at(1.0, 1.0), "|grad(f0)|");
  const auto bend = derive(at(1.0, 1.0), "laplacian(f0)");
  const double length = std::ldexp(1.0, 30), value = std::ldexp(1.0, -50);
  const auto far_slope = derive(at(length, value), "|grad(f0)|");
  const auto far_bend = derive(at(length, value), "laplacian(f0)");
  for (std::size_t i = 0; i < places.size(); ++i) {
    EXPECT_EQ(slope[i], far_slope[i] * length / value);
    EXPECT_EQ(bend[i], far_bend[i] * length * length / value);
  }
}

TEST(DerivativesOfFields, PlanesAndLayers)
{
  // On a plane nothing is known across it. Two uneven layers hardly tell a cubic, whose
  // slope would be beyond 150: it is held within what the values can be.
  Places flat = places, layers = places;
  for (auto& place : flat)
    place[2] = 0.25;
  for (std::size_t i = 0; i < layers.size(); ++i)
    layers[i][2] = 0.1 * static_cast<double>(i % 2) + 1e-4 * static_cast<double>(i % 5);
  const Function f = [](const Vector3d& x) {
    return x[0] * x[0] + x[1] + 3.0 * x[2] + 0.05 * std::sin(20.0 * x[0]);
  };
  const Dataset on_plane = makeDataset(flat, {f});
  EXPECT_LT(
      deviation(on_plane, flat, "grad(f0)[2]", [](const Vector3d&) { return 0.0; }),
      1e-9);
  EXPECT_LT(deviation(makeDataset(layers, {f}),
                      layers,
                      "grad(f0)[2]",
                      [](const Vector3d&) { return 3.0; }),
            30.0);
  Report report;
  Dataset warned = on_plane;
  addDerivedField(warned, "|grad(f0)|", {}, report);
  ASSERT_EQ(report.warnings.size(), 1u);
  EXPECT_EQ(report.warnings[0].code, "reduced_derivatives");
}

/** Nodes of layers at a curved wall: the first is 1e-3 thick, each next one 1.25 times
 * as thick, and nodes along the wall are 0.1 apart. */
Places
layersAtWall()
{
  Places nodes;
  for (int i = 0; i < 20; ++i)
    for (int j = 0; j < 20; ++j)
      for (int k = 0; k < 24; ++k) {
        const double angle = 0.1 * i, radius = 1.0 + 4e-3 * (std::pow(1.25, k) - 1.0);
        nodes.push_back({radius * std::cos(angle), radius * std::sin(angle), 0.1 * j});
      }
  return nodes;
}

TEST(DerivativesOfFields, LayersAtAWallHaveTheirDerivatives)
{
  const Places nodes = layersAtWall();
  const Function f = [](const Vector3d& x) {
    return 50.0 * (std::hypot(x[0], x[1]) - 1.0) + std::sin(x[2]) + x[0];
  };
  const auto slope = [](const Vector3d& x) {
    const double radius = std::hypot(x[0], x[1]);
    return Vector3d(50.0 * x[0] / radius + 1.0, 50.0 * x[1] / radius, std::cos(x[2]));
  };
  const Dataset dataset = makeDataset(nodes, {f});
  std::array<std::vector<double>, 3> found;
  for (std::size_t axis = 0; axis < 3; ++axis)
    found[axis] = derive(dataset, "grad(f0)[" + std::to_string(axis) + "]");
  std::size_t unknown = 0, wrong = 0, wild = 0;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const Vector3d gradient(found[0][i], found[1][i], found[2][i]);
    const Vector3d truth = slope(vectorOf(nodes[i]));
    unknown += !gradient.allFinite();
    wrong += (gradient - truth).norm() > 0.1 * truth.norm();
    wild += gradient.norm() > 10.0 * truth.norm();
  }
  EXPECT_EQ(0u, wild);
  EXPECT_LT(unknown, nodes.size() / 20);
  EXPECT_LT(wrong, nodes.size() / 5);
}

TEST(DerivativesOfFields, MissingValuesAndDuplicates)
{
  Places twice = places;
  twice.push_back(places[3]);
  Dataset dataset = makeDataset(twice, {cubic});
  std::vector<double> values = derive(dataset, "f0*1");
  values[10] = std::nan("");
  values[3] += 0.5; // the median of two is their mean
  values.back() -= 0.5;
  setField(dataset, "g", values);
  const auto slope = derive(dataset, "|grad(g)|");
  EXPECT_TRUE(std::isnan(slope[10]));
  EXPECT_EQ(std::count_if(slope.begin(), slope.end(), [](double s) { return s != s; }),
            1);
  EXPECT_EQ(slope[3], slope.back());
  EXPECT_NEAR(slope[3], cubicGradient(vectorOf(places[3])).norm(), 1e-8);
}

/** A wave that repeats in the unit box, with its slope along x. @{ */
const double k = 2.0 * std::acos(-1.0);

double
wave(const Vector3d& x)
{
  return std::sin(k * x[0]) + std::cos(k * x[1]) * std::sin(k * x[2]);
}

double
waveSlope(const Vector3d& x)
{
  return k * std::cos(k * x[0]);
}
/** @} */

constexpr std::array<double, 3> unit_box{{1.0, 1.0, 1.0}};

/** In the unit box, but for some that have left it. */
Places
placesAboutBox()
{
  Places about = randomPlaces(3000, 11);
  for (std::size_t i = 0; i < about.size(); i += 50)
    about[i][i % 3] += i % 4 == 0 ? 1.0 : -1.0;
  return about;
}

TEST(DerivativesOfFields, BoxesThatRepeatHaveNoEnds)
{
  const Places about = placesAboutBox();
  Dataset dataset = makeDataset(about, {wave});
  dataset.origin = {{0.0, 4.0, -2.0}};
  const auto error = [&](const std::string& expression,
                         const std::array<double, 3>& box,
                         const Function& truth) {
    const auto values = derive(dataset, expression, 0, box);
    double largest = 0.0;
    for (std::size_t i = 0; i < about.size(); ++i)
      largest = std::max(largest, std::abs(values[i] - truth(vectorOf(about[i]))));
    return largest;
  };
  EXPECT_GT(error("grad(f0)[0]", {}, waveSlope), 0.5);
  EXPECT_LT(error("grad(f0)[0]", unit_box, waveSlope), 0.15);
  // Derivatives of derivatives know no more of faces than those.
  const Function bend = [](const Vector3d& x) { return -k * k * std::sin(k * x[0]); };
  EXPECT_LT(error("grad(grad(f0)[0])[0]", unit_box, bend), 3.0);
}

TEST(DerivativesOfFields, CoordinatesInBoxesAreThoseOfTheSamples)
{
  const Places about = placesAboutBox();
  Dataset dataset = makeDataset(about, {wave});
  dataset.origin = {{0.0, 4.0, -2.0}};
  for (const std::string axis : {"x", "y", "z", "|x,y|"})
    EXPECT_EQ(derive(dataset, axis + "+0"),
              derive(dataset, axis + "+0*|grad(f0)|", 0, unit_box));
  const Dataset inside = makeDataset(places, {wave}); // from -1 to 1
  for (const double slope :
       derive(inside, "grad(x)[0]-grad(z+2*y)[1]", 0, {{2.0, 2.0, 2.0}}))
    EXPECT_NEAR(-1.0, slope, 1e-5);
  const auto sums =
      derive(inside, "grad(x*f0)[0]-x*grad(f0)[0]-f0", 0, {{2.0, 2.0, 2.0}});
  for (const double none : sums)
    EXPECT_NEAR(0.0, none, 1.5);
}

TEST(DerivativesOfFields, ImagesAreNotUndefinedOnceMore)
{
  Dataset dataset = makeDataset(placesAboutBox(), {wave});
  Report report;
  addDerivedField(dataset, "|grad(f0*1)|/0", {0, "", unit_box}, report);
  ASSERT_EQ(report.warnings.size(), 1u);
  EXPECT_EQ(report.warnings[0].code, "undefined_field");
  EXPECT_EQ(numberOf(report.warnings[0], "undefined"), 3000.0);
  EXPECT_EQ(numberOf(report.warnings[0], "points"), 3000.0);
  addDerivedField(dataset, "|grad(ln(f0))|", {0, "", unit_box}, report);
  const auto values = derive(dataset, "f0*1");
  const auto negative =
      std::count_if(values.begin(), values.end(), [](double f) { return f < 0.0; });
  EXPECT_EQ(report.warnings.back().code, "undefined_field");
  EXPECT_EQ(numberOf(report.warnings.back(), "undefined"),
            static_cast<double>(negative));
  EXPECT_EQ(numberOf(report.warnings.back(), "points"), 3000.0);
  EXPECT_THROW(derive(dataset, "|grad(f0)|", 0, {{-1.0, 0.0, 0.0}}), InvalidArgument);
}

TEST(DerivativesOfFields, TooFewSamples)
{
  for (std::size_t n = 1; n < 4; ++n) {
    Dataset dataset = makeDataset(randomPlaces(n, 1), {cubic});
    EXPECT_THROW(derive(dataset, "|grad(f0)|"), InvalidArgument) << n;
  }
  const Places four = randomPlaces(4, 1);
  EXPECT_LT(deviation(makeDataset(four, {[](const Vector3d& x) { return x[0]; }}),
                      four,
                      "|grad(f0)|",
                      [](const Vector3d&) { return 1.0; }),
            1e-4);
}

} // namespace test_derivatives_of_fields
