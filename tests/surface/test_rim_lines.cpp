// SPDX-License-Identifier: BSD-3-Clause
// Where discs end at the rims of surfaces that are known.
#include "support/surfaces.h"
#include "surface/footprints.h"
#include <pcl_uvol/common/point_types.h>
#include <pcl_uvol/surface/splat_generation.h>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>
#include <random>

namespace test_rim_lines {

using namespace pcl_uvol;
using Eigen::Vector2f;
using Eigen::Vector3f;
using Cloud = pcl::PointCloud<pcl::PointNormal>;

/** What kernels unpack: a line whose distance is in radii. */
RimLine
unpackLine(PackedRim packed, int index)
{
  const auto bits = static_cast<int>(packed >> (16 * index) & 0xffff);
  if (bits == 0)
    return {};
  const float quarters =
      4.0f * static_cast<float>(bits >> rim_depth_bits) / rim_directions;
  const float along = std::abs(quarters - 2.0f) - 1.0f;
  const float across = 1.0f - std::abs(along);
  return {Vector2f(along, quarters <= 2.0f ? across : -across).normalized(),
          1.0f - static_cast<float>(bits % rim_depth_steps) / rim_depth_steps};
}

TEST(RimLines, ArePackedToAHundredthOrLeftOut)
{
  const float infinite = std::numeric_limits<float>::infinity();
  EXPECT_EQ(0u, packRim({}, 1.0f));
  EXPECT_EQ(0u, packRim({}, 0.0f));
  EXPECT_EQ(0u, packRim({RimLine{Vector2f::UnitX(), 2.0f}, RimLine{}}, 2.0f));
  constexpr int steps = 1000;
  constexpr float radius = 5.0f, circle = 6.2831853f;
  for (int i = 0; i < steps; ++i) {
    const float angle = circle * static_cast<float>(i) / steps;
    const Vector2f outwards(std::cos(angle), std::sin(angle));
    const float distance = 0.98f * radius * static_cast<float>(i) / steps;
    const RimLine line{outwards, distance}, none{-outwards, infinite};
    const PackedRim first = packRim({line, none}, radius),
                    second = packRim({none, line}, radius);
    EXPECT_EQ(first, second >> 16);
    const RimLine unpacked = unpackLine(second, 1);
    EXPECT_LT((unpacked.outwards - outwards).norm(), 0.5f * 4.0f * 2.0f / 512.0f);
    // Rounded outwards, so that nothing is cut off that belongs to the surface.
    EXPECT_GE(unpacked.distance, distance / radius);
    EXPECT_LE(unpacked.distance, distance / radius + 1.01f / rim_depth_steps);
    EXPECT_EQ(infinite, unpackLine(second, 0).distance);
  }
}

TEST(RimLines, TurnWithTheirAxes)
{
  constexpr float circle = 6.2831853f, step = 0.5f * 4.0f * 2.0f / 512.0f;
  for (int i = 0; i < 500; ++i) {
    const float angle = circle * static_cast<float>(i) / 500.0f;
    const Vector2f outwards(std::cos(angle), std::sin(angle));
    const PackedRim rim = packRim({RimLine{outwards, 0.3f}, RimLine{}}, 1.0f),
                    both = rim | packRim({RimLine{-outwards, 0.9f}, {}}, 1.0f) << 16;
    for (int line = 0; line < 2; ++line) {
      const RimLine unpacked = unpackRim(both)[static_cast<std::size_t>(line)],
                    expected = unpackLine(both, line);
      EXPECT_LT((unpacked.outwards - expected.outwards).norm(), 1e-6f);
      EXPECT_EQ(unpacked.distance, expected.distance);
    }
    EXPECT_EQ(both, turnRim(both, Eigen::Matrix2f::Identity()));
    const float turn = 0.01f * static_cast<float>(i);
    const Eigen::Matrix2f axes = Eigen::Rotation2Df(turn).toRotationMatrix();
    const PackedRim turned = turnRim(both, axes);
    for (int line = 0; line < 2; ++line) {
      const RimLine before = unpackLine(both, line), after = unpackLine(turned, line);
      EXPECT_LT((axes * after.outwards - before.outwards).norm(), step);
      EXPECT_EQ(before.distance, after.distance);
    }
    const PackedRim one = turnRim(rim, axes);
    EXPECT_EQ(std::numeric_limits<float>::infinity(), unpackRim(one)[1].distance);
    EXPECT_EQ(0u, one >> 16);
  }
  EXPECT_EQ(0u, turnRim(0, Eigen::Matrix2f::Identity()));
}

/** The lattice points but the centre that satisfy a condition. */
std::vector<Vector2f>
latticeAround(const std::function<bool(int, int)>& has)
{
  std::vector<Vector2f> places;
  for (int y = -4; y <= 4; ++y)
    for (int x = -4; x <= 4; ++x)
      if ((x != 0 || y != 0) && has(x, y))
        places.emplace_back(static_cast<float>(x), static_cast<float>(y));
  return places;
}

TEST(RimLines, LieAtTheRimOfALattice)
{
  constexpr float radius = 1.2f, margin = 0.3f * radius;
  RimFinder finder;
  const auto lines_of = [&](const std::function<bool(int, int)>& has) {
    return finder.find(latticeAround(has), radius);
  };
  EXPECT_GT(lines_of([](int, int) { return true; })[0].distance, radius);
  // A straight rim.
  const RimLines straight = lines_of([](int, int y) { return y <= 0; });
  EXPECT_EQ(Vector2f(0.0f, 1.0f), straight[0].outwards);
  EXPECT_FLOAT_EQ(margin, straight[0].distance);
  EXPECT_GT(straight[1].distance, radius);
  // Too far away to cut the disc.
  EXPECT_GT(lines_of([](int, int y) { return y <= 1; })[0].distance, radius);
  // A corner.
  RimLines corner = lines_of([](int x, int y) { return x <= 0 && y <= 0; });
  if (corner[0].outwards[0] == 0.0f)
    std::swap(corner[0], corner[1]);
  EXPECT_EQ(Vector2f(1.0f, 0.0f), corner[0].outwards);
  EXPECT_EQ(Vector2f(0.0f, 1.0f), corner[1].outwards);
  EXPECT_FLOAT_EQ(margin, corner[0].distance);
  EXPECT_FLOAT_EQ(margin, corner[1].distance);
  // Two points that stand out of it.
  std::vector<Vector2f> jagged = latticeAround([](int, int y) { return y <= 0; });
  jagged.emplace_back(-0.5f, 1.0f);
  jagged.emplace_back(0.5f, 1.0f);
  const RimLines standing_out = finder.find(jagged, 1.5f);
  EXPECT_EQ(Vector2f(0.0f, 1.0f), standing_out[0].outwards);
  EXPECT_FLOAT_EQ(1.0f + 0.3f * 1.5f, standing_out[0].distance);
  // A gap of two rows, beyond which the surface goes on.
  EXPECT_GT(lines_of([](int, int y) { return y <= 0 || y >= 3; })[0].distance, radius);
  // Points in a row have no sides, and those of no others no rim.
  EXPECT_GT(lines_of([](int, int y) { return y == 0; })[0].distance, radius);
  EXPECT_GT(lines_of([](int, int) { return false; })[0].distance, radius);
}

/** The discs of a cloud. */
class Discs {
public:
  explicit Discs(const Cloud& cloud, unsigned threads = 0)
  {
    std::vector<std::uint32_t> all(cloud.size());
    std::iota(all.begin(), all.end(), 0u);
    Report report;
    points_ = orientPoints(viewOf(cloud), all, threads, report);
    footprints_ = computeFootprints(points_, threads, report);
  }

