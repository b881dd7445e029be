// SPDX-License-Identifier: BSD-3-Clause
#include "render/image_space/disc_kernel.h"

#include "render/image_space/blend_lanes.h"
#include "render/image_space/disc_lanes.h"
#include "render/image_space/disc_sight.h"
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

void
keepFront(PixelKey& pixel, float depth, std::uint32_t point)
{
  const PixelKey key = keyOf(depth, point);
  pixel = key < pixel ? key : pixel;
}

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

/** Normals of discs, which look to the eye if surfaces have two sides, and by what they
 * change along the axes of the discs. */
class NormalLanes {
public:
  NormalLanes(const Projection& projection,
              const DiscPoints& points,
              const Floats& facing)
  {
    Floats n[3];
    unpackDirection(points.normal, n);
    const TangentLanes tangent(n);
    const BendLanes bend(points);
    const Floats away = fill(-projection.outward), towards = fill(projection.outward);
    const Floats sign =
        projection.two_sided ? (facing > 0.0f ? away : towards) : towards;
    const Floats a[] = {tangent.a.x, tangent.a.y, tangent.a.z},
                 b[] = {tangent.b.x, tangent.b.y, tangent.b.z};
    for (int k = 0; k < 3; ++k) {
      normal_[k] = sign * (n[k] * tangent.per_length);
      along_a_[k] = sign * (bend.aa * a[k] + bend.ab * b[k]);
      along_b_[k] = sign * (bend.ab * a[k] + bend.bb * b[k]);
    }
  }

  DiscValues
  valuesOf(int lane, std::uint32_t color) const
  {
    DiscValues values{};
    for (int k = 0; k < 3; ++k) {
      values.middle[k] = normal_[k][lane];
      values.middle[3 + k] = static_cast<float>((color >> (8 * k)) & 0xff);
      values.along_a[k] = along_a_[k][lane];
      values.along_b[k] = along_b_[k][lane];
    }
    values.middle[6] = 1.0f;
    return values;
  }

private:
  Floats normal_[3], along_a_[3], along_b_[3];
};

/** One disc in some pixels, side by side. */
class LargeDisc {
public:
  LargeDisc(const Projection& projection,
            const DiscLanes& group,
            int lane,
            const PixelRange& range)
      : disc_(group.lane(lane))
      , bent_(projection, disc_)
      , is_bent_(disc_.bentLanes() != 0)
      , projection_(projection)
      , range_(range)
  {
  }

  /** Call visit(row, column, covered lanes, depths, place) for every patch with a pixel
   * that is covered; row and column of its first pixel. */
  template <typename Visit>
  void
  forPatches(const Visit& visit) const
  {
    for (int top = range_.first_row; top < range_.last_row; top += 2 * lanes) {
      const RowSpans spans(*this, top);
      for (int pair = 0; pair < lanes && top + 2 * pair < range_.last_row; ++pair)
        for (int column = spans.first[pair]; column < spans.last[pair];
             column += patch_columns)
          visitPatch(top + 2 * pair, column, spans.last[pair], visit);
    }
  }

  float
  radius() const
  {
    return disc_.radius[0];
  }

  float
  distance() const
  {
    return disc_.distance()[0];
  }

  bool
  looksAway() const
  {
    return disc_.facing[0] > 0.0f;
  }

private:
  /** The columns of pairs of rows that the circle reaches. */
  struct RowSpans {
    alignas(64) std::int32_t first[lanes], last[lanes];

    RowSpans(const LargeDisc& disc, int top)
    {
      const PixelRange& range = disc.range_;
      const Floats &px = disc.disc_.px, &py = disc.disc_.py;
      const Floats middle = toFloats(2 * laneNumbers() + top) + 0.5f;
      const Floats rows = maximum(maximum(middle - py, py - (middle + 1.0f)), Floats{});
      const Floats columns =
          squareRoot(maximum(range.circle * range.circle - rows * rows, Floats{})) +
          (0.5f + pixel_room);
      const float left = static_cast<float>(range.first_column),
                  right = static_cast<float>(range.last_column);
      store(first, toInts(clampTo(px - columns + 1.0f, left, right)));
      store(last, toInts(clampTo(px + columns, left, right)));
    }

    static Floats
    clampTo(const Floats& x, float low, float high)
    {
      return minimum(maximum(x, fill(low)), fill(high));
    }
  };

  template <typename Visit>
  void
  visitPatch(int row, int column, int last_column, const Visit& visit) const
  {
    const Ints lane = laneNumbers();
    const Ints rows = row - (lane >= patch_columns); // a true one is -1
    const Ints columns = column + (lane & (patch_columns - 1));
    const Floats ex = toFloats(columns) + 0.5f - disc_.px,
                 ey = toFloats(rows) + 0.5f - disc_.py;
    const BentPlace place = is_bent_ ? bent_.at(ex, ey) : bent_.atFlat(ex, ey);
    const Ints inside =
        place.covered & (rows < fill(range_.last_row)) & (columns < fill(last_column));
    if (laneBits(inside) == 0)
      return;
    const Floats qx = slopeOf(columns, projection_.center_x, projection_.focal);
    const Floats qy = slopeOf(rows, projection_.center_y, projection_.focal);
    const Floats depth = depthAt(projection_, disc_, place, qx, qy);
    visit(row, column, inside & (depth < 1.0f), depth, place);
  }

