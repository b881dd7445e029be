// SPDX-License-Identifier: BSD-3-Clause
// The formulas of the analytic fields.
#include "generation/analytic_fields.h"

#include "common/constants.h"
#include "common/printable.h"
#include "common/random.h"
#include <pcl_uvol/common/exceptions.h>

#include <algorithm>
#include <cmath>

namespace pcl_uvol {

namespace {

using Position = std::array<double, 3>;

double
radius(const Position& p)
{
  return std::hypot(p[0], p[1], p[2]);
}

double
sphere(const Position& p)
{
  return 1.0 - radius(p);
}

double
torus(const Position& p)
{
  return 0.25 - std::hypot(std::hypot(p[0], p[1]) - 0.65, p[2]);
}

double
gyroid(const Position& p)
{
  return std::sin(p[0]) * std::cos(p[1]) + std::sin(p[1]) * std::cos(p[2]) +
         std::sin(p[2]) * std::cos(p[0]);
}

double
marschnerLobb(const Position& p)
{
  constexpr double alpha = 0.25, frequency = 6.0;
  const double rho =
      std::cos(2 * pi * frequency * std::cos(pi * std::hypot(p[0], p[1]) / 2));
  return (1.0 - std::sin(pi * p[2] / 2) + alpha * (1.0 + rho)) / (2 * (1.0 + alpha));
}

/** Electron density of the orbital 3d_z2 in 1e-4 per cubic Bohr radius. */
double
hydrogen(const Position& p)
{
  const double r = radius(p);
  const double norm = 81.0 * std::sqrt(6 * pi);
  const double amplitude = (3 * p[2] * p[2] - r * r) * std::exp(-r / 3) / norm;
  return 1e4 * amplitude * amplitude;
}

/** A dense core and two thin arms wound around it, over four powers of ten. */
double
star(const Position& p)
{
  const double r = std::hypot(p[0], p[1]);
  const double winding = std::atan2(p[1], p[0]) - 1.2 * r;
  const double core = std::exp(-6 * radius(p));
  const double flat = std::exp(-20 * p[2] * p[2] / (0.05 + 0.2 * r));
  return core + 0.05 * std::exp(-2 * r) * std::pow(std::cos(winding), 8) * flat;
}

/** Cells per axis of the largest lattice of no more than n. */
std::uint64_t
latticeSide(std::uint64_t n)
{
  auto side = static_cast<std::uint64_t>(std::cbrt(static_cast<double>(n)));
  while ((side + 1) * (side + 1) * (side + 1) <= n)
    ++side; // the root of a cube number may come out a little too small
  return side;
}

Position
clusteredAt(std::uint64_t seed, std::uint64_t index, double lower, double upper)
{
  const double r = 0.5 * (upper - lower) * uniformAt(seed, index, 0);
  const double z = 2 * uniformAt(seed, index, 1) - 1.0;
  const double angle = 2 * pi * uniformAt(seed, index, 2);
  const double flat = std::sqrt(1.0 - z * z) * r;
  const double center = 0.5 * (lower + upper);
  return {{center + flat * std::cos(angle),
           center + flat * std::sin(angle),
           center + r * z}};
}

/** How many samples lie on each line across a cube: with m on each of n / m lines,
 * which make a square, these lie sqrt(m^3 / n) times as far apart as the samples on
 * them. */
std::uint64_t
samplesPerLine(Scatter scatter, std::uint64_t n)
{
  const double across_by_along = scatter == Scatter::Holes ? 25.0 : 10.0;
  const double count =
      std::cbrt(across_by_along * across_by_along * static_cast<double>(n));
  return std::clamp<std::uint64_t>(std::llround(count), 1, n);
}

/** A place on a line, in the unit cube. */
Position
onLineAt(Scatter scatter, std::uint64_t seed, std::uint64_t index, std::uint64_t n)
{
  constexpr double margin = 0.1;  // of a line's cell, at each side
  constexpr double meander = 0.2; // in parts of the cell
  constexpr double drift = 0.5;   // of a hole sideways, at most: 60 degrees steep
  const std::uint64_t length = samplesPerLine(scatter, n), line = index / length;
  const auto side = static_cast<std::uint64_t>(std::ceil(
      std::sqrt(std::ceil(static_cast<double>(n) / static_cast<double>(length)))));
  const auto random = [&](std::size_t which) {
    return uniformAt(seed, line, 11 + which);
  };
  const double along =
      (static_cast<double>(index % length) + 0.5) / static_cast<double>(length);
  double place[2];
  for (std::size_t i = 0; i < 2; ++i) {
    const auto cell = static_cast<double>(i == 0 ? line % side : line / side);
    const double jitter = margin + (1.0 - 2.0 * margin) * random(i);
    double within = scatter == Scatter::Tracks ? 0.5 : jitter;
    if (scatter == Scatter::Tracks)
      within += meander *
                std::sin(2 * pi * ((1.0 + 2.0 * random(2 + i)) * along + random(i)));
    place[i] = (cell + within) / static_cast<double>(side);
    if (scatter == Scatter::Holes) {
      const double end =
          std::clamp(place[i] + drift * (2.0 * random(4 + i) - 1.0), 0.0, 1.0);
      place[i] += along * (end - place[i]);
    }
  }
  if (scatter == Scatter::Tracks)
    return {{along, place[0], place[1]}};
  return {{place[0], place[1], 1.0 - along}};
}

} // namespace

const std::vector<AnalyticField>&
analyticFields()
{
  static const std::vector<AnalyticField> fields = {
      {"radial", -80, 80, radius, {46}, "distance to the centre (thesis Table 2.9)"},
      {"sphere", -1.2, 1.2, sphere, {0}, "1 - distance to the centre"},
      {"torus", -1, 1, torus, {0}, "radii 0.65 and 0.25"},
      {"gyroid", -2 * pi, 2 * pi, gyroid, {0, 0.8}, "two periods per axis"},
      {"marschner_lobb", -1, 1, marschnerLobb, {0.5}, "Marschner and Lobb 1994"},
      {"hydrogen", -20, 20, hydrogen, {0.05, 0.3}, "3d orbital of hydrogen"},
      {"star", -2, 2, star, {0.001, 0.01, 0.1}, "tidally torn star"}};
  return fields;
}

const AnalyticField&
findAnalyticField(const std::string& name)
{
  std::string names;
  for (const AnalyticField& field : analyticFields()) {
    if (name == field.name)
      return field;
    names += (names.empty() ? "" : ", ") + std::string(field.name);
  }
  throw InvalidArgument("unknown_analytic_field",
                        {{"field", shortenText(name)}, {"fields", names}});
}

bool
isOnLines(Scatter scatter)
{
  return scatter == Scatter::Tracks || scatter == Scatter::Casts ||
         scatter == Scatter::Holes;
}

std::uint64_t
lineOf(Scatter scatter, std::uint64_t index, std::uint64_t n)
{
  return index / samplesPerLine(scatter, n);
}

std::uint64_t
scatterCount(Scatter scatter, std::uint64_t n)
{
  if (scatter != Scatter::Jittered && scatter != Scatter::Lattice)
    return n;
  const std::uint64_t side = latticeSide(n);
  return side * side * side;
}

std::array<double, 3>
scatterAt(Scatter scatter,
          std::uint64_t seed,
          std::uint64_t index,
          std::uint64_t n,
          double lower,
          double upper)
{
  if (scatter == Scatter::Clustered)
    return clusteredAt(seed, index, lower, upper);
  if (isOnLines(scatter)) {
    Position place = onLineAt(scatter, seed, index, n);
    for (double& coordinate : place)
      coordinate = lower + coordinate * (upper - lower);
    return place;
  }
  Position position;
  const std::uint64_t side = scatter == Scatter::Uniform ? 1 : latticeSide(n);
  const std::uint64_t cell[3] = {
      index % side, index / side % side, index / side / side};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double first =
        scatter == Scatter::Uniform ? 0.0 : static_cast<double>(cell[axis]);
    const double within =
        scatter == Scatter::Lattice ? 0.5 : uniformAt(seed, index, axis);
    position[axis] =
        lower + (first + within) * (upper - lower) / static_cast<double>(side);
  }
  return position;
}

} // namespace pcl_uvol
