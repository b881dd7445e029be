// SPDX-License-Identifier: BSD-3-Clause
// Layers of cones against brute force.
#include "gl/conic_sections.h"
#include "support/environment.h"
#include "support/messages.h"

#include <algorithm>
#include <cmath>
#include <gmock/gmock.h>
#include <limits>
#include <stdexcept>
#include <string>

namespace test_conic_sections {

using pcl_uvol::ConicSections;
using pcl_uvol::GlContext;
using pcl_uvol::GlError;
using pcl_uvol::GridCell;
using pcl_uvol::GridShape;
using pcl_uvol::InvalidArgument;
using pcl_uvol::Report;

using Nearest = std::vector<std::uint32_t>;
using ContextPtr = std::shared_ptr<GlContext>;

ContextPtr
makeContext(const std::string& name)
{
  return name == "osmesa" ? pcl_uvol::createOsMesaContext()
                          : pcl_uvol::createEglContext(pcl_uvol::EglDevice::Software);
}

/** \param spacing multiples of one half, for the exactness of the squares */
GridShape
makeShape(const std::array<std::uint32_t, 3>& cells,
          const std::array<double, 3>& spacing = {1.0, 1.0, 1.0})
{
  GridShape shape;
  shape.cells = cells;
  shape.spacing = spacing;
  return shape;
}

GridCell
cellOf(const GridShape& shape, std::size_t number)
{
  const std::size_t width = shape.cells[0], height = shape.cells[1];
  return {static_cast<std::uint16_t>(number % width),
          static_cast<std::uint16_t>(number / width % height),
          static_cast<std::uint16_t>(number / (width * height))};
}

/** The cells that hold random samples. */
std::vector<GridCell>
randomSites(const GridShape& shape, std::size_t samples)
{
  uvol_test::Random random(17);
  std::vector<std::uint64_t> numbers(samples);
  for (std::uint64_t& number : numbers)
    number = static_cast<std::uint64_t>(random.uniform() *
                                        static_cast<double>(shape.size()));
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
  std::vector<GridCell> sites;
  for (const std::uint64_t number : numbers)
    sites.push_back(cellOf(shape, number));
  return sites;
}

/** Squared distances, in units of a quarter, of a cell to all sites. */
class SquaredDistances {
public:
  SquaredDistances(const GridShape& shape, const std::vector<GridCell>& sites)
  {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto halves =
          static_cast<std::int32_t>(std::lround(2.0 * shape.spacing[axis]));
      weights_[axis] = halves * halves;
      for (const GridCell& site : sites)
        sites_[axis].push_back(site[axis]);
    }
  }

  std::int32_t
  to(const GridCell& cell, std::size_t site) const
  {
    std::int32_t sum = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::int32_t difference = cell[axis] - sites_[axis][site];
      sum += weights_[axis] * difference * difference;
    }
    return sum;
  }

  std::int32_t
  toNearest(const GridCell& cell) const
  {
    std::int32_t smallest = std::numeric_limits<std::int32_t>::max();
    for (std::size_t site = 0; site < sites_[0].size(); ++site)
      smallest = std::min(smallest, to(cell, site));
    return smallest;
  }

private:
  std::int32_t weights_[3];
  std::vector<std::int32_t> sites_[3];
};

struct Quality {
  double exact;  ///< part of the cells with the nearest site, or one as near
  double excess; ///< of the distance to a site that is not, at most
};

/** \param step compare every n-th cell */
Quality
compare(const GridShape& shape,
        const std::vector<GridCell>& sites,
        const Nearest& nearest,
        std::size_t step = 1)
{
  const SquaredDistances sq_distances(shape, sites);
  std::size_t compared = 0, exact = 0;
  double excess = 0.0;
  for (std::size_t i = 0; i < nearest.size(); i += step, ++compared) {
    if (nearest[i] >= sites.size())
      return {0.0, std::numeric_limits<double>::infinity()};
    const GridCell cell = cellOf(shape, i);
    const std::int32_t smallest = sq_distances.toNearest(cell);
    const std::int32_t found = sq_distances.to(cell, nearest[i]);
    exact += found == smallest;
    excess = std::max(excess, 0.5 * (std::sqrt(found) - std::sqrt(smallest)));
  }
  return {static_cast<double>(exact) / static_cast<double>(compared), excess};
}

class ConicSectionsOn : public testing::TestWithParam<std::string> {
protected:
  static Nearest
  find(const GridShape& shape, const std::vector<GridCell>& sites)
  {
    Report report;
    return ConicSections(makeContext(GetParam())).find(shape, sites, 0, report);
  }