  DiscLanes disc_;
  BentDisc bent_;
  bool is_bent_;
  const Projection& projection_;
  PixelRange range_;
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
      : disc_(projection, DiscPoints(points, discs, count), 1.0f)
      , rim_(points, discs, count)
      , projection_(projection)
      , discs_(discs)
  {
    const BallExtents ball(projection, disc_.center, disc_.radius);
    const Floats extent = maximum(ball.x, ball.y);
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
    const DiscExtents extents(projection, disc_);
    reach_ = largest(small_ ? extent : Floats{});
    reach_x_ = largest(small_ ? extents.x : Floats{});
    reach_y_ = largest(small_ ? extents.y : Floats{});
  }

  /** Lanes of discs that are too large to be drawn side by side. */
  std::uint32_t
  largeLanes() const
  {
    return large_;
  }

  const DiscLanes&
  discs() const
  {
    return disc_;
  }

  const RimLanes&
  rims() const
  {
    return rim_;
  }

  void
  drawSmall(float back, const PixelBand& band) const
  {
    const std::uint32_t small = laneBits(small_);
    const BentDisc bent(projection_, disc_);
    if ((small & rim_.lanesWithLines()) != 0)
      drawPlaces(back, band, [&](const Floats& ex, const Floats& ey) {
        BentPlace place = bent.at(ex, ey);
        place.covered &= rim_.areInside(place.a, place.b);
        return place;
      });
    else if ((small & disc_.bentLanes()) != 0)
      drawPlaces(back, band, [&](const Floats& ex, const Floats& ey) {
        return bent.at(ex, ey);
      });
    else if (small != 0)
      drawPlaces(back, band, [&](const Floats& ex, const Floats& ey) {
        return bent.atFlat(ex, ey);
      });
  }

private:
  template <typename PlaceAt>
  void
  drawPlaces(float back, const PixelBand& band, const PlaceAt& place_at) const
  {
    const Floats depth_in_radii =
        disc_.facing > 0.0f ? fill(back + projection_.away_depth) : fill(back);
    const Floats behind = disc_.radius * (depth_in_radii * projection_.per_far);
    const Ints places =
        (row_ - band.first_row) * static_cast<int>(band.stride) + column_;
    const Floats x = toFloats(column_) + 0.5f - disc_.px,
                 y = toFloats(row_) + 0.5f - disc_.py;
    const float farthest = reach_y_ + 0.5f; // of a pixel's middle, rounded down
    const int rows = static_cast<int>(farthest);
    for (int dy = -rows; dy <= rows; ++dy) {
      const Ints row = row_ + dy;
      const Ints in_band =
          small_ & (row >= fill(band.first_row)) & (row < fill(band.last_row));
      const Floats ey = y + static_cast<float>(dy);
      const Floats qy = slopeOf(row, projection_.center_y, projection_.focal);
      const int columns = columnsAt(dy);
      for (int dx = -columns; dx <= columns; ++dx) {
        const Floats ex = x + static_cast<float>(dx);
        const Ints column = column_ + dx;
        const BentPlace place = place_at(ex, ey);
        const Ints covered =
            in_band & place.covered & (column >= 0) & (column < fill(band.width));
        if (laneBits(covered) == 0)
          continue;
        const Floats qx = slopeOf(column, projection_.center_x, projection_.focal);
        const Floats depth = depthAt(projection_, disc_, place, qx, qy) + behind;
        keepLanes(laneBits(covered & (depth < 1.0f)),
                  depth,
                  places + (dy * static_cast<int>(band.stride) + dx),
                  band);
      }
    }
  }

  /** How many columns beside their centres' discs can reach so many rows away. */
  int
  columnsAt(int dy) const
  {
    const float rows = dy == 0 ? 0.0f : static_cast<float>(dy < 0 ? -dy : dy) - 0.5f;
    const float left = reach_ * reach_ - rows * rows;
    if (left < 0.0f)
      return -1;
    const float in_circle = __builtin_sqrtf(left);
    const float farthest =
        (in_circle < reach_x_ ? in_circle : reach_x_) + 0.5f; // of a pixel's middle
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
  RimLanes rim_;
  Ints small_, column_, row_;
  const Projection& projection_;
  const std::uint32_t* discs_;
  float reach_, reach_x_, reach_y_; ///< of the small ones, in pixels
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
    const DiscReach reach(projection, group.discs());
    for (std::uint32_t bits = group.largeLanes(); bits != 0; bits &= bits - 1) {
      const int lane_of_disc = __builtin_ctz(bits);
      const std::uint32_t point = discs[i + static_cast<std::size_t>(lane_of_disc)];
      const LargeDisc disc(
          projection, group.discs(), lane_of_disc, reach.rangeOf(lane_of_disc, band));
      const bool has_rim = (group.rims().lanesWithLines() >> lane_of_disc & 1) != 0;
      const float depth_in_radii =
          disc.looksAway() ? back + projection.away_depth : back;
      const float room = disc.radius() * (depth_in_radii * projection.per_far);
      disc.forPatches([&](int row,
                          int column,
                          const Ints& covered,
                          const Floats& depth,
                          const BentPlace& place) {
        const Floats deeper = depth + room;
        const Patch patch(band, row, column);
        alignas(64) float depths[lanes];
        store(depths, deeper);
        std::uint32_t front =
            laneBits(covered & (deeper < 1.0f) & (deeper <= patch.seenDepths(band)));
        if (has_rim && front != 0)
          front &= laneBits(group.rims().areInside(place.a, place.b, lane_of_disc));
        for (; front != 0; front &= front - 1) {
          const int lane = __builtin_ctz(front);
          keepFront(band.keys[patch.pixelOf(lane)], depths[lane], point);
        }
      });
    }
  }
}