  std::size_t
  countCut() const
  {
    return footprints_.rims.size() -
           static_cast<std::size_t>(
               std::count(footprints_.rims.begin(), footprints_.rims.end(), 0u));
  }

  /** By the index of the input. */
  std::vector<PackedRim>
  rims() const
  {
    std::vector<PackedRim> rims(footprints_.rims.size());
    for (std::size_t i = 0; i < rims.size(); ++i)
      rims[points_.samples->getInputIndex(i)] = footprints_.rims[i];
    return rims;
  }

  /** Whether a place lies on a disc, and on one that its lines do not cut off there. */
  struct Cover {
    bool by_whole, by_cut;
  };

  Cover
  coverOf(const Vector3f& place) const
  {
    const float factor = points_.samples->getUnit().factor;
    Cover cover{false, false};
    for (std::size_t i = 0; i < footprints_.radii.size() && !cover.by_cut; ++i) {
      const Vector3f offset =
          factor * place - Vector3f(points_.samples->getPositions()[i].x);
      const float radius = footprints_.radii[i];
      Vector3f normal;
      unpackNormal(points_.normals[i], normal.data());
      if (offset.norm() > radius || std::abs(normal.dot(offset)) > 0.01f * radius)
        continue;
      cover.by_whole = true;
      const Vector2f on_disc = tangentAxes(points_.normals[i]).transpose() * offset;
      const auto isInside = [&](const RimLine& line) {
        return line.outwards.dot(on_disc) <= line.distance * radius;
      };
      cover.by_cut = isInside(unpackLine(footprints_.rims[i], 0)) &&
                     isInside(unpackLine(footprints_.rims[i], 1));
    }
    return cover;
  }

