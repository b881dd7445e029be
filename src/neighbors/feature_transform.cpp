// SPDX-License-Identifier: BSD-3-Clause
// The nearest site of every cell, axis by axis: rows are swept, then columns along y
// and along z take the lower envelope of parabolas (Meijster et al. 2000, Felzenszwalb
// and Huttenlocher 2012).
#include "common/parallel.h"
#include <pcl_uvol/neighbors/voronoi_diagram.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace pcl_uvol {

namespace {

/** Columns that are worked on together: what a line of the cache holds. */
constexpr std::size_t bundle = 16;

/** Holds squared distances of the flattest cells. */
__extension__ using Wide = __int128;

/** Squared distances as whole numbers, so that ties are ties: 32 bits where all
 * spacings are equal, else 64 bits, or 128 where cells are flat. */
template <typename Number>
class Transform {
public:
  Transform(const GridShape& shape,
            const std::vector<GridCell>& sites,
            const std::array<Number, 3>& weights,
            std::vector<std::uint32_t>& nearest)
      : cells_(shape.cells)
      , sites_(sites)
      , weights_(weights)
      , nearest_(nearest)
  {
  }

  void
  run(unsigned threads, StepTimer& step)
  {
    parallelBlocks(cells_[2], 1, threads, [&](std::size_t z, std::size_t) {
      fillPlane(static_cast<std::uint16_t>(z));
      step.advance(1);
    });
    parallelBlocks(cells_[1], 1, threads, [&](std::size_t y, std::size_t) {
      Columns columns(cells_[2]);
      const std::size_t plane = std::size_t{cells_[0]} * cells_[1];
      takeEnvelopes<2>(
          y * cells_[0], plane, columns, [&](std::uint32_t site, std::size_t x) {
            return square<0>(sites_[site][0], x) + square<1>(sites_[site][1], y);
          });
      step.advance(1);
    });
  }

private:
  /** One of the lowest parabolas of a column, from the cell where it becomes so. */
  struct Parabola {
    Number place, cost, start; ///< cost: squared distance across the column
    std::uint32_t site;
  };

  /** Workspace for columns of cells. */
  struct Columns {
    explicit Columns(std::size_t size)
        : length(size)
        , sites(bundle * length)
        , envelope(length)
    {
    }

    std::size_t length;
    std::vector<std::uint32_t> sites; ///< of a bundle, column by column
    std::vector<Parabola> envelope;
  };

  template <std::size_t axis>
  Number
  square(std::size_t a, std::size_t b) const
  {
    const Number along = static_cast<Number>(a) - static_cast<Number>(b);
    return weights_[axis] * along * along;
  }

  /** The sites of a plane of equal z: nearest ones within each row, then within the
   * plane. */
  void
  fillPlane(std::uint16_t z)
  {
    const std::size_t plane = std::size_t{cells_[0]} * cells_[1];
    std::uint32_t* const first = &nearest_[z * plane];
    std::fill(first, first + plane, no_site);
    const auto begin = std::partition_point(
        sites_.begin(), sites_.end(), [z](const GridCell& s) { return s[2] < z; });
    auto site = begin;
    while (site != sites_.end() && (*site)[2] == z)
      site = fillRow(site, first);
    if (site == begin)
      return;
    Columns columns(cells_[1]);
    takeEnvelopes<1>(
        z * plane, cells_[0], columns, [&](std::uint32_t filled, std::size_t x) {
          return square<0>(sites_[filled][0], x);
        });
  }

  /** \return the first site behind the row */
  std::vector<GridCell>::const_iterator
  fillRow(std::vector<GridCell>::const_iterator site, std::uint32_t* plane)
  {
    const std::uint16_t y = (*site)[1], z = (*site)[2];
    std::uint32_t* const row = plane + std::size_t{y} * cells_[0];
    std::size_t x = 0;
    while (true) {
      const auto next = site + 1;
      const bool is_last = next == sites_.end() || (*next)[1] != y || (*next)[2] != z;
      const std::size_t end =
          is_last ? cells_[0] : (std::size_t{(*site)[0]} + (*next)[0]) / 2 + 1;
      std::fill(row + x, row + end, static_cast<std::uint32_t>(site - sites_.begin()));
      if (is_last)
        return next;
      x = end;
      site = next;
    }
  }

  /** Columns along an axis that start at the cells of a row.
   * \param cost(site, x) squared distance of a site from the column */
  template <std::size_t axis, typename Cost>
  void
  takeEnvelopes(std::size_t row, std::size_t stride, Columns& columns, const Cost& cost)
  {
    const std::size_t length = columns.length;
    for (std::size_t x = 0; x < cells_[0]; x += bundle) {
      const std::size_t width = std::min<std::size_t>(bundle, cells_[0] - x);
      std::uint32_t* const cells = &nearest_[row + x];
      for (std::size_t i = 0; i < length; ++i)
        for (std::size_t j = 0; j < width; ++j)
          columns.sites[j * length + i] = cells[i * stride + j];
      for (std::size_t j = 0; j < width; ++j)
        takeEnvelope(&columns.sites[j * length],
                     static_cast<Number>(length),
                     weights_[axis],
                     columns.envelope.data(),
                     [&](std::uint32_t site) { return cost(site, x + j); });
      for (std::size_t i = 0; i < length; ++i)
        for (std::size_t j = 0; j < width; ++j)
          cells[i * stride + j] = columns.sites[j * length + i];
    }
  }

