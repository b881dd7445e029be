// SPDX-License-Identifier: BSD-3-Clause
#include "surface/oriented_points.h"

#include "common/parallel.h"
#include "common/scalar_field.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/common/point_types.h>
#include <pcl_uvol/surface/surface_normals.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <set>

namespace pcl_uvol {

namespace {

constexpr std::size_t oriented_block = 1u << 12;

/** Fields that hold the normal, if the cloud has them as numbers. */
std::optional<std::array<ScalarField, 3>>
normalFields(const CloudView& cloud)
{
  for (const char* name : {"normal_x", "normal_y", "normal_z"})
    if (findField(cloud.fields, name) == nullptr)
      return std::nullopt;
  return std::array<ScalarField, 3>{ScalarField(cloud.fields, "normal_x"),
                                    ScalarField(cloud.fields, "normal_y"),
                                    ScalarField(cloud.fields, "normal_z")};
}

/** Normals of all input points, packed. */
struct Normals {
  std::vector<PackedNormal> packed; ///< by input index
  std::vector<std::uint32_t> use;   ///< input points that have one
};

bool
isUsable(const float* normal)
{
  const float sq_length =
      normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2];
  return std::isfinite(sq_length) && sq_length > 0.0f;
}

Normals
readNormals(const CloudView& cloud,
            const std::array<ScalarField, 3>& fields,
            const std::vector<std::uint32_t>& use,
            unsigned threads)
{
  Normals normals;
  normals.packed.resize(cloud.count);
  normals.use = parallelGather<std::uint32_t>(
      use.size(),
      oriented_block,
      threads,
      [&](std::size_t begin, std::size_t end, std::vector<std::uint32_t>& found) {
        for (std::size_t i = begin; i < end; ++i) {
          float normal[3];
          for (std::size_t axis = 0; axis < 3; ++axis)
            normal[axis] = static_cast<float>(fields[axis].read(cloud.point(use[i])));
          if (!isUsable(normal))
            continue;
          normals.packed[use[i]] = packNormal(normal);
          found.push_back(use[i]);
        }
      });
  return normals;
}

Normals
estimateNormals(const CloudView& cloud,
                const std::vector<std::uint32_t>& use,
                unsigned threads,
                Report& report)
{
  const StepTimer timer(report, "normals");
  Report estimation;
  estimation.progress = report.progress;
  SurfaceNormalParameters parameters;
  parameters.view_point = Eigen::Array3d::Zero(); // no side has a meaning here
  const auto estimated = detail::estimateSurfaceNormals(
      cloud, use, parameters, nullptr, threads, estimation);
  report.warn(estimation.warnings);
  Normals normals;
  normals.packed.resize(cloud.count);
  std::uint64_t far_points = 0;
  for (std::size_t i = 0; i < use.size(); ++i) {
    far_points += std::isnan(estimated[i].normal[0]);
    if (!isUsable(estimated[i].normal))
      continue;
    normals.packed[use[i]] = packNormal(estimated[i].normal);
    normals.use.push_back(use[i]);
  }
  if (far_points > 0)
    report.countSamples("far_points", far_points);
  return normals;
}

/** Lengths of edges; a field of that name with other contents does no harm but to
 * footprints that are larger. */
std::vector<float>
readEdgeLengths(const CloudView& cloud, const SampleSet& samples, unsigned threads)
{
  std::vector<float> lengths;
  if (findField(cloud.fields, "edge_length") == nullptr)
    return lengths;
  const ScalarField field(cloud.fields, "edge_length");
  lengths.resize(samples.size());
  parallelBlocks(samples.size(), oriented_block, threads, [&](auto begin, auto end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto length = static_cast<float>(
          field.read(cloud.point(samples.getInputIndex(i))) * samples.getUnit().factor);
      lengths[i] = length > 0.0f ? length : std::numeric_limits<float>::infinity();
    }
  });
  return lengths;
}

