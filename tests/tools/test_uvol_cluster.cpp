// SPDX-License-Identifier: BSD-3-Clause
// uvol_cluster from the outside: planted clusters are found, chosen and enclosed.
#include "support/environment.h"
#include "support/meshes.h"
#include "tools/tool_test.h"
#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/common/scalar_field.h>
#include <pcl_uvol/io/dataset.h>
#include <pcl_uvol/io/mesh.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <set>
#include <sstream>

namespace {

using pcl_uvol::Dataset;
using uvol_test::CommandResult;
using uvol_test::readFile;
using uvol_test::runCommand;

constexpr std::size_t points = 300;
const std::size_t sizes[] = {150, 100, 50};
constexpr double apart = 6.0; // centres of clusters in space, whose radius is 1

/** Clusters of 150, 100 and 50 points, one after the other in turns of six. */
int
truthOf(std::size_t i)
{
  return i % 6 < 3 ? 0 : i % 6 < 5 ? 1 : 2;
}

/** Of every point: where it is, attributes a to d, and what is asked of rows. */
struct Sample {
  std::size_t index;
  int cluster;
  double place[3], attributes[4];
};

std::vector<Sample>
makeSamples()
{
  constexpr double centers[3][4] = {{0, 0, 0, 0}, {10, 0, 0, 5}, {0, 10, 5, 0}};
  uvol_test::Random random(8);
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

std::string
tableOf(const std::string& header, const std::function<std::string(const Sample&)>& row)
{
  std::string csv = header + '\n';
  for (const Sample& sample : makeSamples())
    csv += row(sample) + '\n';
  return csv;
}

template <typename T>
std::string
joined(const T& numbers)
{
  std::ostringstream text;
  for (const double number : numbers)
    text << (text.tellp() > 0 ? "," : "") << number;
  return text.str();
}

std::string
attributeTable()
{
  return tableOf("a,b,c,d", [](const Sample& s) { return joined(s.attributes); });
}

std::string
spaceTable()
{
  return tableOf("x,y,z,a,b,c,d,h,id,truth", [](const Sample& s) {
    return joined(s.place) + ',' + joined(s.attributes) + ",0.5," +
           std::to_string(s.index) + ',' + std::to_string(s.cluster);
  });
}

std::vector<double>
fieldOf(const Dataset& dataset, const std::string& name)
{
  const auto view = pcl_uvol::viewOf(dataset.cloud);
  const pcl_uvol::ScalarField field(view.fields, name);
  std::vector<double> values;
  for (std::size_t i = 0; i < view.count; ++i)
    values.push_back(field.read(view.point(i)));
  return values;
}

/** Distance of a vertex to the nearest sample of a cluster. */
double
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

class ClusterTool : public uvol_test::ToolTest {
protected:
  ClusterTool()
      : ToolTest("uvol_cluster", "out.ply")
  {
  }

  void
  SetUp() override
  {
    uvol_test::writeFile(in_, spaceTable());
  }

  /** The output of a run that succeeds. */
  Dataset
  resultOf(const std::string& options) const
  {
    expectSuccess(options);
    return pcl_uvol::loadDataset(out_);
  }

  /** The mesh around cluster 1 or another one, which is closed. */
  pcl_uvol::Mesh
  meshOf(const std::string& options) const
  {
    expectSuccess(options);
    const auto mesh = pcl_uvol::loadMesh(out_);
    EXPECT_TRUE(uvol_test::isClosed(mesh.triangles)) << options;
    EXPECT_GT(uvol_test::signedVolume(mesh), 0.0) << options;
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

TEST_F(ClusterTool, FindsPlantedClusters)
{
  for (const std::string& table : {spaceTable(), attributeTable()}) {
    uvol_test::writeFile(in_, table);
    const Dataset dataset = resultOf(attributes_);
    expectTruth(dataset);
    for (const double probability : fieldOf(dataset, "probability")) {
      EXPECT_GT(probability, 0.0);
      EXPECT_LE(probability, 1.0);
    }
  }
  const auto result = run(attributes_);
  EXPECT_NE(std::string::npos, result.out.find("clusters: 0: 150, 1: 100, 2: 50"))
      << result.out;
}

TEST_F(ClusterTool, KeepsEveryFieldInEveryFormat)
{
  const Dataset in = pcl_uvol::loadDataset(in_);
  for (const char* name : {"out.ply", "out.pcd", "out.csv", "out.vtp"})
    for (const char* option : {"", "-ascii"}) {
      out_ = folder_ / name;
      const Dataset out = resultOf(attributes_ + option);
      expectTruth(out);
      for (const char* field : {"x", "y", "z", "a", "d", "h", "id", "truth"})
        EXPECT_EQ(fieldOf(in, field), fieldOf(out, field)) << name << field;
    }
}

TEST_F(ClusterTool, WritesTheTreeOfClusters)
{
  ASSERT_EQ(0, run(attributes_ + "-tree " + tree_).exit_code);
  std::istringstream table(readFile(tree_));
  std::string line;
  std::getline(table, line);
  EXPECT_EQ("node,parent,birth_density,death_density,size,stability,label", line);
  struct Node {
    double number, parent, birth, death, size, stability, label;
  };
  std::vector<Node> nodes;
  while (std::getline(table, line)) {
    std::replace(line.begin(), line.end(), ',', ' ');
    Node node{};
    ASSERT_TRUE(std::istringstream(line) >> node.number >> node.parent >> node.birth >>
                node.death >> node.size >> node.stability >> node.label)
        << line;
    nodes.push_back(node);
  }
  ASSERT_GE(nodes.size(), 4u);
  EXPECT_EQ(-1.0, nodes[0].parent);
  EXPECT_EQ(points, nodes[0].size);
  std::multiset<double> chosen;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    EXPECT_EQ(i, nodes[i].number);
    EXPECT_GE(nodes[i].death, nodes[i].birth);
    EXPECT_GE(nodes[i].stability, 0.0);
    if (nodes[i].label >= 0.0)
      chosen.insert(nodes[i].label);
    if (i == 0)
      continue;
    ASSERT_GE(nodes[i].parent, 0.0);
    ASSERT_LT(nodes[i].parent, static_cast<double>(i));
    const Node& parent = nodes[static_cast<std::size_t>(nodes[i].parent)];
    EXPECT_LT(nodes[i].size, parent.size);
    EXPECT_EQ(parent.death, nodes[i].birth);
  }
  EXPECT_EQ((std::multiset<double>{0.0, 1.0, 2.0}), chosen);
}

TEST_F(ClusterTool, ChoosesTheClusterThatIsAskedFor)
{
  const auto ids = fieldOf(pcl_uvol::loadDataset(in_), "id");
  for (int cluster = 0; cluster < 3; ++cluster) {
    const Dataset chosen =
        resultOf(attributes_ + "-cluster " + std::to_string(cluster));
    const auto truth = fieldOf(chosen, "truth");
    EXPECT_EQ(std::vector<double>(sizes[cluster], cluster), truth);
    EXPECT_EQ(truth, fieldOf(chosen, "label"));
    const auto found = fieldOf(chosen, "id");
    EXPECT_TRUE(std::is_sorted(found.begin(), found.end()));
  }
}

TEST_F(ClusterTool, ReadsLabelsOfTheInput)
{
  EXPECT_EQ(sizes[2], resultOf("-label truth -cluster 2").cloud.width);
  std::string table = spaceTable();
  table.replace(table.find("truth"), 5, "label");
  uvol_test::writeFile(in_, table);
  EXPECT_EQ(sizes[1], resultOf("-cluster 1").cloud.width);
}

TEST_F(ClusterTool, SelectsPointsFirst)
{
  const Dataset dataset = resultOf("-where 'truth>=1' " + attributes_);
  EXPECT_EQ(sizes[1] + sizes[2], dataset.cloud.width);
  const auto truth = fieldOf(dataset, "truth"), label = fieldOf(dataset, "label");
  for (std::size_t i = 0; i < truth.size(); ++i)
    EXPECT_EQ(truth[i] - 1.0, label[i]);
}

/** Thin places at the rims of balls may be noise. */
TEST_F(ClusterTool, PositionsAreAttributesAsWell)
{
  for (const char* options : {"-position", "-position -attributes a,x"}) {
    const auto labels = fieldOf(resultOf(options), "label");
    ASSERT_EQ(points, labels.size());
    std::size_t found = 0;
    for (std::size_t i = 0; i < points; ++i) {
      found += labels[i] == truthOf(i);
      EXPECT_TRUE(labels[i] == truthOf(i) || labels[i] == -1.0) << i;
    }
    EXPECT_GT(found, points * 2 / 3) << options;
  }
  uvol_test::writeFile(in_, attributeTable());
  std::remove(out_.c_str());
  expectFailure("-position", 1, "no coordinates");
}

TEST_F(ClusterTool, TakesOtherWaysToChooseClusters)
{
  expectTruth(resultOf(attributes_ + "-cut 1 -k 5 -min-size 20"));
  const auto labels = fieldOf(resultOf(attributes_ + "-cut 100 -single"), "label");
  EXPECT_EQ(std::vector<double>(points, 0.0), labels);
}

TEST_F(ClusterTool, HullsArePointsOfTheClusterWithTheirFields)
{
  const auto mesh = meshOf(attributes_ + "-cluster 1 -surface hull");
  EXPECT_GT(mesh.triangles.size(), 50u);
  EXPECT_LT(uvol_test::signedVolume(mesh), 4.2); // the ball's
  EXPECT_GT(uvol_test::signedVolume(mesh), 1.0);
  const Dataset vertices = pcl_uvol::loadDataset(out_);
  const auto ids = fieldOf(vertices, "id"), label = fieldOf(vertices, "label");
  const auto a = fieldOf(vertices, "a"), normal = fieldOf(vertices, "normal_x");
  const auto samples = makeSamples();
  for (std::size_t i = 0; i < ids.size(); ++i) {
    const Sample& sample = samples[static_cast<std::size_t>(ids[i])];
    EXPECT_EQ(1, sample.cluster);
    EXPECT_EQ(1.0, label[i]);
    EXPECT_NEAR(sample.attributes[0], a[i], 1e-4);
    for (std::size_t axis = 0; axis < 3; ++axis)
      EXPECT_NEAR(sample.place[axis], mesh.vertices[i][axis] + mesh.origin[axis], 1e-5);
    EXPECT_LE(std::abs(normal[i]), 1.0);
  }
}

TEST_F(ClusterTool, SurfacesAtADistanceAreAtThatDistance)
{
  constexpr double distance = 0.6, cell = (2.0 + 2.0 * distance) / 48.0;
  const auto mesh =
      meshOf(attributes_ + "-cluster 1 -surface distance -distance 0.6 -grid 48");
  for (const auto& vertex : mesh.vertices) // between centres of cells
    ASSERT_NEAR(distance, distanceTo(1, vertex), 2.0 * cell);
  const auto result = run(attributes_ + "-cluster 1 -surface distance -json");
  EXPECT_NE(std::string::npos, result.out.find("\"distance\": \"")) << result.out;
}

TEST_F(ClusterTool, SurfacesAroundHullsAreBeyondTheirPoints)
{
  constexpr double distance = 0.6, cell = (2.0 + 2.0 * distance) / 48.0;
  const std::string options = attributes_ + "-cluster 1 -distance 0.6 -grid 48 ";
  const double of_points =
      uvol_test::signedVolume(meshOf(options + "-surface distance"));
  const auto mesh = meshOf(options + "-surface hull-distance");
  EXPECT_GT(uvol_test::signedVolume(mesh), of_points);
  for (const auto& vertex : mesh.vertices)
    ASSERT_GT(distanceTo(1, vertex), distance - 2.0 * cell);
}

TEST_F(ClusterTool, TooSmallDistancesAreToldOf)
{
  const auto result = run(attributes_ + "-cluster 1 -surface distance -distance 0.05 "
                                        "-grid 300");
  EXPECT_EQ(0, result.exit_code) << result.err;
  EXPECT_NE(std::string::npos, result.err.find("Warning")) << result.err;
  std::remove(out_.c_str());
  expectFailure(attributes_ + "-cluster 1 -surface distance -distance 1e-9", 1, "grid");
}

TEST_F(ClusterTool, DistancesMayBeStretched)
{
  uvol_test::writeFile(in_, "x,y,z,label\n1,2,3,0\n9,9,9,1\n");
  const auto mesh =
      meshOf("-cluster 0 -surface distance -distance 0.5 -scale 1,1,4 -grid 64");
  const double ball = 4.0 / 3.0 * M_PI * 0.125;
  EXPECT_NEAR(ball / 4.0, uvol_test::signedVolume(mesh), 0.05 * ball / 4.0);
  for (const auto& vertex : mesh.vertices)
    ASSERT_LT(std::abs(vertex[2] - 3.0f), 0.14f);
}

TEST_F(ClusterTool, MembershipPartsSamplesOfTheClusterFromOthers)
{
  const Dataset border = resultOf(attributes_ + "-cluster 1 -surface membership");
  EXPECT_GT(border.cloud.width, 10u);
  // Midpoints of edges between balls of radius 1.
  for (const double x : fieldOf(border, "x"))
    EXPECT_NEAR(0.5 * apart, std::abs(x + border.origin[0] - apart), 1.0);
  for (const char* field : {"a", "truth", "normal_x"})
    EXPECT_NE(nullptr, pcl_uvol::findField(border.cloud.fields, field)) << field;
}

TEST_F(ClusterTool, MembershipMayBeSmoothOrUncertain)
{
  const std::string options = attributes_ + "-cluster 1 -surface membership ";
  const auto plain = fieldOf(resultOf(options), "x");
  for (const char* option : {"-probability probability",
                             "-smoothing-length h",
                             "-probability probability -smoothing-length h"}) {
    const Dataset border = resultOf(options + option);
    EXPECT_GT(border.cloud.width, 10u) << option;
    EXPECT_NE(plain, fieldOf(border, "x")) << option;
    for (const double x : fieldOf(border, "x"))
      EXPECT_LT(std::abs(x + border.origin[0] - apart), apart) << option;
  }
}

TEST_F(ClusterTool, SurfacesKeepThePlaceOfFarPoints)
{
  std::ostringstream csv;
  csv.precision(12);
  csv << "x,y,z,label\n";
  for (const Sample& s : makeSamples())
    csv << s.place[0] + 5e6 << ',' << s.place[1] - 3e6 << ',' << s.place[2] << ','
        << s.cluster << '\n';
  uvol_test::writeFile(in_, csv.str());
  for (const char* surface : {"distance", "hull", "hull-distance"}) {
    const auto mesh = meshOf(std::string("-cluster 0 -surface ") + surface);
    double low = 1e9, high = -1e9;
    for (const auto& vertex : mesh.vertices) {
      low = std::min(low, vertex[0] + mesh.origin[0]);
      high = std::max(high, vertex[0] + mesh.origin[0]);
    }
    EXPECT_NEAR(5e6, 0.5 * (low + high), 0.5) << surface;
  }
}

TEST_F(ClusterTool, SurfacesNeedCoordinates)
{
  uvol_test::writeFile(in_, attributeTable());
  for (const char* surface : {"membership", "distance", "hull", "hull-distance"})
    expectFailure(attributes_ + "-cluster 1 -surface " + surface,
                  1,
                  "The input has no coordinates");
}

TEST_F(ClusterTool, NamesTheLabelsThatThereAre)
{
  for (const char* surface : {"", "-surface membership", "-surface hull"}) {
    expectFailure(attributes_ + "-cluster 9 " + surface, 1, "labels are: 0, 1, 2.");
    expectFailure(attributes_ + "-cluster -1 " + surface, 1, "labels are: 0, 1, 2.");
    expectFailure(std::string("-label truth -cluster 3 ") + surface, 1, "0, 1, 2.");
  }
}

/** A table beside the output is output as well. */
TEST_F(ClusterTool, LeavesNoTreeBehindWhenItFails)
{
  expectFailure(attributes_ + "-cluster 9 -tree " + tree_, 1, "labels are");
  uvol_test::writeFile(in_, attributeTable());
  expectFailure(
      attributes_ + "-cluster 1 -surface hull -tree " + tree_, 1, "coordinates");
}

TEST_F(ClusterTool, SaysThatAnAttributeIsConstant)
{
  const auto result = run("-attributes a,b,c,d,h");
  EXPECT_EQ(0, result.exit_code);
  EXPECT_NE(std::string::npos,
            result.err.find("The attribute h is the same everywhere"))
      << result.err;
  expectTruth(pcl_uvol::loadDataset(out_));
  std::remove(out_.c_str());
  expectFailure("-attributes h", 1, "the same at all points");
}

TEST_F(ClusterTool, PointsWithMissingValuesAreInNoCluster)
{
  uvol_test::writeFile(in_, tableOf("a,b,c,d", [](const Sample& s) {
                         const std::string row = joined(s.attributes);
                         return s.index % 10 == 3 ? row.substr(0, row.rfind(',') + 1)
                                                  : row;
                       }));
  const auto result = run(attributes_ + "-json");
  EXPECT_EQ(0, result.exit_code) << result.err;
  EXPECT_NE(std::string::npos, result.out.find("\"missing_values\": 30"));
  const auto labels = fieldOf(pcl_uvol::loadDataset(out_), "label");
  ASSERT_EQ(points, labels.size());
  for (std::size_t i = 0; i < points; ++i)
    EXPECT_EQ(i % 10 == 3 ? -1 : truthOf(i), labels[i]) << i;
}

TEST_F(ClusterTool, UnitsOfAttributesDoNotCountUnlessRaw)
{
  uvol_test::Random random(4);
  std::vector<double> noise(points);
  for (double& value : noise)
    value = 1e6 * random.uniform();
  uvol_test::writeFile(in_, tableOf("a,b,c,d,n", [&](const Sample& s) {
                         return joined(s.attributes) + ',' +
                                std::to_string(noise[s.index]);
                       }));
  expectTruth(resultOf("-attributes a,b,c,d,n"));
  const auto labels = fieldOf(resultOf("-attributes a,b,c,d,n -raw"), "label");
  std::size_t right = 0;
  for (std::size_t i = 0; i < points; ++i)
    right += labels[i] == truthOf(i);
  EXPECT_LT(right, points * 2 / 3);
}

TEST_F(ClusterTool, NoClusterIsNoFailure)
{
  const auto result = run(attributes_ + "-min-size 200");
  EXPECT_EQ(0, result.exit_code) << result.err;
  EXPECT_NE(std::string::npos, result.err.find("Warning: No cluster")) << result.err;
  const Dataset dataset = pcl_uvol::loadDataset(out_);
  EXPECT_EQ(std::vector<double>(points, -1.0), fieldOf(dataset, "label"));
  EXPECT_EQ(std::vector<double>(points, 0.0), fieldOf(dataset, "probability"));
}

TEST_F(ClusterTool, TinyClustersGetASurfaceOrAClearAnswer)
{
  uvol_test::writeFile(in_,
                       "x,y,z,label\n0,0,0,0\n1,0,0,1\n1,1,0,1\n0,0,1,2\n3,3,3,2\n"
                       "5,0,0,2\n0,5,0,2\n2,6,5,2\n1,1,1,2\n2,0,0,2\n");
  // One point.
  expectFailure("-cluster 0 -surface distance", 1, "distance");
  expectFailure("-cluster 0 -surface hull", 1, "cluster");
  expectFailure("-cluster 0 -surface hull-distance", 1, "cluster");
  for (const char* surface : {"hull", "hull-distance"}) {
    const std::string option = std::string(" -surface ") + surface;
    expectFailure("-cluster 0 -distance 0.5" + option, 1, "hull needs three points");
    expectFailure("-cluster 1" + option, 1, "hull needs three points"); // two points
    expectFailure("-cluster 1 -distance 2" + option, 1, "hull needs three points");
  }
  const double ball = 4.0 / 3.0 * M_PI * 0.125;
  EXPECT_NEAR(
      ball,
      uvol_test::signedVolume(meshOf("-cluster 0 -surface distance -distance 0.5")),
      0.05 * ball);
  EXPECT_GT(uvol_test::signedVolume(meshOf("-cluster 1 -surface distance")), ball);
  for (const char* cluster : {"0", "1"})
    EXPECT_GT(
        resultOf(std::string("-surface membership -cluster ") + cluster).cloud.width,
        0u);
}

TEST_F(ClusterTool, SameBytesForAnyNumberOfThreads)
{
  for (const char* options : {"",
                              "-cluster 0 -surface membership -smoothing-length h",
                              "-cluster 0 -surface distance -grid 40",
                              "-cluster 0 -surface hull",
                              "-cluster 0 -surface hull-distance -grid 40"}) {
    std::string expected;
    for (const char* threads : {"1", "2", "3"}) {
      const auto result =
          run(attributes_ + options + " -tree " + tree_ + " -threads " + threads);
      ASSERT_EQ(0, result.exit_code) << result.err;
      const std::string bytes = readFile(out_) + readFile(tree_);
      if (expected.empty())
        expected = bytes;
      EXPECT_TRUE(expected == bytes) << options << ' ' << threads;
    }
  }
}

TEST_F(ClusterTool, RefusesOptionsThatDoNotGoTogether)
{
  expectFailure("", 2, "-attributes");
  expectFailure(attributes_ + "-surface hull", 2, "-cluster");
  expectFailure(attributes_ + "-scale 1,1,2", 2, "-surface");
  expectFailure(attributes_ + "-label truth", 2, "-label");
  for (const char* option :
       {"-k 5", "-min-size 5", "-cut 1", "-single", "-tree tree.csv", "-raw"})
    expectFailure(std::string("-label truth ") + option, 2, "-attributes");
  for (const char* option : {"-grid 20", "-distance 1"}) {
    expectFailure(attributes_ + option, 2, "-surface");
    expectFailure(attributes_ + "-cluster 0 -surface membership " + option,
                  2,
                  "-surface distance");
  }
  for (const char* option : {"-probability probability", "-smoothing-length h"}) {
    expectFailure(attributes_ + option, 2, "membership");
    expectFailure(
        attributes_ + "-cluster 0 -surface hull " + option, 2, "-surface membership");
  }
}

TEST_F(ClusterTool, RefusesValuesThatAreNone)
{
  for (const char* scale : {"1,1", "1,1,x"})
    expectFailure(
        attributes_ + "-cluster 0 -surface hull -scale " + scale, 2, "-scale");
  for (const char* scale : {"1,1,0", "1,1,-1"})
    expectFailure(attributes_ + "-cluster 0 -surface hull -scale " + scale, 1, "scale");
  for (const char* cluster : {"0.5", "1e99", "nan", "abc", "0,1", "''"})
    expectFailure(attributes_ + "-cluster " + cluster, 2, "-cluster");
  for (const char* option : {"-k 1001",
                             "-k -1",
                             "-min-size 1",
                             "-cut 0",
                             "-cut -1",
                             "-cut inf",
                             "-cluster 0 -surface hull -grid 3",
                             "-cluster 0 -surface hull -distance 0",
                             "-cluster 0 -surface ball",
                             "-wat",
                             "more"})
    expectFailure(attributes_ + option, 2, "uvol_cluster -h");
  for (const char* names : {"a,,b", ",a", "a,", ",", "''"})
    expectFailure(std::string("-attributes ") + names, 2, "-attributes");
}

TEST_F(ClusterTool, RefusesFieldsThatAreNotThere)
{
  expectFailure("-attributes a,nope", 1, "There is no field 'nope'");
  expectFailure("-attributes a,b,a", 1, "each counts once");
  expectFailure("-label nope -cluster 1", 1, "'nope'");
  expectFailure("-label a -cluster 1", 1, "no labels");
  expectFailure(attributes_ + "-where 'nope>1'", 1, "nope");
  expectFailure(attributes_ + "-where 'a>1e9'", 1, "no points");
  const std::string border = attributes_ + "-cluster 1 -surface membership ";
  expectFailure(border + "-probability nope", 1, "'nope'");
  expectFailure(border + "-smoothing-length nope", 1, "'nope'");
}

TEST_F(ClusterTool, RefusesOtherFiles)
{
  expectFailure(attributes_ + "-tree " + (folder_ / "tree.txt"), 1, ".csv");
  expectFailure(attributes_ + "-tree " + (folder_ / "no/tree.csv"), 1, "tree.csv");
  out_ = folder_ / "out.pcd";
  expectFailure(attributes_ + "-cluster 1 -surface hull", 1, ".ply");
  out_ = folder_ / "out.what";
  expectFailure(attributes_, 1, "out.what");
  out_ = folder_ / "out.ply";
  uvol_test::writeFile(in_, "a,b,c,d\n");
  expectFailure(attributes_, 1, "no points");
  in_ = folder_ / "missing.csv";
  expectFailure(attributes_, 1, "missing.csv");
}

} // namespace
