// SPDX-License-Identifier: BSD-3-Clause
#include "render/image_space/block_view.h"

#include <algorithm>
#include <cmath>

namespace pcl_uvol {

namespace {

/** Room for rounding: a part of the distance to the eye, and pixels. */
constexpr float slack = 1e-5f;
constexpr float pixel_slack = 1.0f;

/** Sine of what packing may turn a normal by, and rounding besides. */
constexpr float turn_slack = 1e-3f;

/** Half of the extent of a ball at depth 1, at most. */
float
reach(float slope, float radius, float nearest)
{
  return radius * std::sqrt(1.0f + slope * slope) / nearest;
}

/** Rounded down, within [0, most]. */
int
clamp(float pixel, int most)
{
  return static_cast<int>(std::clamp(pixel, 0.0f, static_cast<float>(most)));
}

} // namespace

BlockView::BlockView(const Frame& frame, const SurfaceBlock& block)
    : view_(frame.view)
    , smallest_disc_(frame.smallestDisc())
    , block_(block)
{
  const float* const r = view_.rotation;
  float sq_distance = 0.0f;
  for (int row = 0; row < 3; ++row) {
    center_[row] = view_.translation[row];
    for (int column = 0; column < 3; ++column)
      center_[row] += r[3 * row + column] * block.center[column];
    sq_distance += center_[row] * center_[row];
  }
  distance_ = std::sqrt(sq_distance);
  disc_radius_ = frame.hasFootprints() ? block.largest_footprint : 0.0f;
  if (isSparse())
    disc_radius_ *= blend_reach;
}

float
BlockView::nearest() const
{
  return center_[2] - block_.radius - slack * distance_;
}

bool
BlockView::isBehindEye() const
{
  return center_[2] + block_.radius + slack * distance_ < view_.near;
}

bool
BlockView::looksAway() const
{
  const float sine_extent = block_.radius / distance_;
  if (!(sine_extent < 1.0f) || block_.spread >= 1.0f)
    return false;
  const float* const r = view_.rotation;
  float along = 0.0f; // axis in camera space, times centre
  for (int row = 0; row < 3; ++row)
    along +=
        center_[row] * (r[3 * row] * block_.axis[0] + r[3 * row + 1] * block_.axis[1] +
                        r[3 * row + 2] * block_.axis[2]);
  const float cosine_extent = std::sqrt(1.0f - sine_extent * sine_extent);
  const float cosine_spread = std::sqrt(1.0f - block_.spread * block_.spread);
  const float sine = block_.spread * cosine_extent + cosine_spread * sine_extent;
  const float cosine = cosine_spread * cosine_extent - block_.spread * sine_extent;
  return cosine > 0.0f && along > (sine + turn_slack) * distance_;
}

bool
BlockView::isSparse() const
{
  return disc_radius_ > 0.0f && block_.mean_footprint * view_.focal >
                                    smallest_disc_ * std::max(center_[2], view_.near);
}

bool
BlockView::mayHoldDiscs(float pixels) const
{
  if (disc_radius_ == 0.0f)
    return false;
  const float nearest_disc = nearest() - disc_radius_;
  if (nearest_disc < view_.near)
    return true;
  const float slope =
      (std::max(std::abs(center_[0]), std::abs(center_[1])) + block_.radius) /
      nearest();
  return view_.focal * reach(slope, disc_radius_, nearest_disc) >
         (1.0f - slack) * pixels;
}

PixelBox
BlockView::box() const
{
  const PixelBox whole{0, 0, view_.bufferWidth(), view_.bufferHeight()};
  const float radius = block_.radius + disc_radius_;
  const float nearest = center_[2] - radius - slack * distance_;
  if (nearest < view_.near)
    return whole;
  const float x = center_[0] / center_[2], y = center_[1] / center_[2];
  const auto low = [&](float center, float slope) {
    return center + view_.focal * (slope - reach(slope, radius, nearest)) - pixel_slack;
  };
  const auto high = [&](float center, float slope) {
    return center + view_.focal * (slope + reach(slope, radius, nearest)) + pixel_slack;
  };
  return {clamp(low(view_.center_x, x), whole.right),
          clamp(low(view_.center_y, y), whole.bottom),
          clamp(high(view_.center_x, x) + 1.0f, whole.right),
          clamp(high(view_.center_y, y) + 1.0f, whole.bottom)};
}

} // namespace pcl_uvol
