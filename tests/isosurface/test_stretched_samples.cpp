// SPDX-License-Identifier: BSD-3-Clause
// Samples that lie denser along one direction than along others: their isopoints are as
// good, and as sure of themselves, as those of a cubic lattice.
#include "common/random.h"
#include "generation/analytic_fields.h"
#include "support/clouds.h"
#include "support/stretched_samples.h"
#include <pcl_uvol/isosurface/isosurface_extraction.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace test_stretched_samples {

using pcl_uvol::IsoSupport;
using Cloud = pcl::PointCloud<pcl::PointXYZI>;
using Surface = pcl::PointCloud<pcl_uvol::PointIso>;
using Extraction = pcl_uvol::IsosurfaceExtraction<pcl::PointXYZI>;
using uvol_test::makeStretchedSamples;
using uvol_test::SmoothField;
using uvol_test::StretchedSamples;
using Vector = Eigen::Vector3d;

constexpr int side = 30;

SmoothField
makeField()
{
  return uvol_test::makeSmoothField("radial", side * side * side);
}

/** The same field as a function of space, not of the index space. */
SmoothField
inSpace(const SmoothField& field, const StretchedSamples& samples)
{
  SmoothField moved = field;
  moved.value = [=](const Vector& x) { return field.value(samples.to_index(x)); };
  return moved;
}

Surface
extract(const Cloud::Ptr& cloud, double isovalue, unsigned threads = 0)
{
  Extraction extraction;
  extraction.setInputCloud(cloud);
  extraction.setIsoValue(isovalue);
  extraction.setNumberOfThreads(threads);
  Surface surface;
  extraction.extract(surface);
  return surface;
}

double
partWith(IsoSupport support, const Surface& surface)
{
  return static_cast<double>(std::count_if(surface.begin(),
                                           surface.end(),
                                           [&](const pcl_uvol::PointIso& point) {
                                             return point.support ==
                                                    static_cast<std::uint8_t>(support);
                                           })) /
         static_cast<double>(surface.size());
}

struct Sampling {
  const char* shape;
  double ratio;
};

class StretchedSampling : public testing::TestWithParam<Sampling> {};

TEST_P(StretchedSampling, IsAsGoodAsACubicOne)
{
  const SmoothField field = makeField();
  const auto samples = makeStretchedSamples(GetParam().shape, GetParam().ratio, side);
  const Surface surface = extract(samples.sample(field, side, 1), field.isovalue);
  ASSERT_GT(surface.size(), 500u);
  const auto found = uvol_test::deviations(field, samples.inIndexSpace(surface));
  const auto jittered = makeStretchedSamples("jittered", GetParam().ratio, side);
  const auto reference = uvol_test::deviations(
      field,
      jittered.inIndexSpace(extract(jittered.sample(field, side, 1), field.isovalue)));
  EXPECT_LE(uvol_test::mean(found), 3.0 * uvol_test::mean(reference));
  EXPECT_LE(uvol_test::mean(found), 5e-4);
  EXPECT_GE(partWith(IsoSupport::Measured, surface), 0.99);
}

/** Normals and estimated errors are those of the space, not of any metric. */
TEST_P(StretchedSampling, HasNormalsAndErrorsOfTheSpace)
{
  const auto samples = makeStretchedSamples(GetParam().shape, GetParam().ratio, side);
  const SmoothField field = makeField(), moved = inSpace(field, samples);
  const Surface surface = extract(samples.sample(field, side, 1), field.isovalue);
  const auto deviations = uvol_test::deviations(moved, surface);
  double turned = 0.0, covered = 0.0;
  for (std::size_t i = 0; i < surface.size(); ++i) {
    const Vector x = surface[i].getVector3fMap().cast<double>();
    Vector gradient;
    for (int axis = 0; axis < 3; ++axis) {
      const Vector step = 1e-4 * Vector::Unit(axis);
      gradient[axis] = moved.value(x + step) - moved.value(x - step);
    }
    const Vector normal = surface[i].getNormalVector3fMap().cast<double>();
    turned += std::asin(std::min(1.0, gradient.normalized().cross(normal).norm()));
    EXPECT_LT(gradient.dot(normal), 0.0);
    covered += deviations[i] <= surface[i].error;
  }
  const auto points = static_cast<double>(surface.size());
  EXPECT_LE(turned / points * 180.0 / M_PI, 0.5);
  EXPECT_GE(covered / points, 0.85);
}

