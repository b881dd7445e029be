// SPDX-License-Identifier: BSD-3-Clause
#include "interpolation/outer_layer.h"

#include "common/numbers.h"
#include "common/parallel.h"
#include "common/printable.h"
#include "common/records.h"
#include "neighbors/nearest_finder.h"
#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/common/exceptions.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <sstream>

namespace pcl_uvol {
namespace {

constexpr std::size_t layer_block = 1024;
/** Neighbours that tell how far out the layer lies. */
constexpr std::size_t spacing_neighbors = 12;
/** Neighbours that tell how much must be empty: of random samples a ball that holds
 * that many on the average is empty once in 10^7 times. */
constexpr std::size_t empty_neighbors = 24;
/** Share of the distance to the place around which it must be empty. */
constexpr float empty_part = 0.9f;

/** A sample to be added. */
struct Outer {
  Position position; ///< as the samples are kept
  std::uint32_t beside;
};

std::vector<Position>
listDirections()
{
  std::vector<Position> directions;
  for (int i = 0; i < 27; ++i) {
    const std::array<int, 3> step{{i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1}};
    const float length = std::sqrt(
        static_cast<float>(step[0] * step[0] + step[1] * step[1] + step[2] * step[2]));
    if (length > 0.0f)
      directions.push_back({{static_cast<float>(step[0]) / length,
                             static_cast<float>(step[1]) / length,
                             static_cast<float>(step[2]) / length}});
  }
  return directions;
}

std::vector<Outer>
findOuter(const SampleSet& samples, unsigned threads, Report& report)
{
  StepTimer step(report, "outer_layer", samples.size());
  const std::vector<Position> directions = listDirections();
  return parallelGather<Outer>(
      samples.size(),
      layer_block,
      threads,
      [&](std::size_t begin, std::size_t end, std::vector<Outer>& found) {
        NearestFinder around(samples, empty_neighbors + 1), nearest(samples, 1);
        float reach = 1.0f;
        std::vector<float> sq_dists;
        for (std::size_t i = begin; i < end; ++i) {
          const Position& center = samples.getPositions()[i];
          const auto near = around.find(center, reach);
          sq_dists.assign(near.sq_dists, near.sq_dists + near.size);
          std::sort(sq_dists.begin(), sq_dists.end());
          const float spacing = std::sqrt(sq_dists[spacing_neighbors]);
          reach = std::sqrt(sq_dists.back());
          for (const Position& direction : directions) {
            Outer outer{center, static_cast<std::uint32_t>(i)};
            Position far = center;
            for (int axis = 0; axis < 3; ++axis) {
              outer.position[axis] += spacing * direction[axis];
              far[axis] += reach * direction[axis];
            }
            const float limit = empty_part * reach;
            if (nearest.find(far, reach).sq_dists[0] >= limit * limit)
              found.push_back(outer);
          }
        }
        step.advance(end - begin);
      });
}

} // namespace

void
addOuterLayer(Dataset& dataset,
              const pcl::Indices* use,
              const std::string& field,
              double value,
              unsigned threads,
              Report& report)
{
  const auto* const stored = findField(dataset.cloud.fields, field);
  if (!stored || stored->count > 1)
    throw InvalidArgument("no_field_for_value_outside",
                          {{"field", shortenText(field)},
                           {"fields", describeFields(dataset.cloud.fields)}});
  std::ostringstream text;
  text.precision(17);
  text << value;
  std::array<std::uint8_t, 8> number{};
  if (!parseNumber(text.str(), stored->datatype, number.data()))
    throw InvalidArgument("value_outside_not_held",
                          {{"field", shortenText(field)}, {"value", value}});
  const CloudView cloud = viewOf(dataset.cloud);
  std::vector<std::uint32_t> counting(cloud.count);
  std::iota(counting.begin(), counting.end(), 0u);
  if (use)
    counting.assign(use->begin(), use->end());
  Report own; // the samples are counted by whoever uses them
  own.progress = report.progress;
  const auto samples = SampleSet::build(cloud.xyz(0),
                                        cloud.stride(),
                                        counting,
                                        Position{{1.0f, 1.0f, 1.0f}},
                                        threads,
                                        own);
  if (samples->size() <= empty_neighbors)
    throw InvalidArgument("few_samples_for_value_outside",
                          {{"samples", empty_neighbors}});
  const std::vector<Outer> outer = findOuter(*samples, threads, report);
  const std::size_t step = dataset.cloud.point_step, before = dataset.cloud.width;
  checkSize(before + outer.size(), step);
  const pcl::PCLPointField layout = *stored;
  resizePoints(dataset.cloud, before + outer.size());
  std::uint8_t* to = dataset.cloud.data.data() + before * step;
  for (const Outer& added : outer) {
    const std::uint8_t* const from =
        dataset.cloud.data.data() + samples->getInputIndex(added.beside) * step;
    std::copy_n(from, step, to);
    for (std::size_t axis = 0; axis < 3; ++axis)
      putCoordinate(static_cast<double>(added.position[static_cast<int>(axis)]) /
                        static_cast<double>(samples->getUnit().factor),
                    axis,
                    to);
    std::copy_n(number.data(), datatypeSize(layout.datatype), to + layout.offset);
    to += step;
  }
  report.count("outer_samples", outer.size());
}

} // namespace pcl_uvol
