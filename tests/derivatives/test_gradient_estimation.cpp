// SPDX-License-Identifier: BSD-3-Clause
// Gradients and mean curvatures of scattered fields: exact where the polynomial is, of
// the order that it has, and nothing made up where samples do not tell.
#include "derivatives/local_fit.h"
#include "neighbors/nearest_neighbors.h"
#include "support/clouds.h"
#include "support/environment.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/derivatives/gradient_estimation.h>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <functional>

namespace test_gradient_estimation {

using pcl_uvol::FitScheme;
using pcl_uvol::InvalidArgument;
using Cloud = pcl::PointCloud<pcl::PointXYZI>;
using Gradients = pcl::PointCloud<pcl_uvol::PointGradient>;
using Estimation = pcl_uvol::GradientEstimation<pcl::PointXYZI>;
using Vector = Eigen::Vector3d;
using Field = std::function<double(const Vector&)>;

/** n random samples of a field in the cube [-1, 1]^3. */
Cloud::Ptr
sample(const Field& field, std::size_t n, std::uint64_t seed = 1)
{
  uvol_test::Random random(seed);
  const Cloud::Ptr cloud(new Cloud);
  for (std::size_t i = 0; i < n; ++i) {
    pcl::PointXYZI point;
    for (int axis = 0; axis < 3; ++axis)
      point.data[axis] = static_cast<float>(2.0 * random.uniform() - 1.0);
    point.intensity = static_cast<float>(field(point.getVector3fMap().cast<double>()));
    cloud->push_back(point);
  }
  return cloud;
}

Gradients
estimate(const Cloud::Ptr& cloud, FitScheme scheme, unsigned threads = 0)
{
  Estimation estimation;
  estimation.setInputCloud(cloud);
  estimation.setScheme(scheme);
  estimation.setNumberOfThreads(threads);
  Gradients gradients;
  estimation.compute(gradients);
  return gradients;
}

Vector
vectorOf(const pcl_uvol::PointGradient& gradient)
{
  return {gradient.gradient_x, gradient.gradient_y, gradient.gradient_z};
}

bool
isInside(const pcl::PointXYZI& point)
{
  return point.getVector3fMap().cwiseAbs().maxCoeff() < 0.7f;
}

TEST(GradientEstimation, ExactForLinearFunctions)
{
  const Vector slope(3.0, -2.0, 0.5);
  const auto cloud = sample([&](const Vector& x) { return slope.dot(x) + 4.0; }, 5000);
  // Values in single precision, over a spacing of 0.1.
  constexpr double rounding = 3e-5;
  for (const FitScheme scheme : {FitScheme::Linear, FitScheme::Quadratic}) {
    const auto gradients = estimate(cloud, scheme);
    ASSERT_EQ(cloud->size(), gradients.size());
    for (const pcl_uvol::PointGradient& gradient : gradients)
      EXPECT_LT((vectorOf(gradient) - slope).norm(), rounding);
  }
}

TEST(GradientEstimation, PlanarCloudsHaveAQuadraticInTheirPlane)
{
  const Vector across = Vector(1.0, 2.0, -2.0) / 3.0;
  const Eigen::Matrix3d in_plane =
      Eigen::Matrix3d::Identity() - across * across.transpose();
  Eigen::Matrix3d form;
  form << 2.0, 0.7, -0.4, 0.7, -1.0, 0.3, -0.4, 0.3, 1.5;
  const Vector slope(1.0, -2.0, 0.5);
  const auto cloud = sample([](const Vector&) { return 0.0; }, 2000);
  for (pcl::PointXYZI& point : *cloud) {
    const Vector place = in_plane * point.getVector3fMap().cast<double>();
    point.getVector3fMap() = place.cast<float>();
    point.intensity =
        static_cast<float>(0.5 * place.dot(form * place) + slope.dot(place));
  }
  const auto gradients = estimate(cloud, FitScheme::Quadratic);
  const Eigen::Matrix3d hessian = in_plane * form * in_plane;
  for (std::size_t i = 0; i < cloud->size(); ++i) {
    const Vector place = (*cloud)[i].getVector3fMap().cast<double>();
    const Vector gradient = hessian * place + in_plane * slope;
    EXPECT_LT((vectorOf(gradients[i]) - gradient).norm(), 1e-3);
    if (gradient.norm() < 0.5)
      continue;
    const Vector normal = gradient.normalized();
    const double curvature =
        (hessian.trace() - normal.dot(hessian * normal)) /
        (2.0 * gradient.norm()); // nothing changes across the plane
    EXPECT_NEAR(curvature, gradients[i].mean_curvature, 0.02);
  }
}

TEST(GradientEstimation, ReducedFitsHaveNoCurvature)
{
  const auto cloud = sample([](const Vector& x) { return 3.0 * x[0] + x[1]; }, 8);
  for (const pcl_uvol::PointGradient& gradient :
       estimate(cloud, FitScheme::Quadratic)) {
    EXPECT_LT((vectorOf(gradient) - Vector(3.0, 1.0, 0.0)).norm(), 1e-4);
    EXPECT_TRUE(std::isnan(gradient.mean_curvature));
  }
}

TEST(GradientEstimation, ExactForQuadraticFunctions)
{
  const auto f = [](const Vector& x) {
    return x[0] * x[0] - 2.0 * x[1] * x[1] + 0.5 * x[2] * x[2] + x[0] * x[1] -
           x[1] * x[2] + 3.0 * x[0];
  };
  const auto cloud = sample(f, 5000);
  const auto gradients = estimate(cloud, FitScheme::Quadratic);
  for (std::size_t i = 0; i < cloud->size(); ++i) {
    const Vector x = (*cloud)[i].getVector3fMap().cast<double>();
    const Vector expected(
        2.0 * x[0] + x[1] + 3.0, -4.0 * x[1] + x[0] - x[2], x[2] - x[1]);
    EXPECT_LT((vectorOf(gradients[i]) - expected).norm(), 1e-4);
    Eigen::Matrix3d hessian;
    hessian << 2, 1, 0, 1, -4, -1, 0, -1, 1;
    const Vector normal = expected.normalized();
    const double curvature =
        (hessian.trace() - normal.dot(hessian * normal)) / (2.0 * expected.norm());
    EXPECT_NEAR(gradients[i].mean_curvature, curvature, 5e-3);
  }
}

/** Thesis 3.2 taken literally: A^T A a = A^T b. */
TEST(GradientEstimation, LinearSchemeIsTheThesissLeastSquares)
{
  const auto cloud =
      sample([](const Vector& x) { return std::sin(3.0 * x.sum()); }, 400);
  const auto gradients = estimate(cloud, FitScheme::Linear);
  const auto samples = uvol_test::buildSamples(*cloud);
  pcl_uvol::Report report;
  const auto graph = pcl_uvol::computeNearestNeighbors(*samples, 26, 0, report);
  for (std::size_t i = 0; i < graph.size(); ++i) {
    Eigen::MatrixXd a(graph[i].size() + 1, 4);
    Eigen::VectorXd b(a.rows());
    const auto set = [&](Eigen::Index row, std::size_t j) {
      const auto& point = (*cloud)[samples->getInputIndex(j)];
      a.row(row) << point.x, point.y, point.z, 1.0;
      b[row] = point.intensity;
    };
    set(0, i);
    for (std::size_t j = 0; j < graph[i].size(); ++j)
      set(static_cast<Eigen::Index>(j) + 1, graph[i].first[j]);
    const Eigen::MatrixXd normal = a.transpose() * a;
    const Eigen::VectorXd right = a.transpose() * b;
    const Eigen::VectorXd solution = normal.fullPivLu().solve(right);
    EXPECT_LT(
        (vectorOf(gradients[samples->getInputIndex(i)]) - solution.head<3>()).norm(),
        1e-5);
  }
}

/** Root mean squares of the errors of gradient and curvature, inside the cube. */
std::pair<double, double>
errorsOf(FitScheme scheme, std::size_t n)
{
  // Level sets are spheres about a place outside of the cube; the slope changes.
  const Vector center(0.0, 0.0, -2.0);
  const auto f = [&](const Vector& x) { return std::log((x - center).norm()); };
  const auto cloud = sample(f, n);
  const auto gradients = estimate(cloud, scheme);
  double gradient = 0.0, curvature = 0.0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < cloud->size(); ++i) {
    if (!isInside((*cloud)[i]))
      continue;
    const Vector r = (*cloud)[i].getVector3fMap().cast<double>() - center;
    gradient += (vectorOf(gradients[i]) - r / r.squaredNorm()).squaredNorm();
    curvature += std::pow(gradients[i].mean_curvature - 1.0 / r.norm(), 2);
    ++count;
  }
  return {std::sqrt(gradient / static_cast<double>(count)),
          std::sqrt(curvature / static_cast<double>(count))};
}

