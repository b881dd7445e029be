// SPDX-License-Identifier: BSD-3-Clause
// The experiment of thesis 3.6: gradients by local fits at random samples beside
// central differences of step 1 on the function itself.
#include "common/parallel.h"
#include "derivatives/local_fit.h"
#include "neighbors/nearest_neighbors.h"
#include "support/clouds.h"
#include "support/environment.h"
#include "support/statistics.h"
#include <pcl_uvol/derivatives/gradient_estimation.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <vector>

namespace {

using Eigen::Vector3d;
using pcl_uvol::FitScheme;
using uvol_test::computeMean;

constexpr double side = 100.0;
constexpr std::size_t neighbors = 26;

struct Function {
  const char* name;
  std::function<double(const Vector3d&)> value;
  std::function<Vector3d(const Vector3d&)> gradient;
};

/** x^n + y^n + z^n */
Function
power(const char* name, int n)
{
  return {name,
          [n](const Vector3d& x) { return x.array().pow(n).sum(); },
          [n](const Vector3d& x) -> Vector3d { return n * x.array().pow(n - 1); }};
}

/** sin(x / length) + cos(y / length) + sin(z / length) */
Function
waves(const char* name, double length)
{
  return {name,
          [length](const Vector3d& x) {
            return std::sin(x[0] / length) + std::cos(x[1] / length) +
                   std::sin(x[2] / length);
          },
          [length](const Vector3d& x) -> Vector3d {
            return Vector3d(std::cos(x[0] / length),
                            -std::sin(x[1] / length),
                            std::cos(x[2] / length)) /
                   length;
          }};
}

std::vector<Function>
functions()
{
  return {power("x + y + z", 1),
          power("x^2 + y^2 + z^2", 2),
          power("x^3 + y^3 + z^3", 3),
          power("x^4 + y^4 + z^4", 4),
          power("x^5 + y^5 + z^5", 5),
          {"x y z / (x + y + z + 100)",
           [](const Vector3d& x) { return x.prod() / (x.sum() + side); },
           [](const Vector3d& x) -> Vector3d {
             const double sum = x.sum() + side;
             return Vector3d(x[1] * x[2], x[0] * x[2], x[0] * x[1]) / sum -
                    Vector3d::Constant(x.prod() / (sum * sum));
           }},
          {"1 / (x^5 + y^5 + z^5 + 100^5)",
           [](const Vector3d& x) {
             return 1.0 / (x.array().pow(5).sum() + std::pow(side, 5));
           },
           [](const Vector3d& x) -> Vector3d {
             return -5.0 * x.array().pow(4) /
                    std::pow(x.array().pow(5).sum() + std::pow(side, 5), 2);
           }},
          waves("sin x/50 + cos y/50 + sin z/50", 50.0),
          waves("sin x/10 + cos y/10 + sin z/10", 10.0)};
}

Vector3d
centralDifferences(const Function& function, const Vector3d& x)
{
  Vector3d gradient;
  for (int axis = 0; axis < 3; ++axis)
    gradient[axis] = 0.5 * (function.value(x + Vector3d::Unit(axis)) -
                            function.value(x - Vector3d::Unit(axis)));
  return gradient;
}

/** Samples, their neighbours and the errors of gradients at them. */
class Experiment {
public:
  explicit Experiment(std::size_t n)
      : cloud_(new pcl::PointCloud<pcl::PointXYZI>)
  {
    uvol_test::Random random(1);
    for (std::size_t i = 0; i < n; ++i) {
      pcl::PointXYZI point;
      for (int axis = 0; axis < 3; ++axis)
        point.data[axis] = static_cast<float>(side * random.uniform());
      cloud_->push_back(point);
    }
    pcl_uvol::Report report;
    samples_ = uvol_test::buildSamples(*cloud_);
    graph_ = pcl_uvol::computeNearestNeighbors(*samples_, neighbors, 0, report);
  }

  /** Mean relative error, from values in double precision. */
  double
  error(const Function& function, FitScheme scheme) const
  {
    std::vector<double> values(samples_->size());
    for (std::size_t i = 0; i < values.size(); ++i)
      values[i] = function.value(at(i));
    return meanError(function, [&](std::size_t i) -> Vector3d {
      pcl_uvol::LocalFit fit(scheme);
      fit.fit(samples_->getPositions(),
              static_cast<std::uint32_t>(i),
              graph_[i].first,
              graph_[i].size());
      Vector3d gradient = Vector3d::Zero();
      for (std::size_t axis = 0; axis < 3; ++axis)
        for (std::size_t j = 0; j < graph_[i].size(); ++j)
          gradient[static_cast<Eigen::Index>(axis)] +=
              fit.getWeights(axis)[j] * (values[graph_[i].first[j]] - values[i]);
      return gradient;
    });
  }

  double
  errorOfCentralDifferences(const Function& function) const
  {
    return meanError(
        function, [&](std::size_t i) { return centralDifferences(function, at(i)); });
  }

  /** The error of GradientEstimation, from values in single precision. */
  double
  errorOfEstimation(const Function& function)
  {
    for (auto& point : *cloud_)
      point.intensity =
          static_cast<float>(function.value(point.getVector3fMap().cast<double>()));
    pcl_uvol::GradientEstimation<pcl::PointXYZI> estimation;
    estimation.setInputCloud(cloud_);
    pcl::PointCloud<pcl_uvol::PointGradient> gradients;
    estimation.compute(gradients);
    return meanError(function, [&](std::size_t i) -> Vector3d {
      const pcl_uvol::PointGradient& found = gradients[samples_->getInputIndex(i)];
      return Vector3d(found.gradient_x, found.gradient_y, found.gradient_z);
    });
  }

private:
  Vector3d
  at(std::size_t i) const
  {
    return (*cloud_)[samples_->getInputIndex(i)].getVector3fMap().cast<double>();
  }

  template <typename Gradient>
  double
  meanError(const Function& function, const Gradient& gradient) const
  {
    std::vector<double> errors(samples_->size());
    pcl_uvol::parallelBlocks(errors.size(), 1024, 0, [&](auto begin, auto end) {
      for (std::size_t i = begin; i < end; ++i) {
        const Vector3d exact = function.gradient(at(i));
        errors[i] = (exact - gradient(i)).norm() / exact.norm();
      }
    });
    return computeMean(errors);
  }

  pcl::PointCloud<pcl::PointXYZI>::Ptr cloud_;
  pcl_uvol::SampleSet::ConstPtr samples_;
  pcl_uvol::NeighborGraph graph_;
};

} // namespace

/** derivatives [SAMPLES]: one row per function. */
int
main(int argc, char** argv)
{
  Experiment experiment(argc > 1 ? static_cast<std::size_t>(std::atof(argv[1]))
                                 : 1000000);
  std::puts("| function | central differences, step 1 | linear fit | quadratic fit | "
            "quadratic fit, single precision |\n|---|---|---|---|---|");
  for (const Function& function : functions())
    std::printf("| %s | %.1e | %.1e | %.1e | %.1e |\n",
                function.name,
                experiment.errorOfCentralDifferences(function),
                experiment.error(function, FitScheme::Linear),
                experiment.error(function, FitScheme::Quadratic),
                experiment.errorOfEstimation(function));
  return 0;
}
