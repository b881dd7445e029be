// SPDX-License-Identifier: BSD-3-Clause
#include "disc_kernel.h"

#include "camera_lanes.h"

namespace pcl_uvol::PCL_UVOL_SIMD {

namespace {

/** Discs that reach at most so many pixels from their centre are drawn side by side,
 * one per lane; larger ones on their own, pixels side by side. */
constexpr int largest_side_by_side = 3;

/** The rays, as (x, y, 1), through the middle of pixels. */
Floats
slopeOf(const Ints& pixels, float center, float focal)
{
  return (toFloats(pixels) + 0.5f - center) * (1.0f / focal);
}

/** Discs, or one disc in all lanes, in camera space. */
struct DiscLanes {
  Vector center, axis; ///< axis: normal of any length
  Floats radius, plane;

  DiscLanes(const Projection& projection,
            const Vector& position,
            const Ints& packed_normal,
            const Floats& disc_radius)
      : center(toCamera(projection, position))
      , radius(disc_radius)
  {
    Floats n[3];
    unpackDirection(packed_normal, n);
    const float* const r = projection.rotation;
    axis = {r[0] * n[0] + r[1] * n[1] + r[2] * n[2],
            r[3] * n[0] + r[4] * n[1] + r[5] * n[2],
            r[6] * n[0] + r[7] * n[1] + r[8] * n[2]};
    plane = axis.x * center.x + axis.y * center.y + axis.z * center.z;
  }

  /** Where rays meet the discs: their parameter along the ray, and the squared distance
   * from the centre. */
  void
  intersect(const Floats& qx, const Floats& qy, Floats& along, Floats& sq_dist) const
  {
    along = plane / (axis.x * qx + axis.y * qy + axis.z);
    const Floats x = along * qx - center.x, y = along * qy - center.y,
                 z = along - center.z;
    sq_dist = x * x + y * y + z * z;
  }

  /** How far the discs reach in the image, in pixels, along the axis of a slope. */
  Floats
  extent(const Projection& projection, const Floats& slope) const
  {
    return projection.focal * radius * squareRoot(1.0f + slope * slope) /
           (center.z - radius);
  }
};

Floats
depthAt(const Projection& projection,
        const Floats& along,
        const Floats& qx,
        const Floats& qy)
{
  return along * squareRoot(qx * qx + (qy * qy + 1.0f)) * projection.per_far;
}

void
keepFront(PixelKey& pixel, float depth, std::uint32_t point)
{
  const PixelKey key = keyOf(depth, point);
  pixel = key < pixel ? key : pixel;
}

/** One disc in a band: pixels side by side. */
class LargeDisc {
public:
  LargeDisc(const Projection& projection,
            const ProjectedPoints& points,
            std::uint32_t point,
            float radius,
            const PixelBand& band)
      : projection_(projection)
      , disc_(projection,
              {fill(points.x[0][point]),
               fill(points.x[1][point]),
               fill(points.x[2][point])},
              fill(static_cast<std::int32_t>(points.normals[point])),
              fill(radius))
      , first_row_(band.first_row)
      , last_row_(band.last_row)
      , last_column_(band.width)
  {
    const Floats x = disc_.center.x / disc_.center.z,
                 y = disc_.center.y / disc_.center.z;
    if (disc_.center.z[0] - disc_.radius[0] < projection.near)
      return;
    range(projection.center_x + projection.focal * x[0],
          disc_.extent(projection, x)[0],
          first_column_,
          last_column_);
    range(projection.center_y + projection.focal * y[0],
          disc_.extent(projection, y)[0],
          first_row_,
          last_row_);
  }

  /** Call visit(row, column, depth, part of the squared radius) for every pixel that is
   * covered. */
  template <typename Visit>
  void
  forCovered(const Visit& visit) const
  {
    const int width = last_column_ - first_column_, height = last_row_ - first_row_;
    if (width <= 0 || height <= 0)
      return;
    if (width < lanes) {
      // Pixels of several rows share a register.
      const float per_width = 1.0f / static_cast<float>(width);
      for (int i = 0; i < width * height; i += lanes) {
        const Ints number = laneNumbers() + i;
        const Ints row = toInts((toFloats(number) + 0.5f) * per_width);
        visitLanes(row + first_row_, number - row * width + first_column_, visit);
      }
      return;
    }
    for (int row = first_row_; row < last_row_; ++row)
      for (int column = first_column_; column < last_column_; column += lanes)
        visitLanes(fill(row), laneNumbers() + column, visit);
  }