  /** The lines of a point in space, as vectors of their distance in radii. */
  std::array<Vector3f, 2>
  linesOf(std::uint32_t input_index) const
  {
    std::array<Vector3f, 2> lines;
    for (std::size_t i = 0; i < footprints_.rims.size(); ++i)
      if (points_.samples->getInputIndex(i) == input_index)
        for (int k = 0; k < 2; ++k)
          lines[static_cast<std::size_t>(k)] =
              tangentAxes(points_.normals[i]) *
              unpackLine(footprints_.rims[i], k).outwards;
    return lines;
  }

private:
  OrientedPoints points_;
  Footprints footprints_;
};

/** The places of a square lattice about the origin. */
std::vector<Vector2f>
latticeWithin(float half_side, float step)
{
  const auto count = static_cast<int>(half_side / step);
  std::vector<Vector2f> places;
  for (int row = -count; row <= count; ++row)
    for (int column = -count; column <= count; ++column)
      places.emplace_back(step * static_cast<float>(column),
                          step * static_cast<float>(row));
  return places;
}

/** Where a sheet in the square of side 2 has points. */
using Shape = std::function<bool(const Vector2f&)>;

Cloud
makeSheet(std::size_t n, const Shape& shape)
{
  Cloud cloud;
  std::mt19937_64 engine(1);
  std::uniform_real_distribution<float> place(-1.0f, 1.0f);
  while (cloud.size() < n) {
    pcl::PointNormal point;
    point.x = place(engine);
    point.y = place(engine);
    point.normal_z = 1.0f;
    if (shape({point.x, point.y}))
      cloud.push_back(point);
  }
  return cloud;
}

/** Of places about a sheet, in areas of a point: covered beyond its rim by whole discs
 * and by cut ones; not covered any more on the sheet, and farther than two spacings
 * from its rim. */
struct Areas {
  double beyond_whole = 0.0, beyond_cut = 0.0, opened = 0.0, opened_inside = 0.0;

