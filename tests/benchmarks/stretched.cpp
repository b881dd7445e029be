// SPDX-License-Identifier: BSD-3-Clause
// Isosurfaces of samples that lie denser along one direction than along others: how far
// isopoints lie from the true surface, and how many know that they rest on samples.
#include "support/stretched_samples.h"
#include <pcl_uvol/isosurface/isosurface_extraction.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <string>
#include <vector>

namespace {

using Surface = pcl::PointCloud<pcl_uvol::PointIso>;

void
printRow(const std::string& shape, double ratio, int side)
{
  const auto n = static_cast<std::size_t>(side) * side * side;
  const auto field = uvol_test::makeSmoothField("radial", n);
  const auto samples = uvol_test::makeStretchedSamples(shape, ratio, side);
  pcl_uvol::IsosurfaceExtraction<pcl::PointXYZI> extraction;
  extraction.setInputCloud(samples.sample(field, side, 1));
  extraction.setIsoValue(field.isovalue);
  Surface surface;
  extraction.extract(surface); // builds the tree
  const auto start = std::chrono::steady_clock::now();
  extraction.extract(surface);
  const std::chrono::duration<double, std::micro> spent =
      std::chrono::steady_clock::now() - start;
  const auto found = uvol_test::deviations(field, samples.inIndexSpace(surface));
  // Where the errors are, which are lengths in space.
  auto moved = field;
  moved.value = [&](const Eigen::Vector3d& x) {
    return field.value(samples.to_index(x));
  };
  const auto in_space = uvol_test::deviations(moved, surface);
  std::vector<double> ratios;
  for (std::size_t i = 0; i < surface.size(); ++i)
    ratios.push_back(surface[i].error / in_space[i]);
  const auto points = static_cast<double>(surface.size());
  const auto covered =
      std::count_if(ratios.begin(), ratios.end(), [](double r) { return r >= 1.0; });
  const auto part = [&](const char* name) {
    return 100.0 * static_cast<double>(extraction.getReport().getCount(name)) / points;
  };
  std::printf("%s,1 : %.3g,%zu,%.2g,%.2g,%.1f,%.1f,%.1f,%.2g,%.2f\n",
              shape.c_str(),
              ratio,
              surface.size(),
              uvol_test::mean(found),
              uvol_test::quantile(found, 0.999),
              part("linear_singular") + part("linear_step") + part("linear_far"),
              part("bridged") + part("rim"),
              100.0 * static_cast<double>(covered) / points,
              uvol_test::quantile(ratios, 0.5),
              spent.count() / points);
  std::fflush(stdout);
}

/** A field with jumps, as a function of the index space; its surfaces are spheres. */
struct JumpField {
  const char* name;
  uvol_test::SmoothField field;
  std::vector<double> radii; ///< of the spheres
};

std::vector<JumpField>
makeJumpFields(std::size_t n)
{
  const auto radial = uvol_test::makeSmoothField("radial", n);
  const double radius = radial.isovalue;
  auto jump = radial, shell = radial;
  jump.value = [=](const Eigen::Vector3d& x) {
    const double part = x.norm() / radius;
    return (part < 1.0 ? 10.0 : 4.0) - 2.0 * part;
  };
  jump.isovalue = 5.0;
  shell.value = [=](const Eigen::Vector3d& x) {
    return (std::abs(x.norm() / radius - 0.9) < 0.1 ? 6.0 : 1.0) + 0.5 * x.x() / radius;
  };
  shell.isovalue = 3.5;
  return {{"radial", radial, {radius}},
          {"jump", jump, {radius}},
          {"shell", shell, {radius, 0.8 * radius}}};
}

void
printJumpRow(const JumpField& jump, const std::string& shape, double ratio, int side)
{
  const auto samples = uvol_test::makeStretchedSamples(shape, ratio, side);
  pcl_uvol::IsosurfaceExtraction<pcl::PointXYZI> extraction;
  extraction.setInputCloud(samples.sample(jump.field, side, 1));
  extraction.setIsoValue(jump.field.isovalue);
  Surface surface;
  extraction.extract(surface);
  std::vector<double> deviations;
  for (const auto& point : samples.inIndexSpace(surface)) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const double radius : jump.radii)
      nearest = std::min(
          nearest, std::abs(point.getVector3fMap().cast<double>().norm() - radius));
    deviations.push_back(nearest);
  }
  std::printf("%-7s %-9s %5.3g %7zu %9.3g %9.3g %9.3g\n",
              jump.name,
              shape.c_str(),
              ratio,
              surface.size(),
              uvol_test::mean(deviations),
              uvol_test::quantile(deviations, 0.99),
              uvol_test::quantile(deviations, 1.0));
  std::fflush(stdout);
}

void
printJumps(int side, const std::vector<std::string>& shapes)
{
  std::puts("# field  shape    ratio  points      mean      99_%   largest");
  for (const JumpField& jump :
       makeJumpFields(static_cast<std::size_t>(side) * side * side))
    for (const std::string& shape : shapes)
      for (const double ratio : {1.0, 2.0, 3.0, 10.0, 30.0})
        printJumpRow(jump, shape, ratio, side);
}

} // namespace

/** stretched SIDE [jumps] SHAPE... : one row of CSV per shape and ratio; with jumps, a
 * table of fields that have some as well. */
int
main(int argc, char** argv)
{
  if (argc < 3) {
    std::fputs("usage: stretched SIDE [jumps] "
               "lattice|rotated|wall|curved|jittered|shaken...\n",
               stderr);
    return 2;
  }
  if (std::string(argv[2]) == "jumps") {
    printJumps(std::atoi(argv[1]), {argv + 3, argv + argc});
    return 0;
  }
  std::puts(
      "shape,cells,isopoints,mean,99.9 %,\"on their edge, %\",\"not measured, %\","
      "\"covered, %\",median ratio,us per isopoint");
  for (int i = 2; i < argc; ++i)
    for (const double ratio : {1.0, 1.5, 2.0, 3.0, 4.0, 6.0, 10.0, 30.0})
      printRow(argv[i], ratio, std::atoi(argv[1]));
  return 0;
}