  float
  radius() const
  {
    return disc_.radius[0];
  }

  bool
  looksAway() const
  {
    return disc_.plane[0] > 0.0f;
  }

private:
  /** Whole pixels of a range, within bounds. */
  static void
  range(float center, float extent, int& first, int& last)
  {
    const float low = center - extent, high = center + extent;
    first = low > static_cast<float>(first) ? static_cast<int>(low) : first;
    last = high < static_cast<float>(last) ? static_cast<int>(high) + 1 : last;
  }

  template <typename Visit>
  void
  visitLanes(const Ints& rows, const Ints& columns, const Visit& visit) const
  {
    const Floats qx = slopeOf(columns, projection_.center_x, projection_.focal);
    const Floats qy = slopeOf(rows, projection_.center_y, projection_.focal);
    Floats along, sq_dist;
    disc_.intersect(qx, qy, along, sq_dist);
    const Floats depth = depthAt(projection_, along, qx, qy);
    const Ints covered = (along > 0.0f) & (sq_dist <= disc_.radius * disc_.radius) &
                         (depth < 1.0f) & (rows < fill(last_row_)) &
                         (columns < fill(last_column_));
    std::uint32_t bits = laneBits(covered);
    if (bits == 0)
      return;
    alignas(64) std::int32_t row[lanes], column[lanes];
    alignas(64) float depths[lanes], parts[lanes];
    store(row, rows);
    store(column, columns);
    store(depths, depth);
    store(parts, sq_dist / (disc_.radius * disc_.radius));
    for (; bits != 0; bits &= bits - 1) {
      const int lane = __builtin_ctz(bits);
      visit(row[lane], column[lane], depths[lane], parts[lane]);
    }
  }

  const Projection& projection_;
  DiscLanes disc_;
  int first_row_, last_row_, first_column_ = 0, last_column_;
};

float
largest(const Floats& values)
{
  float most = values[0];
  for (int lane = 1; lane < lanes; ++lane)
    most = values[lane] > most ? values[lane] : most;
  return most;
}

/** Which pixels discs cover, as polynomials of the way from the projected centres, in
 * pixels: cheaper than meeting every ray with its plane. */
struct DiscPolynomials {
  Floats xx, xy, yy, x, y, one;      ///< not positive: covered
  Floats toward, toward_x, toward_y; ///< ray of a pixel times axis

  DiscPolynomials(const Projection& projection, const DiscLanes& disc)
  {
    // With q the ray of a pixel, a the axis, c the centre: the ray meets the plane at
    // (a.c / a.q) q, so that the disc is |(a.c) q - (a.q) c| <= radius |a.q|. The left
    // side vanishes in the centre.
    const Vector &a = disc.axis, &c = disc.center;
    const float per_focal = 1.0f / projection.focal;
    const Floats ax = a.x * per_focal, ay = a.y * per_focal;
    const Floats az = a.z * per_focal;
    toward = disc.plane / c.z;
    toward_x = ax;
    toward_y = ay;
    const Vector u = {ay * c.y + az * c.z, -(ax * c.y), -(ax * c.z)};
    const Vector v = {-(ay * c.x), ax * c.x + az * c.z, -(ay * c.z)};
    const Floats rx = disc.radius * ax, ry = disc.radius * ay, r = disc.radius * toward;
    xx = u.x * u.x + u.y * u.y + u.z * u.z - rx * rx;
    xy = 2.0f * (u.x * v.x + u.y * v.y + u.z * v.z - rx * ry);
    yy = v.x * v.x + v.y * v.y + v.z * v.z - ry * ry;
    x = -2.0f * r * rx;
    y = -2.0f * r * ry;
    one = -(r * r);
  }
};

/** Up to a register of discs, one per lane. */
class DiscGroup {
public:
  DiscGroup(const Projection& projection,
            const ProjectedPoints& points,
            const std::uint32_t* discs,
            int count)
      : projection_(projection)
      , discs_(discs)
      , disc_(gather(projection, points, discs, count))
      , slope_x_(disc_.center.x / disc_.center.z)
      , slope_y_(disc_.center.y / disc_.center.z)
  {
    const Floats extent =
        maximum(disc_.extent(projection, slope_x_), disc_.extent(projection, slope_y_));
    constexpr auto most = static_cast<float>(largest_side_by_side);
    const Ints is_here = laneNumbers() < fill(count);
    const Ints is_small =
        (disc_.center.z - disc_.radius >= projection.near) & (extent <= most);
    large_ = laneBits(is_here & ~is_small);
    px_ = projection.center_x + projection.focal * slope_x_;
    py_ = projection.center_y + projection.focal * slope_y_;
    // Far outside no pixel is reached, and integers do not take it. Conversion goes
    // towards zero: shifted, to the lower pixel.
    constexpr float shift = most + 1.0f;
    small_ = is_here & is_small & (px_ > -shift) & (py_ > -shift) &
             (px_ < pixel_limit) & (py_ < pixel_limit);
    column_ = toInts(small_ ? px_ + shift : Floats{}) - static_cast<int>(shift);
    row_ = toInts(small_ ? py_ + shift : Floats{}) - static_cast<int>(shift);
    reach_ = largest(small_ ? extent : Floats{});
  }