/** Bits for the pixels of a patch that are of a disc's side; and for those that look
 * away, of the same surface, and are seen nearly edge-on. */
struct SideLanes {
  std::uint32_t same, away;

  SideLanes(const std::uint8_t* first, const std::uint8_t* second, std::uint8_t side)
  {
    const Ints differences = loadBytes(first, second) ^ side;
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
findDeepest(const PixelBand& band, PixelKey beyond, float* deepest)
{
  const int cells = cellsInRow(band.width);
  for (int top = band.first_row; top < band.last_row; top += cell_rows)
    for (int cell = 0; cell < cells; ++cell) {
      Longs most{};
      for (int row = top; row < top + cell_rows && row < band.last_row; ++row)
        for (int column = 0; column < cell_columns; column += lanes / 2) {
          const Longs key = load<Longs>(band.keys + row * band.stride +
                                        (cell * cell_columns + column));
          const Longs seen = key < beyond ? key : Longs{};
          most = seen > most ? seen : most;
        }
      PixelKey last = 0;
      for (int lane = 0; lane < lanes / 2; ++lane)
        last = most[lane] > last ? most[lane] : last;
      *deepest++ = depthOf(last);
    }
}

/** Add one disc to the pixels that it covers. */
void
blendDisc(const Projection& projection,
          const ProjectedPoints& points,
          const LargeDisc& disc,
          const DiscValues& values,
          std::uint8_t side,
          const PixelBand& band,
          const BlendSums& blended)
{
  const float room = disc.radius() * projection.per_far;
  const float facing_room = room * projection.facing_reach;
  const float center_depth = disc.distance() * projection.per_far;
  const float per_square = 1.0f / (disc.radius() * disc.radius());
  const PixelAdder adder(values);
  disc.forPatches([&](int row,
                      int column,
                      const Ints& covered,
                      const Floats& depth,
                      const BentPlace& place) {
    const Patch patch(band, row, column);
    const Floats behind = absolute(depth - patch.seenDepths(band));
    std::uint32_t bits = laneBits(covered & (behind <= room)), facing = 0;
    if (blended.sides != nullptr) {
      const SideLanes sides(
          blended.sides + patch.first, blended.sides + patch.second, side);
      bits &= sides.same;
      facing = sides.away & laneBits(covered & (behind <= facing_room));
      facing = lanesBehind(projection, points, band, patch, facing, center_depth);
      bits |= facing;
    }
    if (bits == 0)
      return;
    // Falls smoothly to zero at the rim.
    const Floats rest = 1.0f - place.square() * per_square;
    DiscPlaces places{place.a, place.b, rest * rest};
    for (; facing != 0; facing &= facing - 1)
      places.weights[__builtin_ctz(facing)] *= projection.facing_weight;
    constexpr std::uint32_t row_bits = (1u << patch_columns) - 1;
    const std::uint32_t first = bits & row_bits, second = bits >> patch_columns;
    reachSegments(blended, patch.first, first);
    reachSegments(blended, patch.second, second);
    adder.add(blended, patch.first, 0, first, places);
    adder.add(blended, patch.second, patch_columns, second, places);
  });
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
  for (std::size_t i = 0; i < count; i += static_cast<std::size_t>(lanes)) {
    const int here = count - i < lanes ? static_cast<int>(count - i) : lanes;
    const DiscPoints group(points, discs + i, here);
    const DiscLanes in_view(projection, group, points.stretch);
    const DiscReach reach(projection, in_view);
    const SightTest sight(projection, in_view);
    const NormalLanes normals(projection, group, in_view.facing);
    for (int lane = 0; lane < here; ++lane) {
      const PixelRange range = reach.rangeOf(lane, band);
      if (!sight.maySee(lane, range, band, deepest))
        continue;
      const LargeDisc disc(projection, in_view, lane, range);
      const std::uint32_t color =
          looks[2 * discs[i + static_cast<std::size_t>(lane)] + 1];
      blendDisc(projection,
                points,
                disc,
                normals.valuesOf(lane, color),
                sideOf(color, projection.has_sides && disc.looksAway()),
                band,
                blended);
    }
  }
}

} // namespace

extern const DiscKernels disc_kernels{draw, findDeepest, blend};

} // namespace pcl_uvol::PCL_UVOL_SIMD