INSTANTIATE_TEST_SUITE_P(Shapes,
                         StretchedSampling,
                         testing::Values(Sampling{"lattice", 1.5},
                                         Sampling{"lattice", 3.0},
                                         Sampling{"lattice", 30.0},
                                         Sampling{"rotated", 2.0},
                                         Sampling{"rotated", 10.0},
                                         Sampling{"wall", 30.0},
                                         Sampling{"curved", 10.0},
                                         Sampling{"shaken", 3.0}),
                         [](const auto& sampling) {
                           return std::string(sampling.param.shape) +
                                  std::to_string(
                                      static_cast<int>(sampling.param.ratio));
                         });

TEST(StretchedSamples, HaveTheCurvatureOfTheSpace)
{
  constexpr double ratio = 4.0, radius = 12.0; // of a cylinder across slices
  Cloud::Ptr cloud(new Cloud);
  for (int k = -5; k <= 5; ++k)
    for (int j = -20; j <= 20; ++j)
      for (int i = -20; i <= 20; ++i) {
        pcl::PointXYZI point;
        point.getVector3fMap() = Vector(i, j, ratio * k).cast<float>();
        point.intensity = static_cast<float>(std::hypot(i, j));
        cloud->push_back(point);
      }
  std::size_t measured = 0;
  for (const pcl_uvol::PointIso& point : extract(cloud, radius))
    if (point.support == static_cast<std::uint8_t>(IsoSupport::Measured)) {
      ++measured;
      // values are lower inside, which is outside therefore
      EXPECT_NEAR(-0.5 / radius, point.mean_curvature, 0.02 / radius);
    }
  EXPECT_GT(measured, 500u);
}

TEST(StretchedSamples, GiveTheSameBytesOnAnyThreadsAndInAnyOrder)
{
  const SmoothField field = makeField();
  const auto cloud = makeStretchedSamples("curved", 10.0, side).sample(field, side, 1);
  const Surface one = extract(cloud, field.isovalue, 1);
  const auto isSame = [&](const Surface& other) {
    return other.size() == one.size() &&
           std::memcmp(other.points.data(),
                       one.points.data(),
                       sizeof(pcl_uvol::PointIso) * one.size()) == 0;
  };
  EXPECT_TRUE(isSame(extract(cloud, field.isovalue, 3)));
  Cloud::Ptr shuffled(new Cloud(*cloud));
  for (std::size_t i = shuffled->size(); i-- > 1;)
    std::swap((*shuffled)[i], (*shuffled)[pcl_uvol::mixBits(i) % (i + 1)]);
  EXPECT_TRUE(isSame(extract(shuffled, field.isovalue)));
}

/** A power of two changes no digit. */
TEST(StretchedSamples, DoNotDependOnTheUnitOfLength)
{
  const SmoothField field = makeField();
  const auto cloud = makeStretchedSamples("lattice", 6.0, side).sample(field, side, 1);
  const Surface surface = extract(cloud, field.isovalue);
  for (const float unit : {0x1p-20f, 0x1p20f}) {
    Cloud::Ptr scaled(new Cloud(*cloud));
    for (auto& point : *scaled)
      point.getVector3fMap() *= unit;
    const Surface other = extract(scaled, field.isovalue);
    ASSERT_EQ(surface.size(), other.size());
    for (std::size_t i = 0; i < surface.size(); ++i) {
      EXPECT_EQ(surface[i].getVector3fMap() * unit, other[i].getVector3fMap());
      EXPECT_EQ(surface[i].getNormalVector3fMap(), other[i].getNormalVector3fMap());
      EXPECT_EQ(surface[i].support, other[i].support);
    }
  }
}