  /** Lanes of discs that are too large to be drawn side by side. */
  std::uint32_t
  largeLanes() const
  {
    return large_;
  }

  void
  drawSmall(float back, const PixelBand& band) const
  {
    if (laneBits(small_) == 0)
      return;
    const DiscPolynomials p(projection_, disc_);
    const Floats behind = disc_.radius * (back * projection_.per_far);
    const Ints places =
        (row_ - band.first_row) * static_cast<int>(band.stride) + column_;
    const Floats x = toFloats(column_) + 0.5f - px_, y = toFloats(row_) + 0.5f - py_;
    const float farthest = reach_ + 0.5f; // of a pixel's middle, rounded down
    const int rows = static_cast<int>(farthest);
    for (int dy = -rows; dy <= rows; ++dy) {
      const Ints row = row_ + dy;
      const Ints in_band =
          small_ & (row >= fill(band.first_row)) & (row < fill(band.last_row));
      const Floats ey = y + static_cast<float>(dy);
      const Floats linear = p.xy * ey + p.x, one = (p.yy * ey + p.y) * ey + p.one;
      const Floats qy = slopeOf(row, projection_.center_y, projection_.focal);
      const Floats toward = p.toward + p.toward_y * ey;
      const int columns = columnsAt(dy);
      for (int dx = -columns; dx <= columns; ++dx) {
        const Floats ex = x + static_cast<float>(dx);
        const Ints column = column_ + dx;
        const Ints covered = in_band & ((p.xx * ex + linear) * ex + one <= 0.0f) &
                             (column >= 0) & (column < fill(band.width));
        if (laneBits(covered) == 0)
          continue;
        const Floats qx = slopeOf(column, projection_.center_x, projection_.focal);
        const Floats along = disc_.plane / (toward + p.toward_x * ex);
        const Floats depth = depthAt(projection_, along, qx, qy) + behind;
        keepLanes(laneBits(covered & (depth < 1.0f)),
                  depth,
                  places + (dy * static_cast<int>(band.stride) + dx),
                  band);
      }
    }
  }

private:
  static DiscLanes
  gather(const Projection& projection,
         const ProjectedPoints& points,
         const std::uint32_t* discs,
         int count)
  {
    alignas(64) float x[3][lanes], radius[lanes];
    alignas(64) std::int32_t normal[lanes];
    for (int lane = 0; lane < lanes; ++lane) {
      const std::uint32_t disc = discs[lane < count ? lane : 0];
      for (int axis = 0; axis < 3; ++axis)
        x[axis][lane] = points.x[axis][disc];
      normal[lane] = static_cast<std::int32_t>(points.normals[disc]);
      radius[lane] = points.radii[disc];
    }
    return DiscLanes(projection,
                     {load<Floats>(x[0]), load<Floats>(x[1]), load<Floats>(x[2])},
                     load<Ints>(normal),
                     load<Floats>(radius));
  }

  /** How many columns beside their centres' discs can reach so many rows away. */
  int
  columnsAt(int dy) const
  {
    const float rows = dy == 0 ? 0.0f : static_cast<float>(dy < 0 ? -dy : dy) - 0.5f;
    const float left = reach_ * reach_ - rows * rows;
    return left < 0.0f ? -1 : static_cast<int>(__builtin_sqrtf(left) + 0.5f);
  }

