// SPDX-License-Identifier: BSD-3-Clause
// The formulas of the analytic fields.
#include "generation/analytic_fields.h"

#include "common/random.h"
#include <pcl_uvol/common/exceptions.h>

#include <cmath>

namespace pcl_uvol {

namespace {

using Position = std::array<double, 3>;

constexpr double pi = 3.141592653589793;

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
  throw InvalidArgument("There is no analytic field '" + name + "'; there are " +
                        names + ".");
}

std::uint64_t
scatterCount(Scatter scatter, std::uint64_t n)
{
  if (scatter == Scatter::Uniform || scatter == Scatter::Clustered)
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
