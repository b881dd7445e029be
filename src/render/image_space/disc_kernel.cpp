// SPDX-License-Identifier: BSD-3-Clause
#include "render/image_space/disc_kernel.h"

#include "render/image_space/camera_lanes.h"
#include "render/image_space/side_kernel.h"

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
  Vector center;
  Floats radius;
  Floats facing;         ///< positive: seen from behind
  Floats tilt_x, tilt_y; ///< relative change of 1 / z along the image, per pixel
  Floats px, py;         ///< the centre in the image, pixels

  DiscLanes(const Projection& projection,
            const Vector& position,
            const Ints& packed_normal,
            const Floats& disc_radius,
            const Floats& footprint)
      : center(toCamera(projection, position))
  {
    const Floats per_length = pixelsPerLength(projection, center);
    radius = discRadius(projection, disc_radius, footprint, per_length);
    Floats n[3];
    unpackDirection(packed_normal, n);
    for (Floats& part : n)
      part *= projection.outward;
    const float* const r = projection.rotation;
    const Vector axis = {r[0] * n[0] + r[1] * n[1] + r[2] * n[2],
                         r[3] * n[0] + r[4] * n[1] + r[5] * n[2],
                         r[6] * n[0] + r[7] * n[1] + r[8] * n[2]};
    facing = axis.x * center.x + axis.y * center.y + axis.z * center.z;
    // Infinite where a disc is seen edge-on, so that no pixel is covered.
    const Floats slant = pixelSize(projection) * (1.0f / facing);
    tilt_x = axis.x * slant;
    tilt_y = axis.y * slant;
    px = projection.center_x + center.x * per_length;
    py = projection.center_y + center.y * per_length;
  }

  /** Side of a pixel in the centres. */
  Floats
  pixelSize(const Projection& projection) const
  {
    return center.z * (1.0f / projection.focal);
  }

  /** How far the discs reach in the image, in pixels, along the axis of a slope. */
  Floats
  extent(const Projection& projection, const Floats& slope) const
  {
    return projection.focal * radius * squareRoot(1.0f + slope * slope) /
           (center.z - radius);
  }
};

/** \param z of the place where a ray meets a disc */
Floats
depthAt(const Projection& projection,
        const Floats& z,
        const Floats& qx,
        const Floats& qy)
{
  return z * squareRoot(qx * qx + (qy * qy + 1.0f)) * projection.per_far;
}

/** Which pixels discs cover, as polynomials of the way from the projected centres, in
 * pixels: cheaper than meeting every ray with its plane, and more exact far away. */
struct DiscPolynomials {
  Floats xx, xy, yy, x, y, one; ///< not positive: covered

  DiscPolynomials(const Projection& projection, const DiscLanes& disc)
  {
    // With e the way in pixels, s their size in the centre c, t the tilt: rays meet the
    // plane of the disc where z is c.z / (1 + t.e), so that the disc is
    // |s e - (t.e) c| <= radius |1 + t.e|. The left side vanishes in the centre.
    const Vector& c = disc.center;
    const Floats size = disc.pixelSize(projection), tx = disc.tilt_x, ty = disc.tilt_y;
    const Vector u = {size - tx * c.x, -(tx * c.y), -(tx * c.z)};
    const Vector v = {-(ty * c.x), size - ty * c.y, -(ty * c.z)};
    const Floats r = disc.radius, rx = r * tx, ry = r * ty;
    xx = u.x * u.x + u.y * u.y + u.z * u.z - rx * rx;
    xy = 2.0f * (u.x * v.x + u.y * v.y + u.z * v.z - rx * ry);
    yy = v.x * v.x + v.y * v.y + v.z * v.z - ry * ry;
    x = -2.0f * (r * rx);
    y = -2.0f * (r * ry);
    one = -(r * r);
  }

  /** In one row, as a polynomial of the way along it: linear and constant term. @{ */
  Floats
  linearAt(const Floats& ey) const
  {
    return xy * ey + x;
  }
  Floats
  constantAt(const Floats& ey) const
  {
    return (yy * ey + y) * ey + one;
  }
  /** @} */
};

void
keepFront(PixelKey& pixel, float depth, std::uint32_t point)
{
  const PixelKey key = keyOf(depth, point);
  pixel = key < pixel ? key : pixel;
}