  /** All of it is right within the error of the triangles. */
  static void
  expectGood(const GridShape& shape,
             const std::vector<GridCell>& sites,
             double least_exact = 0.95,
             std::size_t step = 1)
  {
    const Nearest nearest = find(shape, sites);
    ASSERT_EQ(shape.size(), nearest.size());
    const Quality quality = compare(shape, sites, nearest, step);
    EXPECT_GE(quality.exact, least_exact);
    EXPECT_LE(quality.excess, std::min(shape.spacing[0], shape.spacing[1]));
  }
};

INSTANTIATE_TEST_SUITE_P(ConicSections,
                         ConicSectionsOn,
                         testing::Values("osmesa", "egl"),
                         [](const auto& name) { return name.param; });

TEST_P(ConicSectionsOn, RandomSitesOfTheThesis)
{
  const GridShape small = makeShape({32, 32, 32}), large = makeShape({64, 64, 64});
  expectGood(small, randomSites(small, 10000));
  expectGood(large, randomSites(large, 10000), 0.95, 37);
}

TEST_P(ConicSectionsOn, TheTrianglesOfTheThesisAreWithinACell)
{
  const GridShape shape = makeShape({32, 32, 32});
  const std::vector<GridCell> sites = randomSites(shape, 2000);
  Report report;
  const Nearest nearest =
      ConicSections(makeContext(GetParam()), 2.0, 4).find(shape, sites, 0, report);
  const Quality quality = compare(shape, sites, nearest);
  EXPECT_GE(quality.exact, 0.9);
  EXPECT_LE(quality.excess, 0.6);
}

TEST_P(ConicSectionsOn, MoreTrianglesAreNearerToTheCone)
{
  const GridShape shape = makeShape({32, 32, 32});
  const std::vector<GridCell> sites = randomSites(shape, 1000);
  Report report;
  const Nearest nearest =
      ConicSections(makeContext(GetParam()), 1.0, 12).find(shape, sites, 0, report);
  EXPECT_GE(compare(shape, sites, nearest).exact, 0.999);
}

TEST_P(ConicSectionsOn, OneSiteIsNearestEverywhere)
{
  for (const GridCell& site : {GridCell{0, 0, 0}, GridCell{16, 3, 8}})
    EXPECT_THAT(find(makeShape({17, 9, 11}), {site}), testing::Each(0u));
}

TEST_P(ConicSectionsOn, OfTwoSitesTheNearerOne)
{
  const GridShape shape = makeShape({20, 21, 22});
  expectGood(shape, {{3, 4, 5}, {16, 15, 14}}, 0.99);
  expectGood(shape, {{0, 0, 0}, {1, 0, 0}}, 0.99);
}

TEST_P(ConicSectionsOn, TheLowerOneOfEquallyFarSites)
{
  const GridShape shape = makeShape({5, 5, 5});
  const Nearest nearest = find(shape, {{2, 2, 0}, {2, 2, 4}});
  for (std::size_t i = 0; i < nearest.size(); ++i)
    EXPECT_EQ(cellOf(shape, i)[2] <= 2 ? 0u : 1u, nearest[i]) << "cell " << i;
}

TEST_P(ConicSectionsOn, NoSites)
{
  EXPECT_THAT(find(makeShape({3, 4, 5}), {}),
              testing::AllOf(testing::SizeIs(60), testing::Each(pcl_uvol::no_site)));
}

TEST_P(ConicSectionsOn, SitesInOnePlaneOnly)
{
  const GridShape plane = makeShape({30, 31, 1}), shape = makeShape({30, 31, 32});
  std::vector<GridCell> sites = randomSites(plane, 100);
  for (GridCell& site : sites)
    site[2] = 25;
  expectGood(shape, sites, 0.9);
}

TEST_P(ConicSectionsOn, GridsThatAreOneCellThick)
{
  for (const std::array<std::uint32_t, 3>& cells :
       {std::array<std::uint32_t, 3>{1, 40, 50},
        {40, 1, 50},
        {40, 50, 1},
        {90, 1, 1}}) {
    const GridShape shape = makeShape(cells);
    expectGood(shape, randomSites(shape, 60));
  }
  EXPECT_THAT(find(makeShape({1, 1, 1}), {{0, 0, 0}}), testing::ElementsAre(0u));
}

