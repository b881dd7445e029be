// SPDX-License-Identifier: BSD-3-Clause
// Densities of particles against sums over all pairs.
#include "common/random.h"
#include "common/records.h"
#include "interpolation/sph_density.h"
#include "support/environment.h"
#include <pcl_uvol/common/dataset.h>
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/io/dataset.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

using namespace pcl_uvol;

namespace test_sph_density {

constexpr double pi = 3.14159265358979323846;

/** The cubic spline, written out. */
double
cubicSpline(double distance, double h)
{
  const double q = distance / h;
  const double value = q < 1.0   ? 1.0 - 1.5 * q * q + 0.75 * q * q * q
                       : q < 2.0 ? 0.25 * (2.0 - q) * (2.0 - q) * (2.0 - q)
                                 : 0.0;
  return value / (pi * h * h * h);
}

/** Particles at random in a box of that side, with masses and lengths. */
Dataset
makeParticles(std::size_t count, double side, double shift = 0.0)
{
  Dataset dataset;
  std::vector<double> xyz, masses, lengths;
  for (std::size_t i = 0; i < count; ++i) {
    for (std::uint64_t axis = 0; axis < 3; ++axis)
      xyz.push_back(shift + side * static_cast<float>(uniformAt(1, i, axis)));
    masses.push_back(0.5 + uniformAt(2, i, 0));
    lengths.push_back(side * (0.1 + 0.1 * uniformAt(2, i, 1)));
  }
  dataset.cloud = makeRecords({}, count);
  setCoordinates(dataset, xyz);
  setField(dataset, "mass", masses);
  setField(dataset, "h", lengths);
  return dataset;
}

double
read(const Dataset& dataset, const std::string& name, std::size_t i)
{
  return ScalarField(dataset.cloud.fields, name)
      .read(&dataset.cloud.data[i * dataset.cloud.point_step]);
}

std::vector<double>
densitiesOf(const Dataset& dataset, double length = 0.0, unsigned threads = 1)
{
  Report report;
  const SphParameters parameters = findSphFields(dataset.cloud.fields);
  return computeSphDensity(viewOf(dataset.cloud),
                           parameters,
                           {length, lengthFactorOf(parameters.length_field)},
                           threads,
                           report);
}

TEST(SphDensity, IsTheSumOverAllPairs)
{
  for (const double side : {1.0, 0x1p-60, 0x1p50, 3000.0})
    for (const double length : {0.0, 0.17}) {
      const Dataset dataset = makeParticles(500, side);
      const std::vector<double> densities = densitiesOf(dataset, side * length);
      const CloudView view = viewOf(dataset.cloud);
      for (std::size_t i = 0; i < view.count; ++i) {
        double sum = 0.0;
        for (std::size_t j = 0; j < view.count; ++j) {
          double sq_distance = 0.0;
          for (int axis = 0; axis < 3; ++axis) {
            const double step = double(view.xyz(i)[axis]) - double(view.xyz(j)[axis]);
            sq_distance += step * step;
          }
          sum += read(dataset, "mass", j) *
                 cubicSpline(std::sqrt(sq_distance),
                             length > 0.0 ? side * length : read(dataset, "h", i));
        }
        EXPECT_NEAR(sum, densities[i], 1e-5 * sum) << side;
      }
    }
}

TEST(SphDensity, DoesNotDependOnThreads)
{
  const Dataset dataset = makeParticles(5000, 1.0);
  EXPECT_EQ(densitiesOf(dataset), densitiesOf(dataset, 0.0, 4));
}

/** On a lattice of unit masses it is their number per volume. */
TEST(SphDensity, IsThatOfALattice)
{
  Dataset dataset;
  std::vector<double> xyz;
  for (int i = 0; i < 12 * 12 * 12; ++i)
    for (const int index : {i % 12, i / 12 % 12, i / 144})
      xyz.push_back(0.5 * index);
  dataset.cloud = makeRecords({}, xyz.size() / 3);
  setCoordinates(dataset, xyz);
  const std::vector<double> densities = densitiesOf(dataset);
  EXPECT_NEAR(8.0, densities[6 + 12 * 6 + 144 * 6], 0.2);
  EXPECT_LT(densities[0], 4.0); // a corner
}

/** Snapshots of Gadget have the end of the kernel, those of SWIFT a length in units of
 * its deviation. */
TEST(SphDensity, LengthsAreWhatTheirNameSays)
{
  EXPECT_EQ(0.5, lengthFactorOf("HSML"));
  EXPECT_EQ(0.5, lengthFactorOf("SmoothingLength"));
  EXPECT_EQ(0.5 * 1.825742, lengthFactorOf("SmoothingLengths"));
  EXPECT_EQ(1.0, lengthFactorOf("h"));
}

/** Far from all others a particle has its own mass alone. */
TEST(SphDensity, OfThreeAtOnePlaceIsThatOfAllTheirMasses)
{
  Dataset dataset = makeParticles(300, 1.0);
  const std::size_t step = dataset.cloud.point_step;
  const float far = 50.0f;
  for (const std::size_t i : {7u, 9u, 11u})
    for (std::size_t axis = 0; axis < 3; ++axis)
      std::memcpy(
          &dataset.cloud.data[i * step + axis * sizeof(float)], &far, sizeof(float));
  const std::vector<double> densities = densitiesOf(dataset);
  const double mass =
      read(dataset, "mass", 7) + read(dataset, "mass", 9) + read(dataset, "mass", 11);
  bool is_of_one = false;
  for (const std::size_t i : {7u, 9u, 11u}) {
    EXPECT_EQ(densities[7], densities[i]);
    const double expected = mass * cubicSpline(0.0, read(dataset, "h", i));
    is_of_one |= std::abs(densities[i] - expected) < 1e-5 * expected;
  }
  EXPECT_TRUE(is_of_one);
}

TEST(SphDensity, CoincidingParticlesAddTheirMassesAndMissingOnesHaveNone)
{
  Dataset dataset = makeParticles(300, 1.0), twice = dataset;
  std::copy_n(&twice.cloud.data[7 * twice.cloud.point_step],
              3 * sizeof(float),
              &twice.cloud.data[9 * twice.cloud.point_step]);
  const std::vector<double> densities = densitiesOf(twice);
  EXPECT_EQ(densities[7], densities[9]);
  EXPECT_GT(densities[7], densitiesOf(dataset)[7]);
  const float missing = std::nanf("");
  std::memcpy(
      &dataset.cloud.data[5 * dataset.cloud.point_step], &missing, sizeof(missing));
  EXPECT_TRUE(std::isnan(densitiesOf(dataset)[5]));
  EXPECT_TRUE(std::isfinite(densitiesOf(dataset)[6]));
}

TEST(SphDensity, OfAPlanetIsThatOfItsFile)
{
  if (uvol_test::dataFolder().empty())
    GTEST_SKIP() << "the folder of real data is not there ($PCL_UVOL_DATA)";
  const Dataset planet =
      loadDataset(uvol_test::dataFolder() + "/particles/planet_remnant.gadget1");
  const std::vector<double> densities = densitiesOf(planet);
  for (std::size_t i = 0; i < densities.size(); ++i)
    EXPECT_NEAR(1.0, densities[i] / read(planet, "RHO", i), 0.01) << i;
}

TEST(SphDensity, IsAddedAsAFieldInABoxThatRepeats)
{
  Dataset lattice; // of 8 points a side, one apart
  std::vector<double> xyz;
  for (int i = 0; i < 512; ++i)
    for (const int coordinate : {i % 8, i / 8 % 8, i / 64})
      xyz.push_back(coordinate);
  lattice.cloud = makeRecords({}, 512);
  setCoordinates(lattice, xyz);
  Dataset alone = lattice;
  Report report;
  addSphDensity(lattice, 1.2, 1, report, {8.0, 8.0, 8.0});
  ASSERT_EQ(lattice.cloud.width, 512u);
  for (std::size_t i = 0; i < 512; ++i)
    EXPECT_NEAR(read(lattice, "sph_density", i), 1.0, 0.02) << i;
  ASSERT_EQ(report.warnings.size(), 1u);
  EXPECT_EQ(report.warnings[0].code, "no_masses");

  addSphDensity(alone, 1.2, 1, report);
  EXPECT_LT(read(alone, "sph_density", 0), 0.7);
  EXPECT_THROW(addSphDensity(alone, 1.2, 1, report), InvalidArgument); // once only
  for (const double length : {-1.0, std::nan("")})
    EXPECT_THROW(addSphDensity(lattice, length, 1, report), InvalidArgument);
}

} // namespace test_sph_density
