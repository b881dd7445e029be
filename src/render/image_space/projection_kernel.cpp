// SPDX-License-Identifier: BSD-3-Clause
#include "projection_kernel.h"

#include "octahedral_lanes.h"

namespace pcl_uvol::PCL_UVOL_SIMD {

namespace {

/** Beyond any pixel: what conversions to integers can take. */
constexpr float pixel_limit = 1.0e6f;

struct Vector {
  Floats x, y, z;
};

/** Up to a register of points, the last ones repeated where there are no more. */
template <typename Register, typename Element>
Register
loadSome(const Element* values, std::uint32_t count)
{
  if (count >= static_cast<std::uint32_t>(lanes))
    return load<Register>(values);
  Register loaded{};
  for (std::uint32_t lane = 0; lane < count; ++lane)
    __builtin_memcpy(
        reinterpret_cast<char*>(&loaded) + lane * sizeof(Element), values + lane, 4);
  return loaded;
}

Vector
toCamera(const Projection& p, const Vector& v)
{
  const float* const r = p.rotation;
  return {r[0] * v.x + r[1] * v.y + r[2] * v.z + p.translation[0],
          r[3] * v.x + r[4] * v.y + r[5] * v.z + p.translation[1],
          r[6] * v.x + r[7] * v.y + r[8] * v.z + p.translation[2]};
}

PixelKey
keyOf(float depth, std::uint32_t point)
{
  return static_cast<PixelKey>(
      static_cast<std::uint64_t>(bitCast<std::uint32_t>(depth)) << 32 | point);
}

float
depthOf(PixelKey key)
{
  return bitCast<float>(
      static_cast<std::uint32_t>(static_cast<std::uint64_t>(key) >> 32));
}

/** A register of points on their way into a band. */
class PointGroup {
public:
  PointGroup(const Projection& projection,
             const ProjectedPoints& points,
             std::uint32_t begin,
             std::uint32_t end,
             const PixelBand& band)
      : projection_(projection)
      , band_(band)
      , begin_(begin)
  {
    const std::uint32_t here = end - begin;
    const Vector x = {loadSome<Floats>(points.x[0] + begin, here),
                      loadSome<Floats>(points.x[1] + begin, here),
                      loadSome<Floats>(points.x[2] + begin, here)};
    unpackDirection(loadSome<Ints>(points.normals + begin, here), normal_);
    const Floats facing = normal_[0] * (projection.eye[0] - x.x) +
                          normal_[1] * (projection.eye[1] - x.y) +
                          normal_[2] * (projection.eye[2] - x.z);
    center_ = toCamera(projection, x);
    seen_ = (center_.z >= projection.near) &
            (laneNumbers() < fill(static_cast<std::int32_t>(here)));
    if (projection.cull_back_faces)
      seen_ &= facing >= 0.0f;
    per_z_ = projection.focal / center_.z;
    px_ = projection.center_x + center_.x * per_z_;
    py_ = projection.center_y + center_.y * per_z_;
    // What lies far outside reaches no pixel, and integers do not take it.
    const Ints is_near = seen_ & (px_ > -reach) & (py_ > -reach) & (px_ < pixel_limit) &
                         (py_ < pixel_limit);
    // Conversion goes towards zero: shifted, towards the lower pixel.
    column_ = toInts(is_near ? px_ + reach : Floats{}) - int(reach);
    row_ = toInts(is_near ? py_ + reach : Floats{}) - int(reach);
    is_near_ = is_near;
    length_ = squareRoot(center_.x * center_.x + center_.y * center_.y +
                         center_.z * center_.z);
    if (points.spacings != nullptr)
      radius_ =
          loadSome<Floats>(points.spacings + begin, here) * projection.footprint_radius;
  }

  /** Every point into its own pixel. */
  void
  drawPixels() const
  {
    write(is_near_, row_, column_, length_ * projection_.per_far);
  }

  /** Discs of up to five pixels in width, all points at once; returns the lanes of
   * larger ones. */
  std::uint32_t
  drawSmallDiscs() const
  {
    const Ints is_disc = seen_ & (radius_ * per_z_ > projection_.smallest_footprint);
    if (laneBits(is_disc) == 0)
      return 0;
    // How far a disc reaches in the image: see Disc.
    const Floats nearest = center_.z - radius_;
    const Floats x = center_.x / center_.z, y = center_.y / center_.z;
    const Floats slope = 1.0f + maximum(x * x, y * y);
    const Floats extent = squareRoot(slope) * projection_.focal * radius_ / nearest;
    const Ints is_small = is_disc & (nearest >= projection_.near) & (extent <= 2.0f);
    if (laneBits(is_small & is_near_) != 0) {
      const int size = laneBits(is_small & (extent > 1.0f)) != 0 ? 2 : 1;
      drawAround(is_small & is_near_, size);
    }
    return laneBits(is_disc & ~is_small);
  }

private:
  /** Pixels before the first one that small discs may lie in. */
  static constexpr float reach = 4.0f;

