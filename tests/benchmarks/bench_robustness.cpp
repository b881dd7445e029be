// SPDX-License-Identifier: BSD-3-Clause
// What awkward data cost beside even ones, as ratios of one run: layouts with gaps,
// duplicates, two threads where one would do.
// usage: bench_robustness [SAMPLES] [layouts|duplicates|threads|names|once] [PART OF A
// LAYOUT'S NAME]; once extracts one layout a single time, for layouts.sh
#include "neighbors/sample_set.h"
#include "support/environment.h"
#include <pcl_uvol/isosurface/isosurface_extraction.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

namespace {

using Cloud = pcl::PointCloud<pcl::PointXYZI>;

constexpr double pi = 3.14159265358979;

/** Coordinates, and a value whose sign parts inside from outside. */
struct Sample {
  double x, y, z, value;
};

/** Sample i of n of a layout. */
using Layout = std::function<Sample(uvol_test::Random&, std::size_t, std::size_t)>;

struct NamedLayout {
  const char* name;
  Layout sample;
};

double
radius(const Sample& s)
{
  return std::sqrt(s.x * s.x + s.y * s.y + s.z * s.z);
}

/** Even in the cube of side 1 about the origin. */
Sample
inCube(uvol_test::Random& random)
{
  return {random.uniform() - 0.5, random.uniform() - 0.5, random.uniform() - 0.5, 0.0};
}

/** With the sphere of radius 0.3 as its surface. */
Sample
withBall(Sample s)
{
  s.value = radius(s) - 0.3;
  return s;
}

Sample
onSphere(uvol_test::Random& random, double r, double value)
{
  const double z = 2.0 * random.uniform() - 1.0, angle = 2.0 * pi * random.uniform();
  const double across = std::sqrt(1.0 - z * z);
  return {r * across * std::cos(angle), r * across * std::sin(angle), r * z, value};
}

Sample
moved(Sample s, double scale, double x)
{
  return {scale * s.x + x, scale * s.y, scale * s.z, s.value};
}

/** Halves of the samples, of opposite values. */
Layout
clusters(double scale, double distance)
{
  return [=](uvol_test::Random& random, std::size_t i, std::size_t) {
    Sample s = inCube(random);
    s.value = i % 2 == 0 ? -1.0 : 1.0;
    return i % 2 == 0 ? s : moved(s, scale, distance);
  };
}

/** Ten samples amid others. */
Layout
tenAmid(const Layout& others, const std::function<Sample(uvol_test::Random&)>& amid)
{
  return [=](uvol_test::Random& random, std::size_t i, std::size_t n) {
    if (i >= 10)
      return others(random, i, n);
    Sample s = amid(random);
    s.value = -1.0;
    return s;
  };
}

const std::vector<NamedLayout>&
layouts()
{
  using Random = uvol_test::Random;
  const auto sphere = [](Random& random, std::size_t, std::size_t) {
    return onSphere(random, 1.0, 1.0);
  };
  const auto plane = [](Random& random, std::size_t, std::size_t) {
    Sample s = inCube(random);
    s.z = 0.0;
    s.value = 1.0;
    return s;
  };
  const auto ball = [](Random& random, std::size_t, std::size_t) {
    return withBall(inCube(random));
  };
  const auto small = [](Random& random) { return moved(inCube(random), 0.1, 0.0); };
  static const std::vector<NamedLayout> all = {
      {"uniform", ball},
      {"two clusters, 1000 sides apart", clusters(1.0, 1e3)},
      {"two clusters, 1e7 sides apart", clusters(1.0, 1e7)},
      {"two clusters, 1 : 1e6", clusters(1e-6, 2.0)},
      {"ten at the centre of a sphere", tenAmid(sphere, small)},
      {"ten on the axis of a cylinder",
       tenAmid(
           [](Random& random, std::size_t, std::size_t) {
             const double angle = 2.0 * pi * random.uniform();
             return Sample{
                 std::cos(angle), std::sin(angle), 2.0 * random.uniform() - 1.0, 1.0};
           },
           [](Random& random) {
             return Sample{0.0, 0.0, 2.0 * random.uniform() - 1.0, 0.0};
           })},
      {"ten at the centre of a cube's faces",
       tenAmid(
           [](Random& random, std::size_t i, std::size_t) {
             Sample s = inCube(random);
             (i % 3 == 0 ? s.x : i % 3 == 1 ? s.y : s.z) = i % 2 == 0 ? 0.5 : -0.5;
             s.value = 1.0;
             return s;
           },
           small)},
      {"two shells",
       [](Random& random, std::size_t i, std::size_t) {
         return i % 2 == 0 ? onSphere(random, 1.0, 1.0) : onSphere(random, 0.5, -1.0);
       }},
      {"a ball in a shell",
       [](Random& random, std::size_t i, std::size_t) {
         if (i % 2 == 0)
           return onSphere(random, 1.0, 1.0);
         Sample s = moved(inCube(random), 0.2, 0.0);
         s.value = -1.0;
         return s;
       }},
      {"ten above a plane",
       tenAmid(plane,
               [](Random& random) {
                 Sample s = inCube(random);
                 s.z = 100.0;
                 return s;
               })},
      {"two sheets, 100 sides apart",
       [](Random& random, std::size_t i, std::size_t) {
         Sample s = inCube(random);
         s.z = i % 2 == 0 ? 0.0 : 100.0;
         s.value = i % 2 == 0 ? -1.0 : 1.0;
         return s;
       }},
      {"ten sheets",
       [](Random& random, std::size_t i, std::size_t) {
         Sample s = inCube(random);
         s.z = static_cast<double>(i % 10) / 10.0 - 0.45;
         return withBall(s);
       }},
      {"a line",
       [](Random& random, std::size_t, std::size_t) {
         const double x = random.uniform() - 0.5;
         return Sample{x, 0.0, 0.0, std::sin(1e5 * x)};
       }},
      {"a thousand lines",
       [](Random& random, std::size_t i, std::size_t) {
         Sample s = inCube(random);
         Random place(i % 1000);
         s.x = place.uniform() - 0.5;
         s.y = place.uniform() - 0.5;
         return withBall(s);
       }},
      {"a lattice",
       [](Random&, std::size_t i, std::size_t n) {
         const auto side = static_cast<std::size_t>(
             std::ceil(std::cbrt(static_cast<double>(n)) - 1e-9));
         const auto at = [&](std::size_t place) {
           return static_cast<double>(place % side) / static_cast<double>(side) - 0.5;
         };
         return withBall({at(i), at(i / side), at(i / side / side), 0.0});
       }},
      {"a lattice in a plane",
       [](Random&, std::size_t i, std::size_t n) {
         const auto side = static_cast<std::size_t>(
             std::ceil(std::sqrt(static_cast<double>(n)) - 1e-9));
         const auto at = [&](std::size_t place) {
           return static_cast<double>(place % side) / static_cast<double>(side) - 0.5;
         };
         Sample s{at(i), at(i / side), 0.0, 0.0};
         s.value = std::sin(200.0 * s.x);
         return s;
       }},
      {"a spiral",
       [](Random&, std::size_t i, std::size_t n) {
         const double t = static_cast<double>(i) / static_cast<double>(n);
         const double r = std::exp(-10.0 * t), angle = 400.0 * pi * t;
         return Sample{
             r * std::cos(angle), r * std::sin(angle), t, std::sin(1.7 * angle)};
       }},
      {"uniform and one stray, 1e6 sides off",
       [](Random& random, std::size_t i, std::size_t) {
         Sample s = withBall(inCube(random));
         return i == 0 ? Sample{1e6, 0.0, 0.0, 1.0} : s;
       }},
      {"one stray of the other value",
       [](Random& random, std::size_t i, std::size_t) {
         Sample s = inCube(random);
         s.value = -1.0;
         return i == 0 ? Sample{1e3, 0.0, 0.0, 1.0} : s;
       }},
      {"density falling by 1e12 from the centre",
       [](Random& random, std::size_t, std::size_t) {
         const double r = std::pow(10.0, -4.0 * random.uniform());
         return onSphere(random, r, r - 0.01);
       }},
      {"a spherical void",
       [](Random& random, std::size_t, std::size_t) {
         Sample s = inCube(random);
         while (radius(s) < 0.45)
           s = inCube(random);
         s.value = s.x;
         return s;
       }},
      {"a half a thousand times as dense",
       [](Random& random, std::size_t i, std::size_t) {
         Sample s = inCube(random);
         s.x = i % 1000 == 0 ? 0.5 * random.uniform() : -0.5 * random.uniform();
         s.value = s.x;
         return s;
       }}};
  return all;
}

Cloud::Ptr
makeCloud(const Layout& layout, std::size_t n)
{
  uvol_test::Random random(1);
  Cloud::Ptr cloud(new Cloud);
  cloud->reserve(n);
  for (std::size_t i = 0; i < n; ++i) {
    const Sample s = layout(random, i, n);
    pcl::PointXYZI point;
    point.x = static_cast<float>(s.x);
    point.y = static_cast<float>(s.y);
    point.z = static_cast<float>(s.z);
    point.intensity = static_cast<float>(s.value);
    cloud->push_back(point);
  }
  return cloud;
}

double
millisecondsOf(const pcl_uvol::Report& report, const std::string& step)
{
  for (const auto& [name, milliseconds] : report.milliseconds)
    if (name == step)
      return milliseconds;
  return 0.0;
}

/** Extractions of one cloud; the least times of several. */
class Extraction {
public:
  explicit Extraction(const Cloud::Ptr& cloud)
  {
    extraction_.setInputCloud(cloud);
    extraction_.setIsoValue(0.0);
    extraction_.setNumberOfThreads(1);
    run();
    tree_ = millisecondsOf(extraction_.getReport(), "tree");
    for (const auto& step : extraction_.getReport().milliseconds)
      all_ += step.second;
  }

