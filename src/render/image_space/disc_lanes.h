// SPDX-License-Identifier: BSD-3-Clause
// For vector kernels: discs in camera space, and where rays meet the bent surface about
// them.
#pragma once

#include "render/image_space/camera_lanes.h"
#include "surface/bend_scale.h"
#include "surface/rim_scale.h"

namespace pcl_uvol::PCL_UVOL_SIMD {

/** What is known of up to a register of discs. */
struct DiscPoints {
  Vector position;
  Ints normal, bend; ///< packed
  Floats radius, footprint;

  DiscPoints(const ProjectedPoints& points, const std::uint32_t* discs, int count)
  {
    alignas(64) float x[3][lanes], radii[lanes], footprints[lanes];
    alignas(64) std::int32_t normals[lanes], bends[lanes];
    for (int lane = 0; lane < lanes; ++lane) {
      const std::uint32_t disc = discs[lane < count ? lane : 0];
      for (int axis = 0; axis < 3; ++axis)
        x[axis][lane] = points.x[axis][disc];
      normals[lane] = static_cast<std::int32_t>(points.normals[disc]);
      bends[lane] = static_cast<std::int32_t>(points.bends[disc]);
      radii[lane] = points.radii[disc];
      footprints[lane] = points.footprints[disc];
    }
    position = {load<Floats>(x[0]), load<Floats>(x[1]), load<Floats>(x[2])};
    normal = load<Ints>(normals);
    bend = load<Ints>(bends);
    radius = load<Floats>(radii);
    footprint = load<Floats>(footprints);
  }
};

/** Two axes of the plane that a normal stands on, as tangentAxes() has them, and the
 * inverse length of what unpackDirection() gives. */
struct TangentLanes {
  Vector a, b;
  Floats per_length;

  explicit TangentLanes(const Floats* direction)
      : per_length(1.0f / squareRoot(direction[0] * direction[0] +
                                     direction[1] * direction[1] +
                                     direction[2] * direction[2]))
  {
    const Floats x = direction[0] * per_length, y = direction[1] * per_length,
                 z = direction[2] * per_length;
    const Floats sign = z < 0.0f ? fill(-1.0f) : fill(1.0f);
    const Floats p = -(1.0f / (sign + z)), q = x * y * p;
    a = {1.0f + sign * (x * x * p), sign * q, -(sign * x)};
    b = {q, sign + y * y * p, -y};
  }
};

/** How surfaces bend, in the axes of TangentLanes. */
struct BendLanes {
  Floats aa, ab, bb;

  explicit BendLanes(const DiscPoints& points)
  {
    const Floats per_radius = 1.0f / (packed_bend_scale * points.footprint);
    aa = toFloats((points.bend << 22) >> 22) * per_radius;
    ab = toFloats((points.bend << 12) >> 22) * per_radius;
    bb = toFloats((points.bend << 2) >> 22) * per_radius;
  }
};

/** Lines at which up to a register of discs end at the rim of a surface, in the axes of
 * TangentLanes. */
class RimLanes {
public:
  RimLanes(const ProjectedPoints& points, const std::uint32_t* discs, int count)
  {
    alignas(64) std::int32_t rims[lanes];
    alignas(64) float footprints[lanes];
    for (int lane = 0; lane < lanes; ++lane) {
      const std::uint32_t disc = discs[lane < count ? lane : 0];
      rims[lane] = static_cast<std::int32_t>(points.rims[disc]);
      footprints[lane] = points.footprints[disc];
    }
    packed_ = load<Ints>(rims);
    if (lanesWithLines() != 0)
      for (int k = 0; k < 2; ++k)
        lines_[k] = Line(packed_ >> (16 * k), load<Floats>(footprints));
  }

  /** Lanes of discs that end at a line. */
  std::uint32_t
  lanesWithLines() const
  {
    return laneBits(packed_ != 0);
  }

  /** Lanes whose place, in the axes of the disc, lies on this side of its lines. */
  Ints
  areInside(const Floats& a, const Floats& b) const
  {
    return lines_[0].isInside(a, b) & lines_[1].isInside(a, b);
  }

  /** The same for the disc of one lane. */
  Ints
  areInside(const Floats& a, const Floats& b, int lane) const
  {
    return lines_[0].lane(lane).isInside(a, b) & lines_[1].lane(lane).isInside(a, b);
  }

private:
  struct Line {
    Floats a, b, reach;

    Line() = default;