TEST_P(ConicSectionsOn, CellsThatAreNoCubes)
{
  for (const std::array<double, 3>& spacing :
       {std::array<double, 3>{1.0, 2.0, 0.5}, {3.0, 1.0, 1.0}, {0.5, 0.5, 4.0}}) {
    const GridShape shape = makeShape({24, 20, 28}, spacing);
    expectGood(shape, randomSites(shape, 500), 0.9);
  }
}

TEST_P(ConicSectionsOn, ACornerFullOfSitesAndNothingElse)
{
  std::vector<GridCell> sites = randomSites(makeShape({8, 8, 8}), 200);
  expectGood(makeShape({40, 40, 40}), sites, 0.9);
}

TEST_P(ConicSectionsOn, TheSameAgain)
{
  const GridShape shape = makeShape({32, 30, 28});
  const std::vector<GridCell> sites = randomSites(shape, 3000);
  ConicSections sections(makeContext(GetParam()));
  Report report;
  const Nearest first = sections.find(shape, sites, 1, report);
  EXPECT_EQ(first, sections.find(shape, sites, 2, report));
  EXPECT_EQ(first, find(shape, sites));
}

TEST_P(ConicSectionsOn, ReportsTimeAndProgress)
{
  const GridShape shape = makeShape({16, 16, 16});
  Report report;
  double done = 0.0;
  report.progress = [&](const std::string& step, double part) {
    EXPECT_EQ("conic_sections", step);
    EXPECT_GE(part, done);
    done = part;
  };
  ConicSections(makeContext(GetParam())).find(shape, randomSites(shape, 9), 0, report);
  EXPECT_EQ(1.0, done);
  ASSERT_EQ(1u, report.milliseconds.size());
  EXPECT_EQ("conic_sections", report.milliseconds[0].first);
  EXPECT_GT(report.milliseconds[0].second, 0.0);
}

TEST_P(ConicSectionsOn, CanBeInterrupted)
{
  const GridShape shape = makeShape({16, 16, 16});
  const std::vector<GridCell> sites = randomSites(shape, 50);
  ConicSections sections(makeContext(GetParam()));
  Report interrupted, report;
  interrupted.progress = [](const std::string&, double) {
    throw std::runtime_error("enough");
  };
  EXPECT_THROW(sections.find(shape, sites, 0, interrupted), std::runtime_error);
  EXPECT_EQ(find(shape, sites), sections.find(shape, sites, 0, report));
}

TEST(ConicSections, ParametersOutOfRange)
{
  const ContextPtr context = pcl_uvol::createOsMesaContext();
  for (const double radius : {0.99, -2.0, 1e9, std::nan("")})
    EXPECT_THROW(ConicSections(context, radius, 4), InvalidArgument) << radius;
  for (const unsigned triangles : {0u, 2u, 65u})
    EXPECT_THROW(ConicSections(context, 2.0, triangles), InvalidArgument) << triangles;
  EXPECT_THROW(ConicSections(nullptr), InvalidArgument);
  EXPECT_NO_THROW(ConicSections(context, 1.0, 3));
}

using GetIntegers = void (*)(unsigned parameter, int* values);

GetIntegers true_integers = nullptr;

/** Plays a driver with windows of 16 x 16 pixels at most. */
void
getSmallIntegers(unsigned parameter, int* values)
{
  constexpr unsigned max_viewport_dims = 0x0d3a;
  true_integers(parameter, values);
  if (parameter == max_viewport_dims)
    values[0] = values[1] = 16;
}

TEST(ConicSections, LayersThatAreTooLargeForTheDriver)
{
  const ContextPtr owner = pcl_uvol::createOsMesaContext();
  true_integers = reinterpret_cast<GetIntegers>(owner->getFunction("glGetIntegerv"));
  owner->run([&] {
    const auto find = [&](const std::string& name) {
      return name == "glGetIntegerv"
                 ? reinterpret_cast<GlContext::Function>(&getSmallIntegers)
                 : owner->getFunction(name.c_str());
    };
    ConicSections sections(pcl_uvol::wrapCurrentContext("small", find));
    Report report;
    EXPECT_THAT(sections.find(makeShape({16, 16, 20}), {{0, 0, 0}}, 0, report),
                testing::Each(0u));
    const pcl_uvol::Message error = uvol_test::thrownBy<GlError>([&] {
      sections.find(makeShape({8, 17, 2}), {{0, 0, 0}}, 0, report);
    });
    EXPECT_EQ("gl_layers_too_large", error.code);
    EXPECT_EQ(8.0, uvol_test::numberOf(error, "width"));
    EXPECT_EQ(17.0, uvol_test::numberOf(error, "height"));
  });
}

} // namespace test_conic_sections