/** Pixels that share a register: so many columns of two rows. */
constexpr int patch_columns = lanes / 2;

/** Where the rows of a patch begin, as keys of a band count. */
struct Patch {
  std::ptrdiff_t first, second;

  /** The second row is the first one where the band ends: the next is another thread's.
   */
  Patch(const PixelBand& band, int row, int column)
      : first(row * band.stride + column)
      , second(first + (row + 1 < band.last_row ? band.stride : 0))
  {
  }

  std::ptrdiff_t
  pixelOf(int lane) const
  {
    return (lane < patch_columns ? first : second) + lane % patch_columns;
  }

  Floats
  seenDepths(const PixelBand& band) const
  {
    return fromBits(
        upperHalves(load<Longs>(band.keys + first), load<Longs>(band.keys + second)));
  }
};

/** One disc in a band: pixels side by side. */
class LargeDisc {
public:
  LargeDisc(const Projection& projection,
            const ProjectedPoints& points,
            std::uint32_t point,
            float stretch,
            const PixelBand& band)
      : disc_(projection,
              {fill(points.x[0][point]),
               fill(points.x[1][point]),
               fill(points.x[2][point])},
              fill(static_cast<std::int32_t>(points.normals[point])),
              fill(stretch * points.radii[point]),
              fill(stretch * points.footprints[point]))
      , polynomials_(projection, disc_)
      , projection_(projection)
      , first_row_(band.first_row)
      , last_row_(band.last_row)
      , last_column_(band.width)
  {
    if (disc_.center.z[0] - disc_.radius[0] < projection.near)
      return;
    const Floats per_z = 1.0f / disc_.center.z;
    range(disc_.px[0],
          disc_.extent(projection, disc_.center.x * per_z)[0],
          first_column_,
          last_column_);
    range(disc_.py[0],
          disc_.extent(projection, disc_.center.y * per_z)[0],
          first_row_,
          last_row_);
  }

  /** Whether pixels may see it, stretched, within its radius and so much depth besides:
   * not if it lies farther behind all that is seen in the cells that it reaches. */
  bool
  mayBeSeen(const PixelBand& band, const float* deepest, float room) const
  {
    const float facing = __builtin_fabsf(disc_.facing[0]);
    if (facing < least_cosine * distance())
      return true;
    const float nearest =
        ((1.0f - depth_error) * distance() - 2.0f * radius()) * projection_.per_far -
        room;
    const int cells = cellsInRow(band.width);
    for (int row = (first_row_ - band.first_row) / cell_rows;
         row * cell_rows < last_row_ - band.first_row;
         ++row)
      for (int column = first_column_ / cell_columns;
           column * cell_columns < last_column_;
           ++column)
        if (deepest[row * cells + column] >= nearest)
          return true;
    return false;
  }

  /** Call visit(row, column, covered lanes, depths, parts of the squared radius) for
   * every patch with a pixel that is covered; row and column of its first pixel. */
  template <typename Visit>
  void
  forPatches(const Visit& visit) const
  {
    for (int row = first_row_; row < last_row_; row += 2)
      for (int column = first_column_; column < last_column_; column += patch_columns)
        visitPatch(row, column, visit);
  }

  float
  radius() const
  {
    return disc_.radius[0];
  }

  /** The distance of its centre to the eye. */
  float
  distance() const
  {
    const Vector& c = disc_.center;
    return squareRoot(c.x * c.x + c.y * c.y + c.z * c.z)[0];
  }

