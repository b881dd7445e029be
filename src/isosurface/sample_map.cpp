// SPDX-License-Identifier: BSD-3-Clause
#include "common/parameter_json.h"
#include <pcl_uvol/isosurface/sample_map.h>

#include <array>
#include <cmath>

namespace pcl_uvol {

std::string
SampleMapParameters::toJson() const
{
  return writeJson(*this);
}

SampleMapParameters
SampleMapParameters::fromJson(const std::string& text)
{
  return readJson<SampleMapParameters>(text);
}

void
checkParameters(const SampleMapParameters& parameters)
{
  if (parameters.window < 0.0)
    throw InvalidArgument("map_window_negative", {});
  if (parameters.most_samples == 0)
    throw InvalidArgument("map_without_room", {});
  if (!(parameters.cube >= 0.0) || !std::isfinite(parameters.cube))
    throw InvalidArgument("map_cube_not_allowed", {});
}

namespace detail {

namespace {

/** Room for samples that come next, so that not all of them are followed by thinning.
 */
constexpr double kept_part = 0.75;

/** Twice the volume, about. */
constexpr double growth = 1.26;

struct CubeEntry {
  std::array<double, 3> cube; ///< whole numbers
  std::uint32_t sample;

  bool
  operator<(const CubeEntry& other) const
  {
    return cube != other.cube ? cube < other.cube : sample < other.sample;
  }
};

/** The newest sample of each cube, in any order. */
std::vector<std::uint32_t>
findNewest(const CloudView& cloud,
           const std::vector<std::uint32_t>& samples,
           double side)
{
  std::vector<CubeEntry> entries;
  entries.reserve(samples.size());
  for (const std::uint32_t sample : samples) {
    CubeEntry entry{{}, sample};
    for (std::size_t axis = 0; axis < 3; ++axis)
      entry.cube[axis] =
          std::floor(static_cast<double>(cloud.xyz(sample)[axis]) / side);
    entries.push_back(entry);
  }
  std::sort(entries.begin(), entries.end());
  std::vector<std::uint32_t> newest;
  for (std::size_t i = 0; i < entries.size(); ++i)
    if (i + 1 == entries.size() || entries[i].cube != entries[i + 1].cube)
      newest.push_back(entries[i].sample);
  return newest;
}

/** The side of so many cubes in the box of samples; of a flat box those in its plane.
 */
double
chooseSide(const CloudView& cloud,
           const std::vector<std::uint32_t>& samples,
           double cubes)
{
  double volume = 1.0;
  int dimensions = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const std::uint32_t sample : samples) {
      low = std::min(low, static_cast<double>(cloud.xyz(sample)[axis]));
      high = std::max(high, static_cast<double>(cloud.xyz(sample)[axis]));
    }
    if (high > low) {
      volume *= high - low;
      ++dimensions;
    }
  }
  return dimensions == 0 ? 1.0 : std::pow(volume / cubes, 1.0 / dimensions);
}

} // namespace

std::vector<std::uint32_t>
thinByCubes(const CloudView& cloud, std::size_t most, double cube)
{
  std::vector<std::uint32_t> samples;
  for (std::size_t i = 0; i < cloud.count; ++i)
    if (std::isfinite(cloud.xyz(i)[0]) && std::isfinite(cloud.xyz(i)[1]) &&
        std::isfinite(cloud.xyz(i)[2]))
      samples.push_back(static_cast<std::uint32_t>(i));
  const auto room = std::max<std::size_t>(
      static_cast<std::size_t>(kept_part * static_cast<double>(most)), 1);
  double side =
      cube > 0.0 ? cube : chooseSide(cloud, samples, static_cast<double>(room));
  for (bool is_first = true; is_first || samples.size() > room; is_first = false) {
    samples = findNewest(cloud, samples, side);
    side *= growth;
  }
  std::sort(samples.begin(), samples.end());
  return samples;
}

} // namespace detail
} // namespace pcl_uvol
