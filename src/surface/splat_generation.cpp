// SPDX-License-Identifier: BSD-3-Clause
#include "common/memory.h"
#include "common/parallel.h"
#include "common/parameter_json.h"
#include "common/random.h"
#include "surface/footprints.h"
#include "surface/memory_need.h"
#include "surface/splat_growth.h"
#include "surface/splat_input.h"
#include "surface/usual_extent.h"
#include <pcl_uvol/surface/splat_generation.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <numeric>

namespace pcl_uvol {

namespace {

constexpr std::size_t splat_block = 1u << 12;

/** Splats that are grown at once: so few that hardly one of them is passed over for the
 * sake of another one, in parts of those that stand already. */
constexpr std::size_t fewest_at_once = 32, at_once_part = 4;
/** Blocks that these are divided into, and splats of a block at most. */
constexpr std::size_t blocks_at_once = 16, largest_block = 256;
/** Splats of a block whose neighbours are looked up in common. */
constexpr std::size_t run_splats = 16;

/** Extents, in the samples' unit, whose squares, and those of the spacings, are numbers
 * in float. */
constexpr double smallest_extent = 1e-12, largest_extent = 1e15;

void
checkParameters(const SplatParameters& parameters)
{
  if (!(parameters.delta > 0.0) || !std::isfinite(parameters.delta))
    throw InvalidArgument("splat_delta_not_positive", {{"delta", parameters.delta}});
  if (!(parameters.lambda >= 0.0 && parameters.lambda <= 1.0))
    throw InvalidArgument("splat_lambda_out_of_range", {{"lambda", parameters.lambda}});
}

/** Footprints; where a point has none, which is at corners, on lines and far off, half
 * the way to the next point, but no more than is usual.
 * \param largest_alone of those that are farther off than that, at most */
std::vector<float>
leastRadii(const SampleSet& samples,
           std::vector<float> footprints,
           double delta,
           float largest_alone,
           unsigned threads)
{
  std::vector<float> known;
  std::copy_if(footprints.begin(),
               footprints.end(),
               std::back_inserter(known),
               [](float radius) { return radius > 0.0f; });
  if (known.size() == footprints.size())
    return footprints;
  float usual = std::numeric_limits<float>::infinity();
  if (!known.empty()) {
    const auto middle = known.begin() + static_cast<std::ptrdiff_t>(known.size() / 2);
    std::nth_element(known.begin(), middle, known.end());
    usual = *middle;
  }
  parallelBlocks(footprints.size(), splat_block, threads, [&](auto begin, auto end) {
    NearestFinder finder(samples, 2);
    for (std::size_t i = begin; i < end; ++i) {
      if (footprints[i] > 0.0f)
        continue;
      const auto row = finder.find(
          samples.getPositions()[i],
          std::max(static_cast<float>(delta), std::numeric_limits<float>::min()));
      float nearest = std::numeric_limits<float>::infinity();
      for (std::size_t j = 0; j < row.size; ++j)
        if (row.samples[j] != i)
          nearest = std::min(nearest, 0.5f * std::sqrt(row.sq_dists[j]));
      if (nearest > usual)
        nearest = std::min(usual, largest_alone);
      footprints[i] = std::isfinite(nearest) ? nearest : static_cast<float>(delta);
    }
  });
  return footprints;
}

/** All samples in an order that is random but always the same. */
std::vector<std::uint32_t>
randomOrder(std::size_t count, unsigned threads)
{
  std::vector<std::uint32_t> order(count);
  std::iota(order.begin(), order.end(), 0u);
  parallelSort(order.begin(), order.end(), threads, [&](auto a, auto b) {
    return mixBits(a) < mixBits(b); // never equal
  });
  return order;
}

/** A splat, the sample it is grown from, and what ends it. */
struct Accepted {
  std::uint32_t sample;
  PackedRim rim;
  PointSplat splat;
};

/** Goes through the samples in their order; those that are not passed over get a splat.
 * Many are grown at once, and some of them for nothing. */
std::deque<Accepted>
coverSurface(const SplatGround& ground, unsigned threads, Report& report)
{
  const std::size_t count = ground.points.samples->size();
  StepTimer step(report, "splats", count);
  const std::vector<std::uint32_t> order = randomOrder(count, threads);
  std::vector<std::uint8_t> passed_over(count, 0);
  std::deque<Accepted> accepted; // a vector grows to three times its size
  std::uint64_t widened = 0;
  std::vector<std::uint32_t> candidates, places;
  std::vector<GrownSplat> grown;
  for (std::size_t next = 0; next < count;) {
    const std::size_t first = next;
    const std::size_t most = std::max(fewest_at_once, accepted.size() / at_once_part);
    candidates.clear();
    for (; next < count && candidates.size() < most; ++next)
      if (!passed_over[order[next]])
        candidates.push_back(order[next]);
    // Neighbours in memory, one after the other.
    places.resize(candidates.size());
    std::iota(places.begin(), places.end(), 0u);
    parallelSort(places.begin(), places.end(), threads, [&](auto a, auto b) {
      return candidates[a] < candidates[b];
    });
    grown.resize(candidates.size());
    const std::size_t block =
        std::clamp<std::size_t>(candidates.size() / blocks_at_once, 1, largest_block);
    parallelBlocks(candidates.size(), block, threads, [&](auto begin, auto end) {
      SplatGrower grower(ground);
      std::vector<std::uint32_t> run;
      for (std::size_t i = begin; i < end; ++i) {
        if ((i - begin) % run_splats == 0) {
          run.clear();
          for (std::size_t j = i; j < std::min(i + run_splats, end); ++j)
            run.push_back(candidates[places[j]]);
          grower.expect(run);
        }
        grown[places[i]] = grower.grow(candidates[places[i]]);
      }
      // Samples that are passed over count with those that are not.
      const std::size_t samples = next - first, all = candidates.size();
      step.advance(samples * end / all - samples * begin / all);
    });
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      if (passed_over[candidates[i]])
        continue;
      accepted.push_back({candidates[i], grown[i].rim, grown[i].splat});
      widened += grown[i].widened ? 1 : 0;
      for (const std::uint32_t sample : grown[i].passed_over)
        passed_over[sample] = 1;
    }
  }
  report.count("splats", accepted.size());
  report.count("widened", widened);
  return accepted;
}

/** What splats are grown over goes with the end of it: most of the memory.
 * \param delta a length */
std::deque<Accepted>
growOn(const OrientedPoints& points,
       double delta,
       float largest_alone,
       const SplatParameters& parameters,
       unsigned threads,
       Report& report)
{
  Footprints footprints = computeFootprints(points, threads, report);
  const SplatGround ground{
      points,
      std::move(footprints.on_rim),
      std::move(footprints.nearest),
      leastRadii(
          *points.samples, std::move(footprints.radii), delta, largest_alone, threads),
      std::move(footprints.rims),
      delta,
      parameters.lambda};
  return coverSurface(ground, threads, report);
}

/** A splat in the unit of the input. */
PointSplat
toInput(PointSplat splat, const LengthUnit& unit)
{
  for (float* const length :
       {&splat.x, &splat.y, &splat.z, &splat.radius, &splat.error})
    *length = static_cast<float>(unit.toInput(*length));
  return splat;
}

} // namespace