  void
  keepLanes(std::uint32_t bits,
            const Floats& depths,
            const Ints& places,
            const PixelBand& band) const
  {
    alignas(64) float depth[lanes];
    alignas(64) std::int32_t place[lanes];
    store(depth, depths);
    store(place, places);
    PixelKey* const keys = band.keys + band.first_row * band.stride;
    for (; bits != 0; bits &= bits - 1) {
      const int lane = __builtin_ctz(bits);
      keepFront(keys[place[lane]], depth[lane], discs_[lane]);
    }
  }

  const Projection& projection_;
  const std::uint32_t* discs_;
  DiscLanes disc_;
  Floats slope_x_, slope_y_, px_, py_;
  Ints small_, column_, row_;
  float reach_; ///< of the small ones, in pixels
  std::uint32_t large_;
};

void
draw(const Projection& projection,
     const ProjectedPoints& points,
     const std::uint32_t* discs,
     std::size_t count,
     float back,
     const PixelBand& band)
{
  for (std::size_t i = 0; i < count; i += static_cast<std::size_t>(lanes)) {
    const std::size_t here = count - i;
    const DiscGroup group(
        projection, points, discs + i, here < lanes ? static_cast<int>(here) : lanes);
    group.drawSmall(back, band);
    for (std::uint32_t bits = group.largeLanes(); bits != 0; bits &= bits - 1) {
      const std::uint32_t point =
          discs[i + static_cast<std::size_t>(__builtin_ctz(bits))];
      const LargeDisc disc(projection, points, point, points.radii[point], band);
      const float room = back * disc.radius() * projection.per_far;
      disc.forCovered([&](int row, int column, float depth, float) {
        if (depth + room < 1.0f)
          keepFront(band.keys[row * band.stride + column], depth + room, point);
      });
    }
  }
}

/** All sums of a pixel. */
using PixelSums = float __attribute__((vector_size(blended_values * sizeof(float))));

/** The sums of a pixel, those of its segment cleared if it is the first. */
float*
sumsAt(const BlendSums& blended, std::ptrdiff_t pixel)
{
  const std::ptrdiff_t segment = BlendSums::segmentOf(pixel);
  if (blended.marks[segment] == 0) {
    blended.marks[segment] = 1;
    const std::ptrdiff_t first = segment * blend_segment - blend_segment / 2;
    __builtin_memset(blended.values + blended_values * first,
                     0,
                     sizeof(float) * blended_values * blend_segment);
  }
  return blended.values + blended_values * pixel;
}

void
blend(const Projection& projection,
      const ProjectedPoints& points,
      const std::uint32_t* looks,
      const std::uint32_t* discs,
      std::size_t count,
      const PixelBand& band,
      const BlendSums& blended)
{
  for (std::size_t i = 0; i < count; ++i) {
    const LargeDisc disc(
        projection, points, discs[i], points.stretch * points.radii[discs[i]], band);
    Floats direction[3];
    unpackDirection(fill(static_cast<std::int32_t>(looks[2 * discs[i]])), direction);
    const Floats length =
        squareRoot(direction[0] * direction[0] + direction[1] * direction[1] +
                   direction[2] * direction[2]);
    const float side = projection.two_sided && disc.looksAway() ? -1.0f : 1.0f;
    const std::uint32_t color = looks[2 * discs[i] + 1];
    float values[blended_values] = {};
    for (int k = 0; k < 3; ++k) {
      values[k] = side * direction[k][0] / length[0];
      values[3 + k] = static_cast<float>((color >> (8 * k)) & 0xff);
    }
    values[6] = 1.0f;
    const float room = disc.radius() * projection.per_far;
    disc.forCovered([&](int row, int column, float depth, float part) {
      const std::ptrdiff_t pixel = row * band.stride + column;
      const float behind = depth - depthOf(band.keys[pixel]);
      if (!(behind <= room && behind >= -room))
        return;
      // Falls smoothly to zero at the rim.
      const float weight = (1.0f - part) * (1.0f - part);
      float* const sums = sumsAt(blended, pixel);
      store(sums, load<PixelSums>(sums) + load<PixelSums>(values) * weight);
    });
  }
}

} // namespace

extern const DiscKernels disc_kernels{draw, blend};

} // namespace pcl_uvol::PCL_UVOL_SIMD