TEST(GradientEstimation, OrdersOfConvergence)
{
  const auto order = [](double coarse, double fine) {
    return std::log2(coarse / fine) / std::log2(4.0); // of length, for 64 times as many
  };
  const auto linear_coarse = errorsOf(FitScheme::Linear, 4000);
  const auto linear_fine = errorsOf(FitScheme::Linear, 256000);
  const auto coarse = errorsOf(FitScheme::Quadratic, 4000);
  const auto fine = errorsOf(FitScheme::Quadratic, 256000);
  EXPECT_NEAR(1.0, order(linear_coarse.first, linear_fine.first), 0.2);
  EXPECT_NEAR(2.0, order(coarse.first, fine.first), 0.2);
  EXPECT_NEAR(1.0, order(coarse.second, fine.second), 0.2);
  EXPECT_LT(fine.first, 0.2 * linear_fine.first);
}

TEST(GradientEstimation, NothingIsMadeUpAcrossAPlaneOrALine)
{
  for (const char* shape : {"planar", "linear", "oblique line"}) {
    const auto cloud = uvol_test::makeCloud(shape, 300, 1);
    for (auto& point : *cloud)
      point.intensity = 2.0f * point.x + 3.0f * point.y + 5.0f * point.z;
    Eigen::Matrix3Xd offsets(3, cloud->size());
    for (std::size_t i = 0; i < cloud->size(); ++i)
      offsets.col(static_cast<Eigen::Index>(i)) =
          ((*cloud)[i].getVector3fMap() - (*cloud)[0].getVector3fMap()).cast<double>();
    for (const FitScheme scheme : {FitScheme::Linear, FitScheme::Quadratic}) {
      Estimation estimation;
      estimation.setInputCloud(cloud);
      estimation.setScheme(scheme);
      Gradients gradients;
      estimation.compute(gradients);
      EXPECT_EQ(cloud->size(), estimation.getReport().getCount("singular_fits"))
          << shape;
      for (const pcl_uvol::PointGradient& gradient : gradients) {
        // Along the samples it is right, and no longer than that.
        const Vector found = vectorOf(gradient);
        const Vector rest = found - Vector(2.0, 3.0, 5.0);
        EXPECT_LT((offsets.transpose() * rest).cwiseAbs().maxCoeff(), 1e-3) << shape;
        EXPECT_LT(found.norm(), Vector(2.0, 3.0, 5.0).norm()) << shape;
      }
    }
  }
}

