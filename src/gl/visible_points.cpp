// SPDX-License-Identifier: BSD-3-Clause
#include "gl/visible_points.h"

#include "render/image_space/block_view.h"

namespace pcl_uvol {

namespace {

void
append(std::vector<PointRange>& ranges, const SurfaceBlock& block)
{
  if (!ranges.empty() && ranges.back().end == block.begin)
    ranges.back().end = block.end;
  else
    ranges.push_back({block.begin, block.end});
}

} // namespace

VisiblePoints
findVisiblePoints(const Frame& frame, float largest_reach)
{
  VisiblePoints visible;
  for (const SurfaceBlock& block : frame.cloud.getBlocks()) {
    const BlockView seen(frame, block);
    if (seen.isBehindEye() || (frame.culls() && seen.looksAway()))
      continue;
    const PixelBox box = seen.box();
    if (box.isEmpty())
      continue;
    visible.box = visible.box.unitedWith(box);
    VisibleRanges& ranges = seen.isSparse() ? visible.sparse : visible.dense;
    append(ranges.points, block);
    if (seen.mayHoldDiscs(largest_reach))
      append(ranges.large_discs, block);
  }
  return visible;
}

} // namespace pcl_uvol
