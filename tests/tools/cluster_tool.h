// SPDX-License-Identifier: BSD-3-Clause
// Planted clusters in a file, and uvol_cluster on them.
#pragma once

#include "support/environment.h"
#include "support/meshes.h"
#include "tools/tool_test.h"
#include <pcl_uvol/io/dataset.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <set>
#include <sstream>

namespace uvol_test {

using pcl_uvol::Dataset;

constexpr std::size_t points = 300;
const std::size_t sizes[] = {150, 100, 50};
constexpr double apart = 6.0; // centres of clusters in space, whose radius is 1

/** Clusters of 150, 100 and 50 points, one after the other in turns of six. */
inline int
truthOf(std::size_t i)
{
  return i % 6 < 3 ? 0 : i % 6 < 5 ? 1 : 2;
}

/** What every point has: where it is, attributes a to d, and what is asked of rows. */
struct Sample {
  std::size_t index;
  int cluster;
  double place[3], attributes[4];
};

inline std::vector<Sample>
makeSamples()
{
  constexpr double centers[3][4] = {{0, 0, 0, 0}, {10, 0, 0, 5}, {0, 10, 5, 0}};
  Random random(8);
  std::vector<Sample> samples;
  while (samples.size() < points) {
    Sample sample{samples.size(), truthOf(samples.size()), {}, {}};
    double sq_radius = 0.0;
    for (double& x : sample.place) {
      x = 2.0 * random.uniform() - 1.0;
      sq_radius += x * x;
    }
    if (sq_radius > 1.0)
      continue;
    sample.place[0] += apart * sample.cluster;
    for (int k = 0; k < 4; ++k)
      sample.attributes[k] = centers[sample.cluster][k] + random.uniform() +
                             random.uniform() + random.uniform();
    samples.push_back(sample);
  }
  return samples;
}

inline std::string
tableOf(const std::string& header, const std::function<std::string(const Sample&)>& row)
{
  std::string csv = header + '\n';
  for (const Sample& sample : makeSamples())
    csv += row(sample) + '\n';
  return csv;
}

template <typename T>
inline std::string
joined(const T& numbers)
{
  std::ostringstream text;
  for (const double number : numbers)
    text << (text.tellp() > 0 ? "," : "") << number;
  return text.str();
}

inline std::string
attributeTable()
{
  return tableOf("a,b,c,d", [](const Sample& s) { return joined(s.attributes); });
}

inline std::string
spaceTable()
{
  return tableOf("x,y,z,a,b,c,d,h,id,truth", [](const Sample& s) {
    return joined(s.place) + ',' + joined(s.attributes) + ",3.5," +
           std::to_string(s.index) + ',' + std::to_string(s.cluster);
  });
}

/** Distance of a vertex to the nearest sample of a cluster. */
inline double
distanceTo(int cluster, const std::array<float, 3>& vertex)
{
  static const std::vector<Sample> samples = makeSamples();
  double least = std::numeric_limits<double>::max();
  for (const Sample& sample : samples)
    if (sample.cluster == cluster)
      least = std::min(least,
                       std::hypot(vertex[0] - sample.place[0],
                                  vertex[1] - sample.place[1],
                                  vertex[2] - sample.place[2]));
  return least;
}

class ClusterTool : public ToolTest {
protected:
  ClusterTool()
      : ToolTest("uvol_cluster", "out.ply")
  {
  }

  void
  SetUp() override
  {
    writeFile(in_, spaceTable());
  }

  /** The mesh around cluster 1 or another one, which is closed. */
  pcl_uvol::Mesh
  meshOf(const std::string& options) const
  {
    expectSuccess(options);
    const auto mesh = pcl_uvol::loadMesh(out_);
    EXPECT_TRUE(isClosed(mesh.triangles)) << options;
    EXPECT_GT(signedVolume(mesh), 0.0) << options;
    return mesh;
  }

  static void
  expectTruth(const Dataset& dataset)
  {
    const auto labels = fieldOf(dataset, "label");
    ASSERT_EQ(points, labels.size());
    for (std::size_t i = 0; i < points; ++i)
      EXPECT_EQ(truthOf(i), labels[i]) << i;
  }

  const std::string attributes_ = "-attributes a,b,c,d ";
  std::string tree_ = folder_ / "tree.csv";
};

} // namespace uvol_test
