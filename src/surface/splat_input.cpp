// SPDX-License-Identifier: BSD-3-Clause
#include "surface/splat_input.h"

#include "common/scalar_field.h"
#include "neighbors/nearest_finder.h"
#include "surface/oriented_points.h"
#include "surface/packed_normal.h"
#include "surface/splat_fields.h"
#include "surface/usual_extent.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

namespace pcl_uvol {

namespace {

/** In parts of the usual diagonal of the points: somewhat more than half a pixel of a
 * picture of 1000 of them. */
constexpr float dot_radius = 7e-4f;

/** Those that rays can meet: splats are generated in any unit, and drawn in that of the
 * input. */
Splats
takeDrawable(Splats&& splats, Report& report)
{
  Splats drawable;
  drawable.two_sided = splats.two_sided;
  for (std::size_t i = 0; i < splats.cloud.size(); ++i)
    if (isDrawable(splats.cloud[i])) {
      drawable.cloud.push_back(splats.cloud[i]);
      drawable.sources.push_back(splats.sources[i]);
      if (!splats.rims.empty())
        drawable.rims.push_back(splats.rims[i]);
    }
  warnOfBadSplats(splats.cloud.size(), drawable, report);
  return drawable;
}

float
findDotRadius(const CloudView& cloud)
{
  std::vector<Position> places;
  for (std::size_t i = 0; i < cloud.count; ++i)
    if (const Eigen::Map<const Eigen::Vector3f> place(cloud.xyz(i)); place.allFinite())
      places.push_back(toPosition(place));
  const auto sides = findUsualSides(places);
  const Eigen::Vector3d diagonal(sides.data());
  return dot_radius * diagonal.cast<float>().norm();
}

/** A disc that a picture shows as a point.
 * \param radius of it */
PointSplat
makeDot(const CloudView& cloud,
        const OrientedPoints& points,
        std::size_t sample,
        float radius)
{
  PointSplat dot;
  const std::uint32_t index = points.samples->getInputIndex(sample);
  dot.getVector3fMap() = Eigen::Map<const Eigen::Vector3f>(cloud.xyz(index));
  float normal[3];
  unpackNormal(points.normals[sample], normal);
  dot.getNormalVector3fMap() = Eigen::Map<const Eigen::Vector3f>(normal).normalized();
  dot.getTangentVector3fMap() = dot.getNormalVector3fMap().unitOrthogonal();
  dot.radius = radius;
  return dot;
}

bool
isCovering(const PointSplat& splat, const Eigen::Vector3f& place)
{
  const Eigen::Vector3f offset = place - splat.getVector3fMap();
  const float height = offset.dot(splat.getNormalVector3fMap());
  return offset.squaredNorm() <= splat.radius * splat.radius &&
         std::abs(height) <= 0.5f * splat.radius;
}

/** Whether one of the splats whose centres are nearest to a dot covers it. */
bool
isCovered(const PointSplat& dot,
          const Splats& splats,
          const SampleSet& centers,
          NearestFinder& finder)
{
  const auto factor = static_cast<float>(centers.getUnit().factor);
  const NearestFinder::Row row =
      finder.find(Position{{dot.x * factor, dot.y * factor, dot.z * factor}},
                  std::max(dot.radius * factor, std::numeric_limits<float>::min()));
  return std::any_of(row.samples, row.samples + row.size, [&](std::uint32_t sample) {
    return isCovering(splats.cloud[centers.getInputIndex(sample)],
                      dot.getVector3fMap());
  });
}

/** Splats, and behind them the dots that lie beside all of these: where the surface
 * around is covered a single isopoint in a gap tells nothing. */
Splats
withDots(Splats&& splats, const Splats& dots, unsigned threads)
{
  constexpr std::size_t looked_at = 16;
  SampleSet::ConstPtr centers;
  std::optional<NearestFinder> finder;
  if (!splats.cloud.empty()) {
    std::vector<std::uint32_t> all(splats.cloud.size());
    std::iota(all.begin(), all.end(), 0u);
    Report own;
    centers = SampleSet::build(&splats.cloud[0].x,
                               sizeof(PointSplat) / sizeof(float),
                               all,
                               Position{{1.0f, 1.0f, 1.0f}},
                               threads,
                               own);
    finder.emplace(*centers, looked_at);
  }
  Splats joined = std::move(splats);
  for (std::size_t i = 0; i < dots.cloud.size(); ++i) {
    if (finder && isCovered(dots.cloud[i], joined, *centers, *finder))
      continue;
    joined.cloud.push_back(dots.cloud[i]);
    joined.sources.push_back(dots.sources[i]);
  }
  if (!joined.rims.empty())
    joined.rims.resize(joined.cloud.size(), 0);
  return joined;
}

/** Splats for points to be drawn: isopoints in gaps of the sampling become dots, and
 * specks of noise no more than that. */
Splats
coverForPicture(const CloudView& cloud,
                const SplatParameters& parameters,
                unsigned threads,
                Report& report)
{
  const std::vector<std::uint8_t> bridged = findBridged(cloud);
  std::vector<std::uint32_t> covered, dots;
  for (std::uint32_t i = 0; i < cloud.count; ++i)
    (bridged.empty() || !bridged[i] ? covered : dots).push_back(i);
  const float radius = findDotRadius(cloud);
  Splats splats;
  if (!covered.empty() || dots.empty())
    splats =
        detail::generateSplats(cloud, covered, parameters, radius, threads, report);
  if (dots.empty())
    return splats;
  Report own; // the points are counted with the others
  const OrientedPoints points = orientPoints(cloud, dots, threads, own);
  Splats small;
  for (std::size_t i = 0; i < points.normals.size(); ++i) {
    small.cloud.push_back(makeDot(cloud, points, i, radius));
    small.sources.push_back(points.samples->getInputIndex(i));
  }
  report.count("bridged", dots.size());
  return withDots(std::move(splats), small, threads);
}

/** Splats of a cloud to be drawn: those of isopoints in gaps become dots, as without
 * splats. */
Splats
readForPicture(const CloudView& cloud, unsigned threads, Report& report)
{
  Splats splats = readSplats(cloud, report);
  const std::vector<std::uint8_t> bridged = findBridged(cloud);
  if (bridged.empty())
    return splats;
  const float radius = findDotRadius(cloud);
  Splats covering, dots;
  for (std::size_t i = 0; i < splats.cloud.size(); ++i) {
    const bool is_dot = bridged[splats.sources[i]] != 0;
    PointSplat splat = splats.cloud[i];
    if (is_dot) {
      splat.radius = radius;
      splat.error = splat.tilt_u = splat.tilt_v = splat.slope_u = splat.slope_v = 0.0f;
    }
    (is_dot ? dots : covering).cloud.push_back(splat);
    (is_dot ? dots : covering).sources.push_back(splats.sources[i]);
  }
  report.count("bridged", dots.cloud.size());
  return withDots(std::move(covering), dots, threads);
}

} // namespace

void
warnOfBadSplats(std::size_t count, const Splats& splats, Report& report)
{
  const std::size_t bad = count - splats.cloud.size();
  if (bad == 0)
    return;
  report.setCount("bad_splats", bad);
  report.warn("bad_splats",
              {{"bad", bad}, {"splats", count}, {"reach", most_splat_reach}});
}

bool
hasSplats(const CloudView& cloud)
{
  return std::all_of(splat_fields.begin(), splat_fields.end(), [&](const char* name) {
    return findField(cloud.fields, name) != nullptr;
  });
}

bool
isDrawable(const PointSplat& splat)
{
  const auto is_within = [](float value) {
    return std::abs(value) <= most_splat_reach;
  };
  return splat.getVector3fMap().unaryExpr(is_within).all() &&
         splat.getNormalVector3fMap().allFinite() &&
         !splat.getNormalVector3fMap().isZero(0.0f) &&
         splat.radius >= least_splat_radius && is_within(splat.radius);
}

Splats
readSplats(const CloudView& cloud, Report& report)
{
  std::vector<ScalarField> fields;
  fields.reserve(splat_fields.size());
  for (const char* name : splat_fields)
    fields.emplace_back(cloud.fields, name);
  Splats splats;
  for (std::uint32_t i = 0; i < cloud.count; ++i) {
    std::array<float, splat_fields.size()> v;
    for (std::size_t f = 0; f < fields.size(); ++f)
      v[f] = static_cast<float>(fields[f].read(cloud.point(i)));
    PointSplat splat;
    splat.getVector3fMap() = Eigen::Map<const Eigen::Vector3f>(&v[0]);
    splat.getNormalVector3fMap() =
        Eigen::Map<const Eigen::Vector3f>(&v[3]).stableNormalized();
    splat.getTangentVector3fMap() =
        Eigen::Map<const Eigen::Vector3f>(&v[6]).stableNormalized();
    splat.radius = v[9];
    splat.error = v[10];
    splat.tilt_u = v[11];
    splat.tilt_v = v[12];
    splat.slope_u = v[13];
    splat.slope_v = v[14];
    // Perpendicular to the normal, as the fields of normals take it for.
    splat.getTangentVector3fMap() =
        (splat.getTangentVector3fMap() -
         splat.getTangentVector3fMap().dot(splat.getNormalVector3fMap()) *
             splat.getNormalVector3fMap())
            .stableNormalized();
    const bool is_finite = std::all_of(
        v.begin(), v.end(), [](float value) { return std::isfinite(value); });
    if (!is_finite || !isDrawable(splat) || splat.getTangentVector3fMap().isZero())
      continue;
    splats.cloud.push_back(splat);
    splats.sources.push_back(i);
  }
  report.count("splats", splats.cloud.size());
  report.count("bad_splats", 0);
  warnOfBadSplats(cloud.count, splats, report);
  return splats;
}

Splats
findSplats(const CloudView& cloud,
           const SplatParameters& parameters,
           bool is_asked_for,
           unsigned threads,
           Report& report)
{
  if (!hasSplats(cloud))
    return takeDrawable(coverForPicture(cloud, parameters, threads, report), report);
  if (is_asked_for)
    report.warn("ready_splats");
  return readForPicture(cloud, threads, report);
}

} // namespace pcl_uvol
