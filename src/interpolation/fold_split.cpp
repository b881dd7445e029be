// SPDX-License-Identifier: BSD-3-Clause
#include "interpolation/fold_split.h"

#include "common/random.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/interpolation/field_interpolation.h>

#include <algorithm>
#include <array>
#include <vector>

namespace pcl_uvol::detail {

FoldSplit::FoldSplit(const pcl::Indices& indices,
                     const Folds& folds,
                     std::size_t fold,
                     std::size_t most)
{
  for (const int index : indices)
    (folds[static_cast<std::size_t>(index)] == fold ? left_out : rest).push_back(index);
  if (!left_out.empty() && rest.empty())
    throw InvalidArgument("single_fold", {});
  if (most == 0 || left_out.size() <= most)
    return;
  std::sort(left_out.begin(), left_out.end(), [](int a, int b) {
    return mixBits(static_cast<std::uint64_t>(a)) <
           mixBits(static_cast<std::uint64_t>(b));
  });
  left_out.resize(most);
}

InterpolatedFields
FoldSplit::interpolate(const CloudView& cloud,
                       const InterpolationParameters& parameters,
                       unsigned threads,
                       Report& report) const
{
  std::vector<std::array<double, 3>> places;
  places.reserve(left_out.size());
  for (const int index : left_out) {
    const float* const xyz = cloud.xyz(static_cast<std::size_t>(index));
    places.push_back({xyz[0], xyz[1], xyz[2]});
  }
  Report read, own; // all samples together tell of what is read
  read.progress = own.progress = report.progress;
  const FieldInterpolator interpolator(
      cloud,
      rest,
      parameters,
      threads,
      read,
      {QueryShape::Space, static_cast<double>(places.size())});
  InterpolatedFields result = interpolator.interpolate(places, threads, own);
  report.warn(own.warnings);
  return result;
}

} // namespace pcl_uvol::detail