  void
  run()
  {
    extraction_.extract(surface_);
    fits_ = std::min(fits_, millisecondsOf(extraction_.getReport(), "smooth_roots"));
  }

  std::size_t
  isopoints() const
  {
    return surface_.size();
  }

  double
  tree() const
  {
    return tree_;
  }

  double
  all() const
  {
    return all_;
  }

  /** Microseconds per isopoint. */
  double
  fit() const
  {
    return 1e3 * fits_ / static_cast<double>(std::max<std::size_t>(1, isopoints()));
  }

private:
  pcl_uvol::IsosurfaceExtraction<pcl::PointXYZI> extraction_;
  pcl::PointCloud<pcl_uvol::PointIso> surface_;
  double tree_ = 0.0, all_ = 0.0, fits_ = std::numeric_limits<double>::infinity();
};

/** Each layout in turn with even samples, since machines waver. */
void
compareLayouts(std::size_t n, const std::string& wanted)
{
  std::printf("%zu samples, one thread; ratios to uniform ones, run in turn\n", n);
  std::printf("%-40s %9s %9s %7s %9s %7s %9s %7s\n",
              "layout",
              "isopoints",
              "tree [ms]",
              "ratio",
              "fits [us]",
              "ratio",
              "all [ms]",
              "ratio");
  const auto even_cloud = makeCloud(layouts().front().sample, n);
  for (const NamedLayout& layout : layouts()) {
    if (std::string(layout.name).find(wanted) == std::string::npos)
      continue;
    Extraction even(even_cloud), found(makeCloud(layout.sample, n));
    for (int run = 0; run < 4; ++run) {
      even.run();
      found.run();
    }
    std::printf("%-40s %9zu %9.0f %7.2f %9.2f %7.2f %9.0f %7.2f\n",
                layout.name,
                found.isopoints(),
                found.tree(),
                found.tree() / even.tree(),
                found.fit(),
                found.fit() / even.fit(),
                found.all(),
                found.all() / even.all());
    std::fflush(stdout);
  }
}

/** Extract the isosurface of one layout, as often as a profiler needs: once. */
void
extractOnce(std::size_t n, const std::string& name)
{
  for (const NamedLayout& layout : layouts())
    if (layout.name == name)
      std::printf("%zu isopoints\n",
                  Extraction(makeCloud(layout.sample, n)).isopoints());
}

double
buildMilliseconds(const Cloud& cloud)
{
  std::vector<std::uint32_t> all(cloud.size());
  std::iota(all.begin(), all.end(), 0u);
  pcl_uvol::Report report;
  pcl_uvol::SampleSet::build(cloud.front().data,
                             sizeof(pcl::PointXYZI) / sizeof(float),
                             all,
                             pcl_uvol::Position{{1.0f, 1.0f, 1.0f}},
                             1,
                             report);
  return millisecondsOf(report, "tree");
}

/** The tree over points of which some stand at the place of another one. */
void
compareDuplicates(std::size_t n)
{
  const Cloud distinct = *makeCloud(layouts().front().sample, n);
  Cloud one = distinct, pairs = distinct, few = distinct;
  one.back() = one.front();
  for (std::size_t i = 0; i < n; ++i) {
    pairs[i] = distinct[i / 2 * 2];
    few[i] = distinct[i % 1000];
  }
  std::vector<double> least(4, std::numeric_limits<double>::infinity());
  for (int run = 0; run < 3; ++run) {
    std::size_t i = 0;
    for (const Cloud* const cloud :
         std::array<const Cloud*, 4>{{&distinct, &one, &pairs, &few}}) {
      least[i] = std::min(least[i], buildMilliseconds(*cloud));
      ++i;
    }
  }
  std::printf("\n%zu points, one thread: milliseconds of the tree, ratio\n", n);
  const char* const names[] = {
      "distinct", "one duplicate", "pairs", "at a thousand positions"};
  for (std::size_t i = 0; i < least.size(); ++i)
    std::printf("%-40s %9.0f %7.2f\n", names[i], least[i], least[i] / least[0]);
}

/** A new cloud to its isopoints: seconds of the clock and of the processor. */
std::pair<double, double>
timeExtraction(const Cloud::Ptr& cloud, unsigned threads)
{
  const auto start = std::chrono::steady_clock::now();
  const std::clock_t busy = std::clock();
  pcl_uvol::IsosurfaceExtraction<pcl::PointXYZI> extraction;
  extraction.setInputCloud(cloud);
  extraction.setIsoValue(0.0);
  extraction.setNumberOfThreads(threads);
  pcl::PointCloud<pcl_uvol::PointIso> surface;
  extraction.extract(surface);
  return {
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(),
      static_cast<double>(std::clock() - busy) / CLOCKS_PER_SEC};
}

void
compareThreads(std::size_t most)
{
  std::puts("\nuniform samples, the least of many runs in turn: milliseconds of one "
            "thread, of two, ratio; ratio of processor time");
  for (std::size_t n = 10; n <= most; n *= 10)
    for (const std::size_t size : {n, 2 * n, 5 * n}) {
      if (size > most)
        break;
      const auto cloud = makeCloud(layouts().front().sample, size);
      const auto infinity = std::numeric_limits<double>::infinity();
      double least[2] = {infinity, infinity}, busy[2] = {infinity, infinity};
      const std::size_t runs = std::clamp<std::size_t>(2000000 / size, 11, 500);
      for (std::size_t run = 0; run < runs; ++run)
        for (unsigned threads = 1; threads <= 2; ++threads) {
          const auto [clock, processor] = timeExtraction(cloud, threads);
          least[threads - 1] = std::min(least[threads - 1], clock);
          busy[threads - 1] = std::min(busy[threads - 1], processor);
        }
      std::printf("%9zu %9.3f %9.3f %7.2f %7.2f\n",
                  size,
                  1e3 * least[0],
                  1e3 * least[1],
                  least[1] / least[0],
                  busy[1] / busy[0]);
      std::fflush(stdout);
    }
}

} // namespace

int
main(int argc, char** argv)
{
  const auto n =
      static_cast<std::size_t>(argc > 1 ? std::max(1000.0, std::atof(argv[1])) : 1e6);
  const std::string part = argc > 2 ? argv[2] : "";
  if (part.empty() || part == "layouts")
    compareLayouts(n, argc > 3 ? argv[3] : "");
  if (part == "once")
    extractOnce(n, argc > 3 ? argv[3] : "uniform");
  if (part == "names")
    for (const NamedLayout& layout : layouts())
      std::puts(layout.name);
  if (part.empty() || part == "duplicates")
    compareDuplicates(n);
  if (part.empty() || part == "threads")
    compareThreads(n);
  return 0;
}