  void
  drawAround(const Ints& is_small, int size) const
  {
    const float* const r = projection_.rotation;
    Floats m[3];
    for (int k = 0; k < 3; ++k)
      m[k] =
          r[3 * k] * normal_[0] + r[3 * k + 1] * normal_[1] + r[3 * k + 2] * normal_[2];
    const Floats plane = m[0] * center_.x + m[1] * center_.y + m[2] * center_.z;
    const Floats sq_radius = radius_ * radius_;
    const float per_focal = 1.0f / projection_.focal;
    for (int dy = -size; dy <= size; ++dy)
      for (int dx = -size; dx <= size; ++dx) {
        // The own pixel is drawn already; corners are beyond the largest radius.
        if ((dx == 0 && dy == 0) || dx * dx + dy * dy == 8)
          continue;
        const Ints column = column_ + dx, row = row_ + dy;
        const Floats qx = (toFloats(column) + 0.5f - projection_.center_x) * per_focal;
        const Floats qy = (toFloats(row) + 0.5f - projection_.center_y) * per_focal;
        const Floats along = plane / (m[0] * qx + m[1] * qy + m[2]);
        const Floats ox = along * qx - center_.x, oy = along * qy - center_.y,
                     oz = along - center_.z;
        const Ints covered =
            is_small & (along > 0.0f) & (ox * ox + oy * oy + oz * oz <= sq_radius);
        if (laneBits(covered) == 0)
          continue;
        const Floats depth =
            along * squareRoot(qx * qx + (qy * qy + 1.0f)) * projection_.per_far;
        write(covered & (depth < 1.0f), row, column, depth);
      }
  }

  /** Keep what is in front, in pixels of the band. */
  void
  write(const Ints& wanted,
        const Ints& rows,
        const Ints& columns,
        const Floats& depths) const
  {
    const Ints inside = wanted & (columns >= 0) & (columns < fill(band_.width)) &
                        (rows >= fill(band_.first_row)) & (rows < fill(band_.last_row));
    alignas(64) float depth[lanes];
    alignas(64) std::int32_t column[lanes], row[lanes];
    store(depth, depths);
    store(column, columns);
    store(row, rows);
    for (std::uint32_t bits = laneBits(inside); bits != 0; bits &= bits - 1) {
      const int lane = __builtin_ctz(bits);
      PixelKey& pixel = band_.keys[row[lane] * band_.stride + column[lane]];
      const PixelKey key =
          keyOf(depth[lane], begin_ + static_cast<std::uint32_t>(lane));
      pixel = key < pixel ? key : pixel;
    }
  }

  const Projection& projection_;
  const PixelBand& band_;
  std::uint32_t begin_;
  Vector center_; ///< in camera space
  Floats normal_[3], per_z_, px_, py_, length_, radius_;
  Ints seen_, is_near_, column_, row_;
};

std::size_t
projectPoints(const Projection& projection,
              const ProjectedPoints& points,
              std::uint32_t begin,
              std::uint32_t end,
              const PixelBand& band,
              std::uint32_t* discs)
{
  std::size_t disc_count = 0;
  for (std::uint32_t i = begin; i < end; i += lanes) {
    const PointGroup group(projection, points, i, end, band);
    group.drawPixels();
    if (points.spacings == nullptr)
      continue;
    for (std::uint32_t bits = group.drawSmallDiscs(); bits != 0; bits &= bits - 1)
      discs[disc_count++] = i + static_cast<std::uint32_t>(__builtin_ctz(bits));
  }
  return disc_count;
}

/** A disc in camera space and the pixels that it may cover. */
class Disc {
public:
  Disc(const Projection& projection,
       const ProjectedPoints& points,
       std::uint32_t point,
       const PixelBand& band)
      : projection_(projection)
      , radius_(points.spacings[point] * projection.footprint_radius)
  {
    // The arithmetic of projectPoints, with all lanes alike.
    Floats direction[3];
    unpackDirection(fill(static_cast<std::int32_t>(points.normals[point])), direction);
    const Vector center = toCamera(
        projection,
        {fill(points.x[0][point]), fill(points.x[1][point]), fill(points.x[2][point])});
    center_[0] = center.x[0];
    center_[1] = center.y[0];
    center_[2] = center.z[0];
    float sq_length = 0.0f;
    for (int axis = 0; axis < 3; ++axis)
      sq_length += direction[axis][0] * direction[axis][0];
    const float scale = 1.0f / __builtin_sqrtf(sq_length);
    for (int axis = 0; axis < 3; ++axis)
      normal_[axis] = direction[axis][0] * scale;
    for (int row = 0; row < 3; ++row)
      axis_[row] = projection.rotation[3 * row] * normal_[0] +
                   projection.rotation[3 * row + 1] * normal_[1] +
                   projection.rotation[3 * row + 2] * normal_[2];
    plane_ = axis_[0] * center_[0] + axis_[1] * center_[1] + axis_[2] * center_[2];
    findExtent(band);
  }

  /** Call visit(row, column, depth, relative squared distance to the centre) for every
   * pixel that is covered. */
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