enum class Packing { Cubic, Dense };

/** Samples of a lattice on one side of the plane x = 0, the nearest ones half a layer
 * off it.
 * \param spacing between nearest samples; below 0 for the side of negative x */
void
addLattice(Packing packing, double spacing, Cloud& cloud)
{
  const bool is_dense = packing == Packing::Dense;
  const Vector steps =
      std::abs(spacing) * Vector(1.0,
                                 is_dense ? std::sqrt(3.0) / 2.0 : 1.0,
                                 is_dense ? std::sqrt(6.0) / 3.0 : 1.0);
  constexpr double half_width = 8.0;
  for (int k = 0; (k + 1) * steps[2] <= 2.0 * half_width; ++k)
    for (int j = 0; (j + 1) * steps[1] <= 2.0 * half_width; ++j)
      for (int i = 0; (i + 1) * steps[0] <= 2.0 * half_width; ++i) {
        Vector x((i + 0.5) * steps[0],
                 (j + 0.5) * steps[1] - half_width,
                 (k + 0.5) * steps[2] - half_width);
        if (is_dense) { // odd rows are shifted by half a step, odd layers to their gaps
          x[0] += ((j + k) % 2 == 0 ? -0.25 : 0.25) * steps[0];
          x[1] += k % 2 == 0 ? 0.0 : steps[1] / 3.0;
        }
        x[0] = std::copysign(x[0], spacing);
        pcl::PointXYZI point;
        point.getVector3fMap() = x.cast<float>();
        cloud.push_back(point);
      }
}

/** How edges through the channels of two lattices that meet look like: isopoints that
 * lie off the plane between them, and those that lie on it. */
struct ChannelCounts {
  std::size_t off = 0, right = 0, bridged = 0;
};

class LatticePair : public testing::TestWithParam<std::tuple<Packing, double>> {
protected:
  /** Densities on the two sides of a shock: the step between them is smooth over the
   * given length, 0 for two values only.
   * \param shift of all values: where some are below 0 there are no logarithms */
  static ChannelCounts
  countIsopoints(double shift)
  {
    const auto [packing, width] = GetParam();
    constexpr double dense = 1.0, thin = 0.125, isovalue = 0.3;
    Cloud::Ptr cloud(new Cloud);
    addLattice(packing, -1.0, *cloud);
    addLattice(packing, 2.0, *cloud);
    for (pcl::PointXYZI& point : *cloud) {
      const double part = width > 0.0 ? 1.0 / (1.0 + std::exp(point.x / width))
                                      : static_cast<double>(point.x < 0.0f);
      point.intensity = static_cast<float>(shift + thin + (dense - thin) * part);
    }
    // Two values have their step anywhere between the lattices.
    const double first = packing == Packing::Dense ? 0.25 : 0.5;
    const double plane = width * std::log((dense - isovalue) / (isovalue - thin));
    const double low = width > 0.0 ? plane : -first;
    const double high = width > 0.0 ? plane : 2.0 * first;
    ChannelCounts counts;
    for (const pcl_uvol::PointIso& point : extract(cloud, isovalue + shift)) {
      if (std::max(std::abs(point.y), std::abs(point.z)) > 5.0f)
        continue; // beside the border of the samples
      const bool is_bridged =
          point.support == static_cast<std::uint8_t>(IsoSupport::Bridged);
      const double deviation = std::max(low - point.x, point.x - high);
      if (deviation > 1.5) {
        ++counts.off;
        EXPECT_TRUE(is_bridged) << point.getVector3fMap().transpose();
      }
      else if (deviation < 1.0) {
        ++counts.right;
        counts.bridged += is_bridged;
      }
    }
    return counts;
  }
};

TEST_P(LatticePair, BridgesWhatIsOffThePlane)
{
  const ChannelCounts of_densities = countIsopoints(0.0),
                      of_values = countIsopoints(-0.3);
  for (const ChannelCounts& counts : {of_densities, of_values}) {
    EXPECT_GT(counts.right, 50u);
    EXPECT_LT(100 * counts.bridged, counts.right);
  }
  EXPECT_GT(of_values.off, 5u);
  EXPECT_LE(of_densities.off, of_values.off);
}

