// SPDX-License-Identifier: BSD-3-Clause
#include "common/parallel.h"
#include "common/records.h"
#include "neighbors/nearest_finder.h"
#include "neighbors/periodic_box.h"
#include <pcl_uvol/common/cloud_view.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>

namespace pcl_uvol {
namespace {

constexpr std::size_t block_samples = 1024;

/** A reach that was too short grows to what was seen to be needed, and a little more.
 */
constexpr double more = 1.05;

/** An image of a sample: how many sides away, per axis. */
struct Image {
  std::uint32_t sample;
  std::array<std::int8_t, 3> shift;
};

/** Samples in their box, whose images are wanted. */
class BoxedSamples {
public:
  BoxedSamples(const CloudView& cloud,
               const std::vector<std::uint32_t>& use,
               const PeriodicBox& box,
               const Position& scale)
      : use_(use)
      , box_(box)
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
  }

  const Position&
  getPlace(std::size_t sample) const
  {
    return places_[sample];
  }

  Position
  getPlace(const Image& image) const
  {
    Position place = places_[image.sample];
    for (int axis = 0; axis < 3; ++axis)
      place[axis] = static_cast<float>(static_cast<double>(place[axis]) +
                                       image.shift[static_cast<std::size_t>(axis)] *
                                           box_.sides[static_cast<std::size_t>(axis)]);
    return place;
  }

  /** \brief The side of the box along an axis in the stretched space; infinite where
   * it does not repeat. */
  double
  getSide(std::size_t axis) const
  {
    const double side = box_.sides[axis];
    return side > 0.0 ? side * static_cast<double>(scale_[static_cast<int>(axis)])
                      : std::numeric_limits<double>::infinity();
  }

  /** \brief Distance to the nearest face, in the stretched space. */
  double
  getDepth(std::uint32_t sample) const
  {
    double depth = std::numeric_limits<double>::infinity();
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (box_.sides[axis] > 0.0) {
        const auto place = static_cast<double>(places_[sample][static_cast<int>(axis)]);
        depth = std::min(depth,
                         std::min(place, box_.sides[axis] - place) *
                             static_cast<double>(scale_[static_cast<int>(axis)]));
      }
    return depth;
  }

  /** \brief Mean spacing, in the stretched space. */
  double
  getSpacing() const
  {
    double volume = 1.0;
    int dimensions = 0;
    for (int axis = 0; axis < 3; ++axis) {
      double length = box_.sides[static_cast<std::size_t>(axis)];
      if (!(length > 0.0))
        length = measureExtent(axis);
      if (!(length > 0.0))
        continue;
      volume *= length * static_cast<double>(scale_[axis]);
      ++dimensions;
    }
    return std::pow(volume / static_cast<double>(std::max<std::size_t>(use_.size(), 1)),
                    1.0 / std::max(dimensions, 1));
  }

  /** \brief The images that lie no farther from the box than a reach. */
  std::vector<Image>
  findImages(double reach, unsigned threads) const
  {
    return parallelGather<Image>(
        use_.size(),
        block_samples,
        threads,
        [&](std::size_t begin, std::size_t end, std::vector<Image>& found) {
          for (std::size_t i = begin; i < end; ++i)
            addImages(use_[i], reach, found);
        });
  }

private:
  double
  measureExtent(int axis) const
  {
    float low = std::numeric_limits<float>::max(), high = -low;
    for (const std::uint32_t sample : use_)
      if (const float x = places_[sample][axis]; std::isfinite(x)) {
        low = std::min(low, x);
        high = std::max(high, x);
      }
    return high > low ? static_cast<double>(high) - static_cast<double>(low) : 0.0;
  }

