// SPDX-License-Identifier: BSD-3-Clause
// The formulas of the analytic fields.
#include <pcl_uvol/common/analytic_fields.h>
#include <pcl_uvol/common/exceptions.h>

#include <algorithm>
#include <cmath>

namespace pcl_uvol {

namespace {

constexpr double pi = 3.141592653589793;

AnalyticField
radial(std::size_t samples)
{
  const double side = 160.0 * std::cbrt(static_cast<double>(samples) / 4e6);
  const double c = side / 2;
  const auto value = [c](double x, double y, double z) {
    return std::hypot(x - c, y - c, z - c);
  };
  return {"radial", value, {{{0, 0, 0}}, {{side, side, side}}}, 46.0 / 160.0 * side};
}

double
sphere(double x, double y, double z)
{
  return 1.0 - (x * x + y * y + z * z);
}

double
torus(double x, double y, double z)
{
  return 0.35 - std::hypot(std::hypot(x, y) - 1.0, z);
}

double
gyroid(double x, double y, double z)
{
  return std::sin(x) * std::cos(y) + std::sin(y) * std::cos(z) +
         std::sin(z) * std::cos(x);
}

double
marschnerLobb(double x, double y, double z)
{
  constexpr double alpha = 0.25, f_m = 6.0;
  const double rho = std::cos(2 * pi * f_m * std::cos(pi / 2 * std::hypot(x, y)));
  return (1.0 - std::sin(pi / 2 * z) + alpha * (1.0 + rho)) / (2 * (1.0 + alpha));
}

double
hydrogen(double x, double y, double z)
{
  const double r_sq = x * x + y * y + z * z;
  const double angular = 3 * z * z - r_sq;
  // The maximum lies on the z axis at r = 6: (2 * 36)^2 exp(-4).
  return angular * angular * std::exp(4.0 - 2.0 / 3.0 * std::sqrt(r_sq)) / 5184.0;
}

double
star(double x, double y, double z)
{
  constexpr double core = 0.5;  // Plummer's radius
  constexpr double twist = 2.0; // angle by which the arms turn per factor e of radius
  const double r_sq = x * x + y * y;
  const double plummer = std::pow(1.0 + (r_sq + z * z) / (core * core), -2.5);
  const double r = std::sqrt(r_sq);
  const double angle = twist * std::log1p(r);
  const double cx = r * std::cos(angle), cy = r * std::sin(angle);
  const double width = 0.2 + 0.08 * r;
  const auto arm = [&](double sign) {
    const double dx = x - sign * cx, dy = y - sign * cy;
    return std::exp(-(dx * dx + dy * dy + z * z) / (2 * width * width));
  };
  const double ends = r_sq / (1.0 + r_sq) * std::exp(-r_sq / 32.0);
  return plummer + 0.04 * ends * (arm(1.0) + arm(-1.0));
}

Box
centered(double x, double y, double z)
{
  return {{{-x, -y, -z}}, {{x, y, z}}};
}

} // namespace

const std::vector<std::string>&
analyticFieldNames()
{
  static const std::vector<std::string> names = {
      "radial", "sphere", "torus", "gyroid", "marschner_lobb", "hydrogen", "star"};
  return names;
}

AnalyticField
makeAnalyticField(const std::string& name, std::size_t samples)
{
  static const std::vector<AnalyticField> fixed = {
      {"sphere", sphere, centered(1.5, 1.5, 1.5), 0.0},
      {"torus", torus, centered(1.5, 1.5, 0.6), 0.0},
      {"gyroid", gyroid, centered(2 * pi, 2 * pi, 2 * pi), 0.0},
      {"marschner_lobb", marschnerLobb, centered(1.0, 1.0, 1.0), 0.5},
      {"hydrogen", hydrogen, centered(25.0, 25.0, 25.0), 0.1},
      {"star", star, centered(8.0, 8.0, 3.0), 0.01}};
  if (name == "radial")
    return radial(samples);
  for (const AnalyticField& field : fixed)
    if (field.name == name)
      return field;
  std::string list;
  for (const std::string& known : analyticFieldNames())
    list += (list.empty() ? "" : ", ") + known;
  throw InvalidArgument("There is no analytic field '" + name + "', only " + list +
                        ".");
}

} // namespace pcl_uvol