  bool
  looksAway() const
  {
    return disc_.facing[0] > 0.0f;
  }

private:
  /** Depths of a disc that is seen under a smaller cosine, nearly edge-on, may be off
   * by more than its radius: rounding is multiplied by the square of its inverse.
   * Others, at 1e-7 of the distance for each operation, by far less than the second. @{
   */
  static constexpr float least_cosine = 0.05f, depth_error = 1e-4f;
  /** @} */

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
  visitPatch(int row, int column, const Visit& visit) const
  {
    const Ints lane = laneNumbers();
    const Ints rows = row - (lane >= patch_columns); // a true one is -1
    const Ints columns = column + (lane & (patch_columns - 1));
    const Floats ex = toFloats(columns) + 0.5f - disc_.px,
                 ey = toFloats(rows) + 0.5f - disc_.py;
    const Floats beyond = (polynomials_.xx * ex + polynomials_.linearAt(ey)) * ex +
                          polynomials_.constantAt(ey);
    const Floats toward = (1.0f + disc_.tilt_y * ey) + disc_.tilt_x * ex;
    const Ints inside = (toward > 0.0f) & (beyond <= 0.0f) & (rows < fill(last_row_)) &
                        (columns < fill(last_column_));
    if (laneBits(inside) == 0)
      return;
    const Floats qx = slopeOf(columns, projection_.center_x, projection_.focal);
    const Floats qy = slopeOf(rows, projection_.center_y, projection_.focal);
    const Floats depth = depthAt(projection_, disc_.center.z * (1.0f / toward), qx, qy);
    const Floats radius = disc_.radius * toward;
    visit(
        row, column, inside & (depth < 1.0f), depth, 1.0f + beyond / (radius * radius));
  }