    Line(const Ints& packed, const Floats& footprint)
    {
      const Ints depth = packed & (rim_depth_steps - 1);
      const Ints direction = packed >> rim_depth_bits;
      a = towardsCorner(direction);
      b = towardsCorner(direction - rim_directions / 4);
      const Floats part = toFloats(rim_depth_steps - depth) * (1.0f / rim_depth_steps);
      // Rounding must not move the outline where there is no line.
      reach = depth == 0 ? fill(__builtin_inff())
                         : footprint * part * squareRoot(a * a + b * b);
    }

    /** Along the axis of a corner of the square, of a place so many steps from it. */
    static Floats
    towardsCorner(const Ints& steps)
    {
      constexpr int half = rim_directions / 2, quarter = half / 2;
      const Ints from_opposite = (steps & (rim_directions - 1)) - half;
      return toFloats(from_opposite < 0 ? -from_opposite : from_opposite) -
             static_cast<float>(quarter);
    }

    Line
    lane(int index) const
    {
      Line one;
      one.a = fill(a[index]);
      one.b = fill(b[index]);
      one.reach = fill(reach[index]);
      return one;
    }

    Ints
    isInside(const Floats& x, const Floats& y) const
    {
      return a * x + b * y <= reach;
    }
  };

  Ints packed_;
  Line lines_[2];
};

/** How far balls reach in the image, in pixels, along the axis of a slope of their
 * centres. */
inline Floats
extentOf(const Projection& projection,
         const Floats& center_z,
         const Floats& radius,
         const Floats& slope)
{
  return projection.focal * radius * squareRoot(1.0f + slope * slope) /
         (center_z - radius);
}

/** Of camera space to the eye. */
inline Floats
distanceOf(const Vector& v)
{
  return squareRoot(v.x * v.x + v.y * v.y + v.z * v.z);
}

/** Discs, or one disc in all lanes, in camera space. */
struct DiscLanes {
  Vector center;
  Floats radius;
  Floats facing;         ///< positive: seen from behind
  Floats tilt_x, tilt_y; ///< relative change of 1 / z along the image, per pixel
  Floats px, py;         ///< the centre in the image, pixels
  Vector a, b;           ///< axes of the disc
  Floats saa, sab, sbb;  ///< in these: how its surface bends, 0 where no pixel shows it
  Floats towards;        ///< inverse of the centre's distance along the normal

  /** \param stretch how many of their radii they reach */
  DiscLanes(const Projection& projection, const DiscPoints& point, float stretch)
      : center(toCamera(projection, point.position))
  {
    const Floats per_length = pixelsPerLength(projection, center);
    const Floats unstretched =
        discRadius(projection, point.radius, point.footprint, per_length);
    radius = stretch * unstretched;
    px = projection.center_x + center.x * per_length;
    py = projection.center_y + center.y * per_length;
    Floats n[3];
    unpackDirection(point.normal, n);
    const TangentLanes tangent(n);
    a = rotate(projection, tangent.a);
    b = rotate(projection, tangent.b);
    const Vector axis = rotate(projection, {n[0], n[1], n[2]});
    const Floats along = dot(axis, center);
    facing = projection.outward * along;
    // Infinite where a disc is seen edge-on, so that no pixel is covered.
    const Floats per_along = 1.0f / along;
    tilt_x = axis.x * (pixelSize(projection) * per_along);
    tilt_y = axis.y * (pixelSize(projection) * per_along);
    towards = per_along * (1.0f / tangent.per_length);
    const BendLanes bend(point);
    const Floats turn =
        (maximum(absolute(bend.aa), absolute(bend.bb)) + absolute(bend.ab)) *
        unstretched;
    const Floats steepness = dot(center, center) * (towards * towards) - 1.0f;
    const Ints is_bent =
        (turn * (unstretched * per_length) > projection.smallest_bend) &
        (turn * turn * steepness > projection.smallest_turn);
    saa = is_bent ? bend.aa : Floats{};
    sab = is_bent ? bend.ab : Floats{};
    sbb = is_bent ? bend.bb : Floats{};
  }

  /** One of them in all lanes. */
  DiscLanes
  lane(int index) const
  {
    const auto at = [index](const Floats& part) { return fill(part[index]); };
    const auto vectorAt = [&](const Vector& v) {
      return Vector{at(v.x), at(v.y), at(v.z)};
    };
    DiscLanes one;
    one.center = vectorAt(center);
    one.radius = at(radius);
    one.facing = at(facing);
    one.tilt_x = at(tilt_x);
    one.tilt_y = at(tilt_y);
    one.px = at(px);
    one.py = at(py);
    one.a = vectorAt(a);
    one.b = vectorAt(b);
    one.saa = at(saa);
    one.sab = at(sab);
    one.sbb = at(sbb);
    one.towards = at(towards);
    return one;
  }

