// SPDX-License-Identifier: BSD-3-Clause
#include "shared/isosurface_options.h"

#include "shared/scale_option.h"

#include <algorithm>
#include <cmath>

namespace uvol_tools {

namespace {

/** The numbers of lo:hi:n, evenly spaced, or of lo:hi:nlog, of even ratios.
 * \throws UsageError */
std::vector<double>
parseSeries(const std::string& text)
{
  constexpr double most = 10000.0;
  std::string numbers = text;
  const std::string ending = "log";
  const bool is_log =
      numbers.size() > ending.size() &&
      numbers.compare(numbers.size() - ending.size(), ending.size(), ending) == 0;
  if (is_log)
    numbers.resize(numbers.size() - ending.size());
  std::replace(numbers.begin(), numbers.end(), ':', ',');
  const std::vector<double> parts = parseNumbers("iso", numbers, 0);
  if (parts.size() != 3 || parts[2] != std::floor(parts[2]) || parts[2] < 2.0 ||
      parts[2] > most)
    throw UsageError("-iso " + text +
                     " is no series: give the first and the last isovalue and how many "
                     "there are, from 2 to 10000, as in 0.1:0.9:17.");
  if (is_log && !(parts[0] * parts[1] > 0.0))
    throw UsageError("-iso " + text +
                     " is no series: even ratios need numbers of one sign, not 0.");
  std::vector<double> series;
  for (double i = 0.0; i < parts[2]; ++i) {
    const double t = i / (parts[2] - 1.0);
    series.push_back(is_log ? parts[0] * std::pow(parts[1] / parts[0], t)
                            : parts[0] + t * (parts[1] - parts[0]));
  }
  series.back() = parts[1];
  return series;
}

/** Numbers and series joined by commas. \throws UsageError */
std::vector<double>
parseIsovalues(const std::string& text)
{
  std::vector<double> isovalues;
  for (std::size_t start = 0; start <= text.size();) {
    const std::size_t end = std::min(text.find(',', start), text.size());
    const std::string part = text.substr(start, end - start);
    const std::vector<double> more = part.find(':') == std::string::npos
                                         ? parseNumbers("iso", part, 1)
                                         : parseSeries(part);
    isovalues.insert(isovalues.end(), more.begin(), more.end());
    start = end + 1;
  }
  return isovalues;
}

} // namespace

IsosurfaceOptions::IsosurfaceOptions()
{
  parameters.isosurface.field.clear(); // intensity, else the only candidate
}

void
IsosurfaceOptions::declareSamples(Options& options, bool automatic)
{
  options.text("iso",
               "v,...|lo:hi:n[log]",
               isovalues_,
               "isovalues, or a series of them: 0.1:0.9:17, 0.01:1:50log");
  options.text("field",
               "name",
               parameters.isosurface.field,
               "scalar field: density, vel[1], |vel|, |vx,vy,vz|, or an expression: "
               "log10(rho), rho*u, |grad(rho)|, Q(vel) (default: intensity, else the "
               "only candidate)");
  options.text("where",
               "expr",
               where,
               "use only the points for which it holds: \"experiment=1 && T>4\"");
  options.text("scale",
               automatic ? "sx,sy,sz|auto" : "sx,sy,sz",
               scale_,
               std::string("measure distances in a stretched space") +
                   (automatic ? "; auto: equal spread per axis" : ""));
  input_files_.declare(options);
  options.choice("outside",
                 parameters.isosurface.outside,
                 "the side normals point to: where values are lower or higher");
}

void
IsosurfaceOptions::declareMethod(Options& options)
{
  options.choice("criterion",
                 parameters.isosurface.criterion,
                 "angle criterion against kept or against all closer candidates");
  options.choice(
      "interpolation",
      parameters.isosurface.interpolation,
      "isopoints on local polynomial fits, or along the edges; auto: along the "
      "edges where samples lie on lines or leave gaps");
}

void
IsosurfaceOptions::finish()
{
  if (isovalues_.empty())
    throw UsageError(
        "-iso is missing: give one isovalue or several, as in -iso 0.3,0.6.");
  parameters.isosurface.isovalues = parseIsovalues(isovalues_);
  const ScaleOption scale(scale_);
  parameters.automatic_scale = scale.isAutomatic();
  parameters.isosurface.scale = scale.getFactors();
}

pcl_uvol::LoadOptions
IsosurfaceOptions::makeLoadOptions() const
{
  return input_files_.makeLoadOptions();
}

} // namespace uvol_tools