INSTANTIATE_TEST_SUITE_P(StretchedSamples,
                         LatticePair,
                         testing::Combine(testing::Values(Packing::Cubic,
                                                          Packing::Dense),
                                          testing::Values(0.0, 0.3, 0.6, 1.0)));

/** Isopoints that are not the linear root of their edge. */
std::size_t
countMoved(const Cloud::Ptr& cloud, const std::vector<double>& isovalues)
{
  Extraction extraction;
  extraction.setInputCloud(cloud);
  extraction.setIsoValues(isovalues);
  Surface surface;
  extraction.extract(surface);
  EXPECT_GT(surface.size(), 1000u);
  std::size_t moved = 0;
  for (std::size_t i = 0; i < surface.size(); ++i) {
    const auto& edge = extraction.getEdges()[i];
    const Eigen::Vector3f a = (*cloud)[edge.first].getVector3fMap();
    const Eigen::Vector3f b = (*cloud)[edge.second].getVector3fMap();
    moved += (a + edge.t * (b - a) - surface[i].getVector3fMap()).norm() > 1e-4f;
  }
  return moved;
}

TEST(LabelFields, AreLinearAlways)
{
  for (const bool lattice : {false, true}) {
    Cloud::Ptr two(new Cloud), four(new Cloud);
    for (std::uint64_t i = 0; i < 64000; ++i) {
      const auto x = pcl_uvol::scatterAt(lattice ? pcl_uvol::Scatter::Lattice
                                                 : pcl_uvol::Scatter::Uniform,
                                         1,
                                         i,
                                         64000,
                                         -20,
                                         20);
      pcl::PointXYZI point;
      point.getVector3fMap() = Vector(x.data()).cast<float>();
      const double r = Vector(x.data()).norm();
      point.intensity = r < 15.0 ? 0.25f : 0.5f;
      two->push_back(point);
      point.intensity = r < 10.0 ? 0.0f : r < 12.0 ? 2.0f : r < 13.0 ? 5.0f : 1.0f;
      four->push_back(point);
    }
    EXPECT_EQ(0u, countMoved(two, {0.4}));
    EXPECT_EQ(0u, countMoved(four, {0.5, 1.5, 2.5}));
  }
}

/** Long edges between random samples cross jumps as well as others do. */
TEST(LabelFields, HaveMeasuredIsopointsAtRandomSamples)
{
  constexpr std::uint64_t count = 30000;
  Cloud::Ptr cloud(new Cloud);
  for (std::uint64_t i = 0; i < count; ++i) {
    const auto x =
        pcl_uvol::scatterAt(pcl_uvol::Scatter::Uniform, 1, i, count, -20, 20);
    pcl::PointXYZI point;
    point.getVector3fMap() = Vector(x.data()).cast<float>();
    point.intensity = Vector(x.data()).norm() < 15.0 ? 1.0f : 2.0f;
    cloud->push_back(point);
  }
  const Surface surface = extract(cloud, 1.5);
  ASSERT_GT(surface.size(), 3000u);
  EXPECT_GE(partWith(IsoSupport::Measured, surface), 0.985);
}

TEST(LabelFields, AreNotWhatQuantisedDataAre)
{
  const SmoothField field = uvol_test::makeSmoothField("radial", 100000);
  const auto cloud = uvol_test::sampleSmoothField(field, 100000, 1, false);
  for (auto& point : *cloud)
    point.intensity = std::round(2.0f * point.intensity); // two steps per spacing
  Extraction extraction;
  extraction.setInputCloud(cloud);
  extraction.setIsoValue(26.5);
  Surface surface;
  extraction.extract(surface);
  EXPECT_LE(extraction.getReport().getCount("linear_step"), surface.size() / 1000);
}

} // namespace test_stretched_samples