  /** Lanes whose surface bends away from the disc. */
  std::uint32_t
  bentLanes() const
  {
    return laneBits((saa != 0.0f) | (sab != 0.0f) | (sbb != 0.0f));
  }

  /** Of the centres to the eye. */
  Floats
  distance() const
  {
    return distanceOf(center);
  }

  /** Side of a pixel in the centres. */
  Floats
  pixelSize(const Projection& projection) const
  {
    return center.z * (1.0f / projection.focal);
  }

private:
  DiscLanes() = default;
};

/** Where a ray meets the surface about a disc. */
struct BentPlace {
  Floats per_toward; ///< z in the disc's plane, as a part of that in the centre
  Floats a, b;       ///< in the axes of the disc
  Floats sunk;       ///< below its plane
  Ints covered;

  Floats
  square() const
  {
    return a * a + b * b + sunk * sunk;
  }
};

/** The surface about discs, which bends away from them as a paraboloid does. At an
 * outline it ends where it turns away from the eye, while a flat disc goes on. */
class BentDisc {
  // With e the way in pixels from the projected centre, s their size in the centre c, t
  // the tilt: rays meet the plane of the disc where z is c.z / T, T = 1 + t.e, in the
  // place q = (s e - (t.e) c) / T, whose numerator vanishes in the centre. With n the
  // normal, v = ((a, b).c + q) / n.c goes along the plane towards the eye. The ray
  // meets the paraboloid of the bend S in w with q = w + v S(w, w) / 2: a quadratic
  // equation.
public:
  /** \param disc must outlive it */
  BentDisc(const Projection& projection, const DiscLanes& disc)
      : disc_(disc)
  {
    const Floats size = disc.pixelSize(projection);
    const Floats ca = dot(disc.a, disc.center), cb = dot(disc.b, disc.center);
    ax_ = size * disc.a.x - disc.tilt_x * ca;
    ay_ = size * disc.a.y - disc.tilt_y * ca;
    bx_ = size * disc.b.x - disc.tilt_x * cb;
    by_ = size * disc.b.y - disc.tilt_y * cb;
    va_ = ca * disc.towards;
    vb_ = cb * disc.towards;
  }

  BentPlace
  at(const Floats& ex, const Floats& ey) const
  {
    BentPlace place = inPlane(ex, ey);
    const Floats &saa = disc_.saa, &sab = disc_.sab, &sbb = disc_.sbb;
    const Floats &a = place.a, &b = place.b;
    const Floats va = va_ + a * disc_.towards, vb = vb_ + b * disc_.towards;
    const Floats turn_a = saa * va + sab * vb, turn_b = sab * va + sbb * vb;
    const Floats ahead = 1.0f + (turn_a * a + turn_b * b);
    const Floats bend = (saa * a + 2.0f * (sab * b)) * a + sbb * b * b;
    const Floats square = ahead * ahead - (va * turn_a + vb * turn_b) * bend;
    const Floats sum = ahead + squareRoot(maximum(square, Floats{}));
    place.sunk = bend * (1.0f / sum);
    place.a = a - va * place.sunk;
    place.b = b - vb * place.sunk;
    place.covered &= (sum > 0.0f) & (square >= 0.0f) & isInside(place);
    return place;
  }

  /** The same for a disc that does not bend. */
  BentPlace
  atFlat(const Floats& ex, const Floats& ey) const
  {
    BentPlace place = inPlane(ex, ey);
    place.covered &= isInside(place);
    return place;
  }

private:
  BentPlace
  inPlane(const Floats& ex, const Floats& ey) const
  {
    const Floats toward = (1.0f + disc_.tilt_y * ey) + disc_.tilt_x * ex;
    const Floats per_toward = 1.0f / toward;
    return {per_toward,
            (ax_ * ex + ay_ * ey) * per_toward,
            (bx_ * ex + by_ * ey) * per_toward,
            Floats{},
            toward > 0.0f};
  }

  Ints
  isInside(const BentPlace& place) const
  {
    return place.square() <= disc_.radius * disc_.radius;
  }

  const DiscLanes& disc_;
  Floats ax_, ay_, bx_, by_; ///< change of the numerator of q, in the axes of the disc
  Floats va_, vb_;           ///< v in the centre
};

/** \param qx and qy: a ray as (qx, qy, 1) that meets a disc */
inline Floats
depthAt(const Projection& projection,
        const DiscLanes& disc,
        const BentPlace& place,
        const Floats& qx,
        const Floats& qy)
{
  const Floats length = squareRoot(qx * qx + (qy * qy + 1.0f));
  const Floats z =
      disc.center.z * (place.per_toward * (1.0f - place.sunk * disc.towards));
  return z * length * projection.per_far;
}

} // namespace pcl_uvol::PCL_UVOL_SIMD