TEST(GradientEstimation, ConstantFieldsAndFewSamples)
{
  const auto constant =
      estimate(sample([](const Vector&) { return 7.0; }, 200), FitScheme::Quadratic);
  for (const pcl_uvol::PointGradient& gradient : constant) {
    EXPECT_EQ(0.0, vectorOf(gradient).norm());
    EXPECT_TRUE(std::isnan(gradient.mean_curvature));
  }
  // Fewer samples than neighbours are asked for: all others; too few for a quadratic.
  const auto few = sample([](const Vector& x) { return x[0]; }, 6);
  for (const pcl_uvol::PointGradient& gradient : estimate(few, FitScheme::Quadratic))
    EXPECT_LT((vectorOf(gradient) - Vector::UnitX()).norm(), 1e-4);
}

TEST(GradientEstimation, AnOnlySampleHasNoGradient)
{
  const auto one = sample([](const Vector& x) { return x[0]; }, 1);
  for (const FitScheme scheme : {FitScheme::Linear, FitScheme::Quadratic}) {
    const auto gradients = estimate(one, scheme);
    ASSERT_EQ(1u, gradients.size());
    EXPECT_FALSE(gradients.is_dense);
    EXPECT_TRUE(vectorOf(gradients[0]).array().isNaN().all());
    EXPECT_TRUE(std::isnan(gradients[0].mean_curvature));
  }
}

