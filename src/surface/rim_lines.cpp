// SPDX-License-Identifier: BSD-3-Clause
#include "surface/rim_lines.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

namespace pcl_uvol {

namespace {

/** How far surfaces go on beyond their outermost points, in radii of the disc: less,
 * and places between these and the rim stay open, more, and what is beyond is covered.
 */
constexpr float margin = 0.3f;

/** Points within so many radii make the hull: fewer make lines that turn from disc to
 * disc, more do not follow rims that curve inwards. */
constexpr float hull_reach = 2.0f;

/** Cosine of the angle to a line's direction within which points beyond the line tell
 * that it is none. */
constexpr float least_ahead = 0.5f;

/** Twice the area of a triangle, positive if it is counter-clockwise. */
float
turnOf(const Eigen::Vector2f& a, const Eigen::Vector2f& b, const Eigen::Vector2f& c)
{
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

std::uint32_t
packDirection(const Eigen::Vector2f& direction)
{
  constexpr int of_quarter = rim_directions / 4;
  const float along = direction[0] / direction.lpNorm<1>();
  const float quarters = direction[1] >= 0.0f ? 1.0f - along : 3.0f + along;
  const auto step = std::lround(quarters * of_quarter);
  return static_cast<std::uint32_t>(step % rim_directions);
}

std::uint32_t
packLine(const RimLine& line, float radius)
{
  const float depth = std::floor(rim_depth_steps * (1.0f - line.distance / radius));
  if (!(depth >= 1.0f))
    return 0;
  return packDirection(line.outwards) << rim_depth_bits |
         static_cast<std::uint32_t>(std::min(depth, rim_depth_steps - 1.0f));
}

constexpr std::uint32_t line_bits = 0xffff, depth_bits = rim_depth_steps - 1;

Eigen::Vector2f
unpackDirection(std::uint32_t line)
{
  constexpr float per_quarter = 4.0f / rim_directions;
  const float quarters = per_quarter * static_cast<float>(line >> rim_depth_bits);
  const float along = std::abs(quarters - 2.0f) - 1.0f;
  const float across = 1.0f - std::abs(along);
  return {along, quarters <= 2.0f ? across : -across};
}

RimLine
unpackLine(std::uint32_t line)
{
  if (line == 0)
    return {};
  const auto depth = static_cast<float>(line & depth_bits);
  return {unpackDirection(line).normalized(), 1.0f - depth / rim_depth_steps};
}

std::uint32_t
turnLine(std::uint32_t line, const Eigen::Matrix2f& axes)
{
  if (line == 0)
    return 0;
  const Eigen::Vector2f turned = axes.transpose() * unpackDirection(line);
  return packDirection(turned) << rim_depth_bits | (line & depth_bits);
}

/** Whether a place lies beyond a line, and rather straight ahead. */
bool
haveOneBeyond(const std::vector<Eigen::Vector2f>& places, const RimLine& line)
{
  return std::any_of(places.begin(), places.end(), [&](const auto& place) {
    const float ahead = place.dot(line.outwards);
    return ahead > line.distance &&
           ahead * ahead > least_ahead * least_ahead * place.squaredNorm();
  });
}

/** Bits of sixteen sectors around the centre, counter-clockwise from the first axis,
 * once more in the upper half, by what sectorOf() compares. */
constexpr std::array<std::uint32_t, 16>
listSectors()
{
  std::array<std::uint32_t, 16> sectors{};
  for (int i = 0; i < 16; ++i) {
    const bool is_left = (i & 1) != 0, is_below = (i & 2) != 0, is_steep = (i & 4) != 0,
               is_diagonal = (i & 8) != 0;
    const int in_quarter = is_steep ? (is_diagonal ? 2 : 3) : (is_diagonal ? 1 : 0);
    const int upper = is_left ? 7 - in_quarter : in_quarter,
              lower = is_left ? 8 + in_quarter : 15 - in_quarter;
    sectors[static_cast<std::size_t>(i)] = 0x10001u << (is_below ? lower : upper);
  }
  return sectors;
}

/** The bits of a place's sector, without branches, which nothing would predict. */
std::uint32_t
sectorOf(const Eigen::Vector2f& place)
{
  constexpr std::array<std::uint32_t, 16> sectors = listSectors();
  constexpr float slope = 0.41421356f; // of 22.5 degrees
  const float x = std::abs(place[0]), y = std::abs(place[1]);
  const bool is_left = place[0] < 0.0f;
  const bool is_below = place[1] < 0.0f;
  const bool is_steep = y > x;
  const bool is_diagonal = std::min(x, y) > slope * std::max(x, y);
  return sectors[is_left + 2u * is_below + 4u * is_steep + 8u * is_diagonal];
}

/** False if there is no line for sure: those farther than two radii that lie straight
 * ahead are beyond any line, so that a line leaves four sectors at least without. */
bool
haveOpenSide(const std::vector<Eigen::Vector2f>& places, float radius)
{
  static_assert(least_ahead == 0.5f, "60 degrees to both sides");
  const float sq_far = 4.0f * radius * radius;
  std::uint32_t sectors = 0;
  for (const Eigen::Vector2f& place : places)
    sectors |= place.squaredNorm() >= sq_far ? sectorOf(place) : 0;
  const std::uint32_t open = ~sectors;
  return (open & open >> 1 & open >> 2 & open >> 3) != 0;
}

/** Keep the lines that cut most. */
void
addLine(const RimLine& line, RimLines& lines)
{
  if (line.distance >= lines[1].distance)
    return;
  lines[1] = line;
  if (lines[1].distance < lines[0].distance)
    std::swap(lines[0], lines[1]);
}

} // namespace

PackedRim
packRim(const RimLines& lines, float radius)
{
  return packLine(lines[0], radius) | packLine(lines[1], radius) << 16;
}

RimLines
unpackRim(PackedRim rim)
{
  return {unpackLine(rim & line_bits), unpackLine(rim >> 16)};
}

PackedRim
turnRim(PackedRim rim, const Eigen::Matrix2f& axes)
{
  return turnLine(rim & line_bits, axes) | turnLine(rim >> 16, axes) << 16;
}

float
RimFinder::reachOf(float radius)
{
  return hull_reach * radius;
}

void
RimFinder::makeHull(const std::vector<Eigen::Vector2f>& places, float distance)
{
  near_.assign(1, Eigen::Vector2f::Zero());
  std::copy_if(places.begin(), places.end(), std::back_inserter(near_), [&](auto& x) {
    return x.squaredNorm() <= distance * distance;
  });
  std::sort(near_.begin(), near_.end(), [](const auto& a, const auto& b) {
    return a[0] != b[0] ? a[0] < b[0] : a[1] < b[1];
  });
  hull_.clear();
  const auto addChain = [&](auto place, auto end) { // Andrew 1979
    const std::size_t first = hull_.size();
    for (; place != end; ++place) {
      while (hull_.size() >= first + 2 &&
             turnOf(hull_[hull_.size() - 2], hull_.back(), *place) <= 0.0f)
        hull_.pop_back();
      hull_.push_back(*place);
    }
    hull_.pop_back();
  };
  addChain(near_.begin(), near_.end());
  addChain(near_.rbegin(), near_.rend());
}

RimLines
RimFinder::find(const std::vector<Eigen::Vector2f>& places, float radius)
{
  RimLines lines;
  if (!haveOpenSide(places, radius))
    return lines;
  makeHull(places, reachOf(radius));
  if (hull_.size() < 3)
    return lines;
  for (std::size_t i = 0; i < hull_.size(); ++i) {
    const Eigen::Vector2f side = hull_[i + 1 < hull_.size() ? i + 1 : 0] - hull_[i];
    const Eigen::Vector2f outwards = Eigen::Vector2f(side[1], -side[0]).normalized();
    const RimLine line{outwards, outwards.dot(hull_[i]) + margin * radius};
    if (line.distance < radius && !haveOneBeyond(places, line))
      addLine(line, lines);
  }
  return lines;
}

} // namespace pcl_uvol