  DiscLanes disc_;
  DiscPolynomials polynomials_;
  const Projection& projection_;
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

/** Up to a register of discs, one per lane. */
class DiscGroup {
public:
  DiscGroup(const Projection& projection,
            const ProjectedPoints& points,
            const std::uint32_t* discs,
            int count)
      : disc_(gather(projection, points, discs, count))
      , projection_(projection)
      , discs_(discs)
  {
    const Floats per_z = 1.0f / disc_.center.z;
    const Floats extent = maximum(disc_.extent(projection, disc_.center.x * per_z),
                                  disc_.extent(projection, disc_.center.y * per_z));
    constexpr auto most = static_cast<float>(largest_side_by_side);
    const Ints is_here = laneNumbers() < fill(count);
    const Ints is_small =
        (disc_.center.z - disc_.radius >= projection.near) & (extent <= most);
    large_ = laneBits(is_here & ~is_small);
    // Far outside no pixel is reached, and integers do not take it. Conversion goes
    // towards zero: shifted, to the lower pixel.
    constexpr float shift = most + 1.0f;
    const Floats &px = disc_.px, &py = disc_.py;
    small_ = is_here & is_small & (px > -shift) & (py > -shift) & (px < pixel_limit) &
             (py < pixel_limit);
    column_ = toInts(small_ ? px + shift : Floats{}) - static_cast<int>(shift);
    row_ = toInts(small_ ? py + shift : Floats{}) - static_cast<int>(shift);
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
    const Floats depth_in_radii =
        disc_.facing > 0.0f ? fill(back + projection_.away_depth) : fill(back);
    const Floats behind = disc_.radius * (depth_in_radii * projection_.per_far);
    const Ints places =
        (row_ - band.first_row) * static_cast<int>(band.stride) + column_;
    const Floats x = toFloats(column_) + 0.5f - disc_.px,
                 y = toFloats(row_) + 0.5f - disc_.py;
    const float farthest = reach_ + 0.5f; // of a pixel's middle, rounded down
    const int rows = static_cast<int>(farthest);
    for (int dy = -rows; dy <= rows; ++dy) {
      const Ints row = row_ + dy;
      const Ints in_band =
          small_ & (row >= fill(band.first_row)) & (row < fill(band.last_row));
      const Floats ey = y + static_cast<float>(dy);
      const Floats linear = p.linearAt(ey), constant = p.constantAt(ey);
      const Floats qy = slopeOf(row, projection_.center_y, projection_.focal);
      const Floats toward = 1.0f + disc_.tilt_y * ey;
      const int columns = columnsAt(dy);
      for (int dx = -columns; dx <= columns; ++dx) {
        const Floats ex = x + static_cast<float>(dx);
        const Ints column = column_ + dx;
        const Ints covered = in_band & ((p.xx * ex + linear) * ex + constant <= 0.0f) &
                             (column >= 0) & (column < fill(band.width));
        if (laneBits(covered) == 0)
          continue;
        const Floats qx = slopeOf(column, projection_.center_x, projection_.focal);
        const Floats z = disc_.center.z * (1.0f / (toward + disc_.tilt_x * ex));
        const Floats depth = depthAt(projection_, z, qx, qy) + behind;
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
    alignas(64) float x[3][lanes], radius[lanes], footprint[lanes];
    alignas(64) std::int32_t normal[lanes];
    for (int lane = 0; lane < lanes; ++lane) {
      const std::uint32_t disc = discs[lane < count ? lane : 0];
      for (int axis = 0; axis < 3; ++axis)
        x[axis][lane] = points.x[axis][disc];
      normal[lane] = static_cast<std::int32_t>(points.normals[disc]);
      radius[lane] = points.radii[disc];
      footprint[lane] = points.footprints[disc];
    }
    return DiscLanes(projection,
                     {load<Floats>(x[0]), load<Floats>(x[1]), load<Floats>(x[2])},
                     load<Ints>(normal),
                     load<Floats>(radius),
                     load<Floats>(footprint));
  }

  /** How many columns beside their centres' discs can reach so many rows away. */
  int
  columnsAt(int dy) const
  {
    const float rows = dy == 0 ? 0.0f : static_cast<float>(dy < 0 ? -dy : dy) - 0.5f;
    const float left = reach_ * reach_ - rows * rows;
    if (left < 0.0f)
      return -1;
    const float farthest = __builtin_sqrtf(left) + 0.5f; // of a pixel's middle
    return static_cast<int>(farthest);
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

  DiscLanes disc_;
  Ints small_, column_, row_;
  const Projection& projection_;
  const std::uint32_t* discs_;
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
      const LargeDisc disc(projection, points, point, 1.0f, band);
      const float depth_in_radii =
          disc.looksAway() ? back + projection.away_depth : back;
      const float room = disc.radius() * (depth_in_radii * projection.per_far);
      disc.forPatches([&](int row,
                          int column,
                          const Ints& covered,
                          const Floats& depth,
                          const Floats&) {
        const Floats deeper = depth + room;
        const Patch patch(band, row, column);
        alignas(64) float depths[lanes];
        store(depths, deeper);
        std::uint32_t front =
            laneBits(covered & (deeper < 1.0f) & (deeper <= patch.seenDepths(band)));
        for (; front != 0; front &= front - 1) {
          const int lane = __builtin_ctz(front);
          keepFront(band.keys[patch.pixelOf(lane)], depths[lane], point);
        }
      });
    }
  }
}

/** All sums of a pixel. */
using PixelSums = float __attribute__((vector_size(blended_values * sizeof(float))));

/** Clear the sums of a pixel's segment if it is the first one there. */
void
reachSegment(const BlendSums& blended, std::ptrdiff_t pixel)
{
  const std::ptrdiff_t segment = BlendSums::segmentOf(pixel);
  if (blended.marks[segment] != 0)
    return;
  blended.marks[segment] = 1;
  const std::ptrdiff_t first = segment * blend_segment - blend_segment / 2;
  __builtin_memset(blended.values + blended_values * first,
                   0,
                   sizeof(float) * blended_values * blend_segment);
}

/** Add weighted values to the pixels of a row of a patch that have a bit. */
void
addToRow(const BlendSums& blended,
         std::ptrdiff_t pixel,
         std::uint32_t bits,
         const float* values,
         const float* weights)
{
  if (bits == 0)
    return;
  static_assert(patch_columns <= blend_segment, "at most two segments");
  reachSegment(blended, pixel + __builtin_ctz(bits));
  reachSegment(blended, pixel + (31 - __builtin_clz(bits)));
  for (; bits != 0; bits &= bits - 1) {
    const int lane = __builtin_ctz(bits);
    float* const sums = blended.values + blended_values * (pixel + lane);
    store(sums, load<PixelSums>(sums) + load<PixelSums>(values) * weights[lane]);
  }
}

/** Bits for the pixels of a patch that are of a disc's side; and for those that look
 * away, of the same surface, and are seen nearly edge-on. */
struct SideLanes {
  std::uint32_t same, away;