  /** In the directions of the points; turned to the eye if wanted. */
  float
  normal(int axis) const
  {
    return projection_.two_sided && plane_ > 0.0f ? -normal_[axis] : normal_[axis];
  }

  /** Small discs are left to the smoothing filter. */
  bool
  isBlended() const
  {
    return radius_ * projection_.focal >= projection_.smallest_blended * center_[2];
  }

  /** As a depth. */
  float
  radius() const
  {
    return radius_ * projection_.per_far;
  }

private:
  template <typename Visit>
  void
  visitLanes(const Ints& rows, const Ints& columns, const Visit& visit) const
  {
    const float per_focal = 1.0f / projection_.focal;
    const Floats qx = (toFloats(columns) + 0.5f - projection_.center_x) * per_focal;
    const Floats qy = (toFloats(rows) + 0.5f - projection_.center_y) * per_focal;
    const Floats along = plane_ / (axis_[0] * qx + axis_[1] * qy + axis_[2]);
    const Floats dx = along * qx - center_[0], dy = along * qy - center_[1],
                 dz = along - center_[2];
    const Floats part = (dx * dx + dy * dy + dz * dz) * (1.0f / (radius_ * radius_));
    const Floats depth =
        along * squareRoot(qx * qx + (qy * qy + 1.0f)) * projection_.per_far;
    const Ints covered = (along > 0.0f) & (part <= 1.0f) & (depth < 1.0f) &
                         (rows < fill(last_row_)) & (columns < fill(last_column_));
    std::uint32_t bits = laneBits(covered);
    if (bits == 0)
      return;
    alignas(64) std::int32_t row[lanes], column[lanes];
    alignas(64) float depths[lanes], parts[lanes];
    store(row, rows);
    store(column, columns);
    store(depths, depth);
    store(parts, part);
    for (; bits != 0; bits &= bits - 1) {
      const int lane = __builtin_ctz(bits);
      visit(row[lane], column[lane], depths[lane], parts[lane]);
    }
  }

  void
  findExtent(const PixelBand& band)
  {
    first_row_ = band.first_row;
    last_row_ = band.last_row;
    first_column_ = 0;
    last_column_ = band.width;
    const float nearest = center_[2] - radius_;
    if (nearest < projection_.near)
      return;
    const float per_z = projection_.focal / center_[2];
    const float px = projection_.center_x + center_[0] * per_z;
    const float py = projection_.center_y + center_[1] * per_z;
    const float hx = halfExtent(center_[0] / center_[2], nearest);
    const float hy = halfExtent(center_[1] / center_[2], nearest);
    pixelRange(px - hx, px + hx, 0, band.width, first_column_, last_column_);
    pixelRange(py - hy, py + hy, band.first_row, band.last_row, first_row_, last_row_);
  }

  /** Half of the extent in the image along one axis, in pixels. */
  float
  halfExtent(float slope, float nearest) const
  {
    return projection_.focal * radius_ * __builtin_sqrtf(1.0f + slope * slope) /
           nearest;
  }

  /** Whole pixels of a range, within bounds. */
  static void
  pixelRange(float low, float high, int least, int most, int& first, int& last)
  {
    first = low > static_cast<float>(least) ? static_cast<int>(low) : least;
    last = high < static_cast<float>(most) ? static_cast<int>(high) + 1 : most;
  }

  const Projection& projection_;
  float radius_, center_[3], normal_[3], axis_[3], plane_;
  int first_row_, last_row_, first_column_, last_column_;
};

void
drawDisc(const Projection& projection,
         const ProjectedPoints& points,
         std::uint32_t point,
         const PixelBand& band)
{
  Disc(projection, points, point, band)
      .forCovered([&](int row, int column, float depth, float) {
        PixelKey& pixel = band.keys[row * band.stride + column];
        const PixelKey key = keyOf(depth, point);
        pixel = key < pixel ? key : pixel;
      });
}

void
blendDisc(const Projection& projection,
          const ProjectedPoints& points,
          std::uint32_t point,
          std::uint32_t color,
          const PixelBand& band,
          float* blended)
{
  const Disc disc(projection, points, point, band);
  if (!disc.isBlended())
    return;
  float values[blended_values] = {};
  for (int k = 0; k < 3; ++k) {
    values[k] = disc.normal(k);
    values[3 + k] = static_cast<float>((color >> (8 * k)) & 0xff);
  }
  values[6] = 1.0f;
  disc.forCovered([&](int row, int column, float depth, float part) {
    const std::ptrdiff_t pixel = row * band.stride + column;
    if (depth > depthOf(band.keys[pixel]) + disc.radius())
      return;
    // Falls smoothly to zero at the rim.
    const float weight = (1.0f - part) * (1.0f - part);
    float* const sums = blended + blended_values * pixel;
    for (int k = 0; k < blended_values; ++k)
      sums[k] += values[k] * weight;
  });
}

} // namespace

extern const ProjectionKernels projection_kernels{projectPoints, drawDisc, blendDisc};

} // namespace pcl_uvol::PCL_UVOL_SIMD