/** Numbers of the isovalues; empty for one isovalue or none. A field with as many
 * values as this is no isovalue. */
std::vector<std::uint8_t>
numberSurfaces(const CloudView& cloud, const SampleSet& samples)
{
  constexpr std::size_t most_isovalues = 4096;
  if (findField(cloud.fields, "isovalue") == nullptr)
    return {};
  const ScalarField field(cloud.fields, "isovalue");
  std::set<double> isovalues;
  std::vector<double> values(samples.size());
  for (std::size_t i = 0; i < samples.size(); ++i) {
    values[i] = field.read(cloud.point(samples.getInputIndex(i)));
    if (i > 0 && values[i] == values[i - 1])
      continue;
    if (!std::isfinite(values[i]) || isovalues.size() > most_isovalues)
      return {};
    isovalues.insert(values[i]);
  }
  if (isovalues.size() < 2)
    return {};
  const std::vector<double> sorted(isovalues.begin(), isovalues.end());
  std::vector<std::uint8_t> numbers(samples.size());
  for (std::size_t i = 0; i < samples.size(); ++i)
    numbers[i] = static_cast<std::uint8_t>(
        std::lower_bound(sorted.begin(), sorted.end(), values[i]) - sorted.begin());
  return numbers;
}

bool
isFinite(const float* xyz)
{
  return std::isfinite(xyz[0]) && std::isfinite(xyz[1]) && std::isfinite(xyz[2]);
}

} // namespace

std::vector<std::uint8_t>
findBridged(const CloudView& cloud)
{
  for (const char* const name : {"support", "edge_length"}) // both: an isopoint's
    if (findField(cloud.fields, name) == nullptr)
      return {};
  const ScalarField support(cloud.fields, "support");
  constexpr auto bridged = static_cast<double>(IsoSupport::Bridged);
  std::vector<std::uint8_t> found(cloud.count);
  for (std::size_t i = 0; i < cloud.count; ++i)
    found[i] = support.read(cloud.point(i)) == bridged ? 1 : 0;
  if (std::find(found.begin(), found.end(), 1) == found.end())
    found.clear();
  return found;
}

OrientedPoints
orientPoints(const CloudView& cloud,
             const std::vector<std::uint32_t>& use,
             unsigned threads,
             Report& report)
{
  report.count("points", use.size());
  std::vector<std::uint32_t> finite;
  std::copy_if(use.begin(), use.end(), std::back_inserter(finite), [&](auto i) {
    return isFinite(cloud.xyz(i));
  });
  report.count("non_finite", use.size() - finite.size());
  if (finite.empty())
    throw InvalidArgument("cloud_without_finite_point", {});
  Normals normals;
  if (const auto fields = normalFields(cloud))
    normals = readNormals(cloud, *fields, finite, threads);
  OrientedPoints points;
  points.two_sided = normals.use.empty();
  if (points.two_sided) {
    normals = estimateNormals(cloud, finite, threads, report);
    report.warn("estimated_normals");
  }
  report.count("without_normal", finite.size() - normals.use.size());
  if (normals.use.empty())
    throw InvalidArgument("cloud_without_normal", {});
  points.samples = SampleSet::build(cloud.xyz(0),
                                    cloud.stride(),
                                    normals.use,
                                    Position{{1.0f, 1.0f, 1.0f}},
                                    threads,
                                    report);
  points.normals.resize(points.samples->size());
  for (std::size_t i = 0; i < points.normals.size(); ++i)
    points.normals[i] = normals.packed[points.samples->getInputIndex(i)];
  points.edge_lengths = readEdgeLengths(cloud, *points.samples, threads);
  points.surfaces = numberSurfaces(cloud, *points.samples);
  const std::vector<std::uint8_t> bridged = findBridged(cloud);
  for (std::size_t i = 0; !bridged.empty() && i < points.normals.size(); ++i)
    points.bridged.push_back(bridged[points.samples->getInputIndex(i)]);
  return points;
}

} // namespace pcl_uvol
