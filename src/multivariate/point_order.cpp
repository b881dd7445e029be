// SPDX-License-Identifier: BSD-3-Clause
#include "multivariate/point_order.h"

#include "common/parallel.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace pcl_uvol {

namespace {

/** Below this many points a cell is one task. */
constexpr std::size_t task_points = 1u << 13;

/** Rows on their way to their places. */
struct Arrangement {
  struct Key {
    float value;
    std::uint32_t point, row;
  };

  std::size_t columns, lanes;
  std::vector<float> rows;
  std::vector<std::uint32_t> points;
  std::vector<Key> keys;
  std::vector<float> moved;

  std::size_t
  widestAxis(std::size_t begin, std::size_t end) const
  {
    std::vector<float> low(&rows[begin * columns], &rows[begin * columns] + columns);
    std::vector<float> high = low;
    for (std::size_t i = begin; i < end; ++i)
      for (std::size_t axis = 0; axis < columns; ++axis) {
        const float value = rows[i * columns + axis];
        low[axis] = std::min(low[axis], value);
        high[axis] = std::max(high[axis], value);
      }
    std::size_t widest = 0;
    for (std::size_t axis = 1; axis < columns; ++axis)
      if (high[axis] - low[axis] > high[widest] - low[widest])
        widest = axis;
    return widest;
  }

  /** Bring the rows that come first along an axis to the places before the cut. */
  void
  part(std::size_t begin, std::size_t cut, std::size_t end, std::size_t axis)
  {
    for (std::size_t i = begin; i < end; ++i)
      keys[i] = {rows[i * columns + axis], points[i], static_cast<std::uint32_t>(i)};
    const auto first = keys.begin();
    std::nth_element(first + static_cast<std::ptrdiff_t>(begin),
                     first + static_cast<std::ptrdiff_t>(cut),
                     first + static_cast<std::ptrdiff_t>(end),
                     [](const Key& a, const Key& b) {
                       return a.value != b.value ? a.value < b.value
                                                 : a.point < b.point;
                     });
    for (std::size_t i = begin; i < end; ++i) {
      points[i] = keys[i].point;
      std::copy_n(&rows[keys[i].row * columns], columns, &moved[i * columns]);
    }
    std::copy(
        &moved[begin * columns], &moved[0] + end * columns, &rows[begin * columns]);
  }

  /** Cuts lie at multiples of the largest power of the lanes, so that every block of
   * the final order is a cell. */
  void
  arrange(std::size_t begin, std::size_t end)
  {
    const std::size_t count = end - begin;
    if (count <= lanes)
      return;
    std::size_t unit = lanes;
    while (unit * lanes < count)
      unit *= lanes;
    const std::size_t units = (count + unit - 1) / unit;
    const std::size_t cut = begin + (units + 1) / 2 * unit;
    part(begin, cut, end, widestAxis(begin, end));
    if (count < task_points) {
      arrange(begin, cut);
      arrange(cut, end);
      return;
    }
    TaskGroup::fork([&] { arrange(begin, cut); }, [&] { arrange(cut, end); });
  }
};

} // namespace

PointOrder
orderPoints(const std::vector<float>& values,
            std::size_t columns,
            std::size_t lanes,
            unsigned threads)
{
  const std::size_t count = values.size() / columns;
  Arrangement arrangement{columns, lanes, values, {}, {}, {}};
  arrangement.points.resize(count);
  std::iota(arrangement.points.begin(), arrangement.points.end(), 0u);
  arrangement.keys.resize(count);
  arrangement.moved.resize(values.size());
  TaskGroup::run(threads, [&] { arrangement.arrange(0, count); });
  return {std::move(arrangement.rows), std::move(arrangement.points)};
}

} // namespace pcl_uvol