TEST(GradientEstimation, SameBytesForAnyNumberOfThreads)
{
  const auto cloud =
      sample([](const Vector& x) { return std::sin(5.0 * x[0]); }, 20000);
  for (const FitScheme scheme : {FitScheme::Linear, FitScheme::Quadratic}) {
    const auto one = estimate(cloud, scheme, 1);
    for (const unsigned threads : {2u, 3u, 7u}) {
      const auto several = estimate(cloud, scheme, threads);
      EXPECT_EQ(0,
                std::memcmp(one.points.data(),
                            several.points.data(),
                            sizeof(pcl_uvol::PointGradient) * one.size()));
    }
  }
}

TEST(GradientEstimation, PointsWithoutAValueGetNone)
{
  const auto cloud = sample([](const Vector& x) { return x[0]; }, 500);
  (*cloud)[3].x = std::numeric_limits<float>::quiet_NaN();
  (*cloud)[5].intensity = std::numeric_limits<float>::infinity();
  (*cloud)[7] = (*cloud)[8];
  (*cloud)[7].intensity += 0.5f; // the median of two is their mean
  (*cloud)[8].intensity -= 0.5f;
  Estimation estimation;
  estimation.setInputCloud(cloud);
  Gradients gradients;
  estimation.compute(gradients);
  EXPECT_TRUE(std::isnan(gradients[3].gradient_x));
  EXPECT_TRUE(std::isnan(gradients[5].gradient_x));
  EXPECT_NEAR(1.0, gradients[7].gradient_x, 1e-4);
  EXPECT_EQ(gradients[7].gradient_x, gradients[8].gradient_x);
  EXPECT_FALSE(gradients.is_dense);
  EXPECT_EQ(1u, estimation.getReport().getCount("non_finite"));
  EXPECT_EQ(1u, estimation.getReport().getCount("no_value"));
  EXPECT_EQ(1u, estimation.getReport().getCount("duplicates"));
}

TEST(GradientEstimation, RejectsBadInput)
{
  Gradients untouched;
  untouched.resize(2);
  Estimation estimation;
  EXPECT_THROW(estimation.compute(untouched), InvalidArgument);
  estimation.setInputCloud(sample([](const Vector& x) { return x[0]; }, 100));
  estimation.setScalarField("temperature");
  EXPECT_THROW(estimation.compute(untouched), InvalidArgument);
  estimation.setScalarField("intensity");
  estimation.setKSearch(8);
  EXPECT_THROW(estimation.compute(untouched), InvalidArgument);
  estimation.setScheme(FitScheme::Linear);
  estimation.setKSearch(2);
  EXPECT_THROW(estimation.compute(untouched), InvalidArgument);
  estimation.setKSearch(26);
  const Cloud::Ptr none(new Cloud);
  none->resize(3);
  for (auto& point : *none)
    point.intensity = std::numeric_limits<float>::quiet_NaN();
  estimation.setInputCloud(none);
  EXPECT_THROW(estimation.compute(untouched), InvalidArgument);
  estimation.setInputCloud(Cloud::Ptr(new Cloud));
  EXPECT_THROW(estimation.compute(untouched), InvalidArgument);
  EXPECT_EQ(2u, untouched.size());
}

} // namespace test_gradient_estimation