  /** The site of every cell of a column becomes that of the lowest parabola there; of
   * equally low ones that of the first, so the lower site. */
  template <typename Cost>
  static void
  takeEnvelope(std::uint32_t* sites,
               Number length,
               Number weight,
               Parabola* const first,
               const Cost& cost)
  {
    Parabola* end = first;
    for (Number i = 0; i < length; ++i) {
      if (sites[i] == no_site)
        continue;
      const Number own = cost(sites[i]);
      const auto isHigher = [&](const Parabola& other) {
        const Number across = other.start - other.place, here = other.start - i;
        return other.cost + weight * across * across > own + weight * here * here;
      };
      while (end != first && isHigher(end[-1]))
        --end;
      Number start = 0;
      if (end != first) {
        // Not lower where its predecessor starts: the numerator is not negative.
        const Parabola& before = end[-1];
        start = (own - before.cost + weight * (i * i - before.place * before.place)) /
                    (2 * weight * (i - before.place)) +
                1;
      }
      if (start < length)
        *end++ = {i, own, start, sites[i]};
    }
    for (Number stop = length; end != first; stop = end->start) {
      --end;
      std::fill(sites + end->start, sites + stop, end->site);
    }
  }

  const std::array<std::uint32_t, 3>& cells_;
  const std::vector<GridCell>& sites_;
  const std::array<Number, 3> weights_;
  std::vector<std::uint32_t>& nearest_;
};

/** The spacings, but for cells so flat that no number of them makes up for one step
 * along their thicker sides: these are thick enough to be counted, and keep their
 * order. Beside the thickest side that is exact; beside the next one what is added to
 * squared distances is below 2^-31 of its square. */
std::array<double, 3>
boundedSpacing(const std::array<double, 3>& spacing)
{
  constexpr double flattest[2] = {0x1p-16, 0x1p-30}; // largest_side is 2^14
  std::array<std::size_t, 3> order{{0, 1, 2}};
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return spacing[a] > spacing[b];
  });
  std::array<double, 3> bounded = spacing;
  for (std::size_t i = 1; i < order.size(); ++i) {
    const double least = flattest[i - 1] * bounded[order[i - 1]];
    const double factor = std::max(1.0, least / bounded[order[i]]);
    for (std::size_t j = i; j < order.size(); ++j) // their ratio stays
      bounded[order[j]] *= factor;
  }
  return bounded;
}

/** Squares of the spacings in parts of the smallest one.
 * \param largest sum that the number holds
 * \return nothing if the squared distances of the grid are larger than that */
template <typename Number>
std::optional<std::array<Number, 3>>
wholeWeights(const GridShape& shape, double largest)
{
  const std::array<double, 3> spacing = boundedSpacing(shape.spacing);
  const double smallest = *std::min_element(spacing.begin(), spacing.end());
  std::array<double, 3> ratios{};
  double extent = 0.0; // squared distance
  for (std::size_t axis = 0; axis < 3; ++axis) {
    ratios[axis] = spacing[axis] / smallest;
    extent += std::pow(ratios[axis] * shape.cells[axis], 2);
  }
  double parts = 65536.0;
  while (parts > 1.0 && parts * extent > largest)
    parts *= 0.5;
  if (parts * extent > largest)
    return std::nullopt;
  std::array<Number, 3> weights{};
  for (std::size_t axis = 0; axis < 3; ++axis)
    weights[axis] =
        static_cast<Number>(std::round(parts * ratios[axis] * ratios[axis]));
  return weights;
}

} // namespace

std::vector<std::uint32_t>
FeatureTransform::find(const GridShape& shape,
                       const std::vector<GridCell>& sites,
                       unsigned threads,
                       Report& report)
{
  StepTimer step(report, "feature_transform", shape.cells[2] + shape.cells[1]);
  std::vector<std::uint32_t> nearest(shape.size());
  const auto& spacing = shape.spacing;
  if (spacing[0] == spacing[1] && spacing[0] == spacing[2])
    Transform<std::int32_t>(shape, sites, {{1, 1, 1}}, nearest).run(threads, step);
  else if (const auto weights = wholeWeights<std::int64_t>(shape, 0x1p61))
    Transform<std::int64_t>(shape, sites, *weights, nearest).run(threads, step);
  else
    Transform<Wide>(shape, sites, wholeWeights<Wide>(shape, 0x1p125).value(), nearest)
        .run(threads, step);
  return nearest;
}

} // namespace pcl_uvol