  void
  addImages(std::uint32_t sample, double reach, std::vector<Image>& found) const
  {
    if (!isFinite(places_[sample]))
      return;
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

  const std::vector<std::uint32_t>& use_;
  const PeriodicBox& box_;
  const Position scale_;
  std::vector<Position> places_;
};

/** How far beyond the faces the neighbours of samples in the box lie, in the stretched
 * space; more than the reach where images do not suffice. */
double
measureNeed(const BoxedSamples& boxed,
            const std::vector<std::uint32_t>& use,
            const std::vector<Image>& images,
            const PeriodicReach& how,
            double reach,
            unsigned threads,
            const ProgressCallback& progress)
{
  std::vector<Position> places;
  places.reserve(use.size() + images.size());
  for (const std::uint32_t sample : use)
    places.push_back(boxed.getPlace(sample));
  for (const Image& image : images)
    places.push_back(boxed.getPlace(image));
  std::vector<std::uint32_t> all(places.size());
  std::iota(all.begin(), all.end(), 0u);
  Report own; // of samples that others count as well
  own.progress = progress;
  const auto set = SampleSet::build(places[0].x, 3, all, how.scale, threads, own);
  if (set->size() < how.neighbors)
    return std::numeric_limits<double>::infinity();
  StepTimer step(own, "images", set->size());
  std::vector<double> needs((set->size() + block_samples - 1) / block_samples, 0.0);
  parallelBlocks(set->size(), block_samples, threads, [&](auto begin, auto end) {
    NearestFinder finder(*set, how.neighbors);
    float length = 1.0f;
    double& need = needs[begin / block_samples];
    for (std::size_t i = begin; i < end; ++i) {
      const std::uint32_t input = set->getInputIndex(i);
      const double depth =
          input < use.size() ? boxed.getDepth(use[input]) : 2.0 * reach;
      if (depth > reach) // neighbours of deeper ones lie in the box, but for voids
        continue;
      const auto row = finder.find(set->getPositions()[i], length);
      length = std::sqrt(*std::max_element(row.sq_dists, row.sq_dists + row.size));
      need =
          std::max(need, set->getUnit().toInput(static_cast<double>(length)) - depth);
    }
    step.advance(end - begin);
  });
  return *std::max_element(needs.begin(), needs.end());
}

void
putPlace(const Position& place, std::uint8_t* point)
{
  for (std::size_t axis = 0; axis < 3; ++axis)
    putCoordinate(static_cast<double>(place[static_cast<int>(axis)]), axis, point);
}

} // namespace

PeriodicSamples
addPeriodicImages(const Dataset& samples,
                  const std::vector<std::uint32_t>& use,
                  const PeriodicBox& box,
                  const PeriodicReach& reach,
                  unsigned threads,
                  Report& report)
{
  const StepTimer timer(report, "images");
  const BoxedSamples boxed(viewOf(samples.cloud), use, box, reach.scale);
  const double most = std::min({boxed.getSide(0), boxed.getSide(1), boxed.getSide(2)});
  PeriodicSamples result;
  result.box = box;
  result.reach =
      std::min(most, std::max(reach.least, reach.spacings * boxed.getSpacing()));
  std::vector<Image> images = boxed.findImages(result.reach, threads);
  while (result.reach < most && !use.empty()) {
    const double need =
        measureNeed(boxed, use, images, reach, result.reach, threads, report.progress);
    if (need <= result.reach)
      break;
    result.reach = std::min(most, more * need);
    images = boxed.findImages(result.reach, threads);
  }
  const std::size_t step = samples.cloud.point_step, own = samples.cloud.width;
  checkSize(own + images.size(), step);
  result.samples = samples;
  pcl::PCLPointCloud2& cloud = result.samples.cloud;
  resizePoints(cloud, own + images.size());
  for (std::size_t i = 0; i < own; ++i)
    putPlace(boxed.getPlace(i), cloud.data.data() + i * step);
  for (std::size_t i = 0; i < images.size(); ++i) {
    std::uint8_t* const to = cloud.data.data() + (own + i) * step;
    std::memcpy(to, samples.cloud.data.data() + images[i].sample * step, step);
    putPlace(boxed.getPlace(images[i]), to);
    result.image_of.push_back(images[i].sample);
  }
  for (std::size_t axis = 0; axis < 3; ++axis)
    result.samples.origin[axis] += box.low[axis];
  return result;
}

PeriodicSamples
addPeriodicImages(const Dataset& samples,
                  const PeriodicBox& box,
                  const PeriodicReach& reach,
                  unsigned threads,
                  Report& report)
{
  std::vector<std::uint32_t> all(samples.cloud.width);
  std::iota(all.begin(), all.end(), 0u);
  return addPeriodicImages(samples, all, box, reach, threads, report);
}

Dataset
dropPeriodicImages(PeriodicSamples&& images, const Dataset& samples)
{
  Dataset own = std::move(images.samples);
  own.origin = samples.origin;
  resizePoints(own.cloud, samples.cloud.width);
  for (std::size_t i = 0; i < samples.cloud.width; ++i)
    std::memcpy(own.cloud.data.data() + i * own.cloud.point_step,
                samples.cloud.data.data() + i * samples.cloud.point_step,
                3 * sizeof(float));
  return own;
}

} // namespace pcl_uvol