Splats
detail::generateSplats(const CloudView& cloud,
                       const std::vector<std::uint32_t>& use,
                       const SplatParameters& parameters,
                       unsigned threads,
                       Report& report)
{
  constexpr float any = std::numeric_limits<float>::infinity();
  return generateSplats(cloud, use, parameters, any, threads, report);
}

Splats
detail::generateSplats(const CloudView& cloud,
                       const std::vector<std::uint32_t>& use,
                       const SplatParameters& parameters,
                       float largest_alone,
                       unsigned threads,
                       Report& report)
{
  checkParameters(parameters);
  if (use.empty())
    throw InvalidArgument("empty_cloud", {{"stage", "The splat generation"}});
  checkMemoryOf(
      "Making splats", use.size(), splatsBytes(static_cast<double>(use.size())));
  OrientedPoints points = orientPoints(cloud, use, threads, report);
  points.bridged.clear(); // splats stand for all points
  const LengthUnit& unit = points.samples->getUnit();
  const auto sides = findUsualSides(points.samples->getPositions());
  const double side = *std::max_element(sides.begin(), sides.end());
  const double delta = parameters.delta_is_length ? parameters.delta * unit.factor
                                                  : parameters.delta * side;
  if (!(delta > 0.0))
    throw InvalidArgument("splats_without_extent", {});
  const double extent = std::max(side, delta);
  if (!(extent >= smallest_extent && extent <= largest_extent))
    throw InvalidArgument("splat_delta_beside_coordinates", {});
  const auto accepted = growOn(points,
                               delta,
                               static_cast<float>(largest_alone * unit.factor),
                               parameters,
                               threads,
                               report);
  // In leaf order, where neighbours are close.
  constexpr auto none = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> splat_of(points.samples->size(), none);
  for (std::uint32_t i = 0; i < accepted.size(); ++i)
    splat_of[accepted[i].sample] = i;
  Splats splats;
  splats.two_sided = points.two_sided;
  splats.cloud.reserve(accepted.size());
  const bool has_rims =
      std::any_of(accepted.begin(), accepted.end(), [](const Accepted& grown) {
        return grown.rim != 0;
      });
  for (std::uint32_t sample = 0; sample < splat_of.size(); ++sample) {
    if (splat_of[sample] == none)
      continue;
    const Accepted& grown = accepted[splat_of[sample]];
    const PointSplat splat = toInput(grown.splat, unit);
    if (!(splat.radius > 0.0f) || !std::isfinite(splat.radius)) // in the input's unit
      continue;
    splats.cloud.push_back(splat);
    splats.sources.push_back(points.samples->getInputIndex(sample));
    if (has_rims)
      splats.rims.push_back(grown.rim);
  }
  warnOfBadSplats(accepted.size(), splats, report);
  return splats;
}

std::string
SplatParameters::toJson() const
{
  return writeJson(*this);
}

SplatParameters
SplatParameters::fromJson(const std::string& text)
{
  return readJson<SplatParameters>(text);
}

} // namespace pcl_uvol
