// SPDX-License-Identifier: BSD-3-Clause
#include "neighbors/boxed_samples.h"

#include "common/parallel.h"
#include "common/records.h"
#include "neighbors/length_unit.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace pcl_uvol {
namespace {

constexpr std::size_t boxed_block = 1024;

/** A reach that was too short grows to what was seen to be needed, and a little more.
 */
constexpr double more = 1.05;

void
putPlace(const Position& place, std::uint8_t* point)
{
  for (std::size_t axis = 0; axis < 3; ++axis)
    putCoordinate(static_cast<double>(place[static_cast<int>(axis)]), axis, point);
}

} // namespace

BoxedSamples::BoxedSamples(const CloudView& cloud,
                           const std::vector<std::uint32_t>& use,
                           const PeriodicBox& box,
                           const Position& scale)
    : box_(box)
    , scale_(scale)
    , places_(cloud.count)
{
  for (std::size_t i = 0; i < cloud.count; ++i)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto x = static_cast<double>(cloud.xyz(i)[axis]);
      auto place = static_cast<float>(box.toBox(x, axis));
      if (box.sides[axis] > 0.0 && static_cast<double>(place) >= box.sides[axis])
        place = 0.0f; // rounded to the high face, which is the low one
      places_[i][static_cast<int>(axis)] = place;
    }
  std::copy_if(use.begin(), use.end(), std::back_inserter(use_), [&](auto sample) {
    return isFinite(places_[sample]);
  });
}

Position
BoxedSamples::getPlace(const PeriodicImage& image) const
{
  Position place = places_[image.sample];
  for (int axis = 0; axis < 3; ++axis)
    place[axis] = static_cast<float>(static_cast<double>(place[axis]) +
                                     image.shift[static_cast<std::size_t>(axis)] *
                                         box_.sides[static_cast<std::size_t>(axis)]);
  return place;
}

double
BoxedSamples::getSide(std::size_t axis) const
{
  const double side = box_.sides[axis];
  return side > 0.0 ? side * static_cast<double>(scale_[static_cast<int>(axis)])
                    : std::numeric_limits<double>::infinity();
}

double
BoxedSamples::getShortestSide() const
{
  return std::min({getSide(0), getSide(1), getSide(2)});
}

float
BoxedSamples::getDepth(std::uint32_t sample) const
{
  double depth = std::numeric_limits<double>::infinity();
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (box_.sides[axis] > 0.0) {
      const auto place = static_cast<double>(places_[sample][static_cast<int>(axis)]);
      depth = std::min(depth,
                       std::min(place, box_.sides[axis] - place) *
                           static_cast<double>(scale_[static_cast<int>(axis)]));
    }
  return static_cast<float>(depth);
}

SampleSpread
BoxedSamples::measureSpread() const
{
  SampleSpread spread;
  spread.count = use_.size();
  for (const std::uint32_t sample : use_)
    spread.extents.add(places_[sample].x);
  return spread;
}

double
BoxedSamples::getSpacing(const SampleSpread& spread) const
{
  double volume = 1.0;
  int dimensions = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    double length = box_.sides[axis];
    if (!(length > 0.0))
      length = spread.extents.getLength(axis);
    if (!(length > 0.0))
      continue;
    volume *= length * static_cast<double>(scale_[static_cast<int>(axis)]);
    ++dimensions;
  }
  return std::pow(volume /
                      static_cast<double>(std::max<std::uint64_t>(spread.count, 1)),
                  1.0 / std::max(dimensions, 1));
}

std::vector<PeriodicImage>
BoxedSamples::findImages(double reach, unsigned threads) const
{
  return parallelGather<PeriodicImage>(
      use_.size(),
      boxed_block,
      threads,
      [&](std::size_t begin, std::size_t end, std::vector<PeriodicImage>& found) {
        for (std::size_t i = begin; i < end; ++i)
          appendImages(use_[i], reach, found);
      });
}

void
BoxedSamples::appendImages(std::uint32_t sample,
                           double reach,
                           std::vector<PeriodicImage>& found) const
{
  std::array<std::vector<std::int8_t>, 3> shifts;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    shifts[axis] = {0};
    if (!(box_.sides[axis] > 0.0))
      continue;
    const double width = reach / static_cast<double>(scale_[static_cast<int>(axis)]);
    const auto place = static_cast<double>(places_[sample][static_cast<int>(axis)]);
    if (place <= width)
      shifts[axis].push_back(1);
    if (box_.sides[axis] - place <= width)
      shifts[axis].push_back(-1);
  }
  for (const std::int8_t x : shifts[0])
    for (const std::int8_t y : shifts[1])
      for (const std::int8_t z : shifts[2])
        if (x != 0 || y != 0 || z != 0)
          found.push_back({sample, {{x, y, z}}});
}

PeriodicSamples
BoxedSamples::addImages(const Dataset& samples, double reach, unsigned threads) const
{
  const std::vector<PeriodicImage> images = findImages(reach, threads);
  PeriodicSamples result;
  result.box = box_;
  result.reach = reach;
  const std::size_t step = samples.cloud.point_step, own = samples.cloud.width;
  checkSize(own + images.size(), step);
  result.samples = samples;
  pcl::PCLPointCloud2& cloud = result.samples.cloud;
  resizePoints(cloud, own + images.size());
  for (std::size_t i = 0; i < own; ++i)
    putPlace(places_[i], cloud.data.data() + i * step);
  for (std::size_t i = 0; i < images.size(); ++i) {
    std::uint8_t* const to = cloud.data.data() + (own + i) * step;
    std::memcpy(to, samples.cloud.data.data() + images[i].sample * step, step);
    putPlace(getPlace(images[i]), to);
    result.image_of.push_back(images[i].sample);
  }
  for (std::size_t axis = 0; axis < 3; ++axis)
    result.samples.origin[axis] += box_.low[axis];
  return result;
}

double
findReach(const BoxedSamples& samples,
          const SampleSpread& spread,
          const PeriodicReach& reach,
          const std::function<double(double reach)>& measure_need)
{
  const double most = samples.getShortestSide();
  double found = std::min(
      most, std::max(reach.least, reach.spacings * samples.getSpacing(spread)));
  while (found < most && spread.count > 0) {
    const double need = measure_need(found);
    if (need <= found)
      break;
    found = std::min(most, more * need);
  }
  return found;
}

} // namespace pcl_uvol