  SideLanes(const std::uint8_t* first, const std::uint8_t* second, std::uint8_t side)
  {
    alignas(64) std::int32_t sides[lanes];
    for (int lane = 0; lane < patch_columns; ++lane) {
      sides[lane] = first[lane];
      sides[patch_columns + lane] = second[lane];
    }
    const Ints differences = load<Ints>(sides) ^ side;
    same = laneBits((differences & ~edge_on_bit) == 0);
    away = laneBits(differences == (looks_away_bit | edge_on_bit));
  }
};

/** Those pixels of a patch whose discs, which look away, lie behind a depth. They were
 * drawn deeper than they are. */
std::uint32_t
lanesBehind(const Projection& projection,
            const ProjectedPoints& points,
            const PixelBand& band,
            const Patch& patch,
            std::uint32_t bits,
            float depth)
{
  const float per_radius = projection.away_depth * projection.per_far;
  std::uint32_t behind = 0;
  for (; bits != 0; bits &= bits - 1) {
    const int lane = __builtin_ctz(bits);
    const PixelKey key = band.keys[patch.pixelOf(lane)];
    const float radius = points.footprints[static_cast<std::uint32_t>(key)];
    if (depthOf(key) - radius * per_radius > depth)
      behind |= 1u << lane;
  }
  return behind;
}

void
findDeepest(const PixelBand& band, float* deepest)
{
  const int cells = cellsInRow(band.width);
  for (int top = band.first_row; top < band.last_row; top += cell_rows)
    for (int cell = 0; cell < cells; ++cell) {
      Longs most{};
      for (int row = top; row < top + cell_rows && row < band.last_row; ++row)
        for (int column = 0; column < cell_columns; column += lanes / 2) {
          const Longs key = load<Longs>(band.keys + row * band.stride +
                                        (cell * cell_columns + column));
          const Longs seen = key < background_key ? key : Longs{};
          most = seen > most ? seen : most;
        }
      PixelKey last = 0;
      for (int lane = 0; lane < lanes / 2; ++lane)
        last = most[lane] > last ? most[lane] : last;
      *deepest++ = depthOf(last);
    }
}

void
blend(const Projection& projection,
      const ProjectedPoints& points,
      const std::uint32_t* looks,
      const std::uint32_t* discs,
      std::size_t count,
      const PixelBand& band,
      const float* deepest,
      const BlendSums& blended)
{
  for (std::size_t i = 0; i < count; ++i) {
    const LargeDisc disc(projection, points, discs[i], points.stretch, band);
    const float room = disc.radius() * projection.per_far;
    if (!disc.mayBeSeen(band, deepest, room))
      continue;
    Floats direction[3];
    unpackDirection(fill(static_cast<std::int32_t>(looks[2 * discs[i]])), direction);
    const Floats length =
        squareRoot(direction[0] * direction[0] + direction[1] * direction[1] +
                   direction[2] * direction[2]);
    const float side = projection.two_sided && disc.looksAway() ? -1.0f : 1.0f;
    const std::uint32_t color = looks[2 * discs[i] + 1];
    float values[blended_values] = {};
    for (int k = 0; k < 3; ++k) {
      values[k] = side * projection.outward * direction[k][0] / length[0];
      values[3 + k] = static_cast<float>((color >> (8 * k)) & 0xff);
    }
    values[6] = 1.0f;
    const std::uint8_t disc_side =
        sideOf(color, projection.has_sides && disc.looksAway());
    const float facing_room = room * projection.facing_reach;
    const float center_depth = disc.distance() * projection.per_far;
    disc.forPatches([&](int row,
                        int column,
                        const Ints& covered,
                        const Floats& depth,
                        const Floats& part) {
      const Patch patch(band, row, column);
      const Floats behind = absolute(depth - patch.seenDepths(band));
      std::uint32_t bits = laneBits(covered & (behind <= room)), facing = 0;
      if (blended.sides != nullptr) {
        const SideLanes sides(
            blended.sides + patch.first, blended.sides + patch.second, disc_side);
        bits &= sides.same;
        facing = sides.away & laneBits(covered & (behind <= facing_room));
        facing = lanesBehind(projection, points, band, patch, facing, center_depth);
        bits |= facing;
      }
      if (bits == 0)
        return;
      // Falls smoothly to zero at the rim.
      alignas(64) float weights[lanes];
      store(weights, (1.0f - part) * (1.0f - part));
      for (; facing != 0; facing &= facing - 1)
        weights[__builtin_ctz(facing)] *= projection.facing_weight;
      constexpr std::uint32_t row_bits = (1u << patch_columns) - 1;
      addToRow(blended, patch.first, bits & row_bits, values, weights);
      addToRow(blended,
               patch.second,
               bits >> patch_columns,
               values,
               weights + patch_columns);
    });
  }
}

} // namespace

extern const DiscKernels disc_kernels{draw, findDeepest, blend};

} // namespace pcl_uvol::PCL_UVOL_SIMD