  Areas(const Shape& shape, double area)
  {
    constexpr std::size_t n = 1500;
    const Discs discs(makeSheet(n, shape));
    const auto spacing = static_cast<float>(std::sqrt(area / n));
    const auto on_sheet = [&](const Vector2f& place) {
      return place.cwiseAbs().maxCoeff() <= 1.0f && shape(place);
    };
    const auto is_inside = [&](const Vector2f& place) {
      bool all = true;
      for (int i = 0; i < 16; ++i)
        all &= on_sheet(
            place + 2.0f * spacing *
                        Vector2f(std::cos(0.3926991f * i), std::sin(0.3926991f * i)));
      return all;
    };
    for (const Vector2f& place : latticeWithin(1.3f, 0.25f * spacing)) {
      const auto [by_whole, by_cut] = discs.coverOf({place[0], place[1], 0.0f});
      const bool is_opened = by_whole && !by_cut, is_on_sheet = on_sheet(place);
      beyond_whole += !is_on_sheet && by_whole ? 1 : 0;
      beyond_cut += !is_on_sheet && by_cut ? 1 : 0;
      opened += is_on_sheet && is_opened ? 1 : 0;
      opened_inside += is_opened && is_inside(place) ? 1 : 0;
    }
    for (double* const places : {&beyond_whole, &beyond_cut, &opened, &opened_inside})
      *places *= 0.25 * 0.25;
  }
};

TEST(RimLines, EndDiscsThatReachBeyondARim)
{
  const auto square = [](const Vector2f&) { return true; };
  const auto disc = [](const Vector2f& x) { return x.norm() <= 1.0f; };
  const auto hole = [](const Vector2f& x) { return x.norm() >= 0.5f; };
  const auto notch = [](const Vector2f& x) { return x[0] <= 0.0f || x[1] <= 0.0f; };
  const std::tuple<Shape, double, double> sheets[] = {{square, 4.0, 0.26},
                                                      {disc, 3.1416, 0.22},
                                                      {hole, 3.2146, 0.29},
                                                      {notch, 3.0, 0.29}};
  for (const auto& [shape, area, part] : sheets) {
    const Areas areas(shape, area);
    EXPECT_LT(areas.beyond_cut, part * areas.beyond_whole);
    EXPECT_LT(areas.opened, 0.1 * areas.beyond_whole);
    EXPECT_EQ(0.0, areas.opened_inside);
  }
}

/** Random numbers times a factor are added to places and normals. */
void
roughen(Cloud& cloud, float of_places, float of_normals)
{
  std::mt19937 engine(1);
  std::normal_distribution<float> random;
  const auto vector = [&] {
    Vector3f v;
    for (float& part : v)
      part = random(engine);
    return v;
  };
  for (pcl::PointNormal& point : cloud) {
    point.getVector3fMap() += of_places * vector();
    point.getNormalVector3fMap() += of_normals * vector();
    point.getNormalVector3fMap().normalize();
  }
}

TEST(RimLines, AreNoneOnClosedSurfaces)
{
  for (const std::size_t n : {500, 5000, 20000})
    EXPECT_EQ(0u, Discs(*uvol_test::makeSphere(n, 1)).countCut());
  EXPECT_EQ(0u, Discs(*uvol_test::makeTorusKnot(20000, 1)).countCut());
  constexpr std::size_t n = 10000;
  const float spacing = std::sqrt(4.0f * 3.14159f / n);
  for (const float noise : {0.1f, 0.3f, 1.0f}) {
    Cloud sphere = *uvol_test::makeSphere(n, 1);
    roughen(sphere, noise * spacing, 0.2f);
    EXPECT_EQ(0u, Discs(sphere).countCut()) << noise;
  }
}

TEST(RimLines, OpenNoEdgeOfACube)
{
  // The neighbours on the other side of an edge are none of a disc, but tell that the
  // surface goes on.
  for (const std::size_t n : {600, 3000}) {
    Cloud cube;
    std::mt19937_64 engine(n);
    std::uniform_real_distribution<float> coordinate(-1.0f, 1.0f);
    for (std::size_t i = 0; i < n; ++i) {
      const auto axis = static_cast<int>(i % 3);
      pcl::PointNormal point;
      for (int k = 0; k < 3; ++k)
        point.data[k] = coordinate(engine);
      point.data[axis] = point.data_n[axis] = i % 2 == 0 ? 1.0f : -1.0f;
      cube.push_back(point);
    }
    const Discs discs(cube);
    EXPECT_GT(discs.countCut(), n / 50);
    const float step = 0.25f * std::sqrt(24.0f / static_cast<float>(n));
    for (const Vector2f& place : latticeWithin(1.0f, step)) {
      const auto [by_whole, by_cut] = discs.coverOf({place[0], place[1], 1.0f});
      ASSERT_EQ(by_whole, by_cut) << n << ": " << place.transpose();
    }
  }
}

TEST(RimLines, EndSplatsAsTheyEndDiscs)
{
  const auto sheet = uvol_test::makeWaves(2000, 3);
  const Discs discs(*sheet);
  const std::vector<PackedRim> of_discs = discs.rims();
  SplatGeneration<pcl::PointNormal> generation;
  generation.setInputCloud(sheet);
  pcl::PointCloud<PointSplat> splats;
  generation.compute(splats);
  const std::vector<PackedRim>& rims = generation.getRims();
  ASSERT_EQ(splats.size(), rims.size());
  std::size_t cut = 0;
  for (std::size_t i = 0; i < splats.size(); ++i) {
    if (rims[i] == 0)
      continue;
    ++cut;
    const std::uint32_t source = generation.getSources()[i];
    const Vector3f u = splats[i].getTangentVector3fMap(),
                   v = splats[i].getNormalVector3fMap().cross(u);
    const std::array<Vector3f, 2> lines = discs.linesOf(source);
    for (int k = 0; k < 2; ++k) {
      const RimLine line = unpackLine(rims[i], k);
      EXPECT_EQ(unpackLine(of_discs[source], k).distance, line.distance);
      if (line.distance < 1.0f) {
        EXPECT_LT((line.outwards[0] * u + line.outwards[1] * v -
                   lines[static_cast<std::size_t>(k)])
                      .norm(),
                  0.01f);
      }
    }
  }
  EXPECT_GE(cut, discs.countCut() * 9 / 10);
  EXPECT_LE(cut, discs.countCut());

  generation.setInputCloud(uvol_test::makeSphere(2000, 1));
  generation.compute(splats);
  EXPECT_TRUE(generation.getRims().empty());
}

TEST(RimLines, DependOnNeitherThreadsNorUnitNorOrder)
{
  const Cloud sheet = *uvol_test::makeWaves(5000, 3);
  const std::vector<PackedRim> rims = Discs(sheet, 1).rims();
  EXPECT_GT(Discs(sheet).countCut(), 100u);
  EXPECT_EQ(rims, Discs(sheet, 7).rims());
  Cloud larger = sheet, reversed = sheet;
  for (pcl::PointNormal& point : larger)
    point.getVector3fMap() *= 1024.0f;
  EXPECT_EQ(rims, Discs(larger).rims());
  std::reverse(reversed.begin(), reversed.end());
  std::vector<PackedRim> of_reversed = Discs(reversed).rims();
  std::reverse(of_reversed.begin(), of_reversed.end());
  EXPECT_EQ(rims, of_reversed);
}

} // namespace test_rim_lines
