// SPDX-License-Identifier: BSD-3-Clause
// uvol_cluster from the outside: planted clusters are found and chosen.
#include "tools/cluster_tool.h"
#include "tools/json_warnings.h"

namespace test_uvol_cluster {

using namespace uvol_test;

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
  EXPECT_NE(std::string::npos, result.out.find("clusters: 0: 150, 1: 100, 2: 50\n"))
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
  expectError("-position", "no_coordinates_for");
}

TEST_F(ClusterTool, TakesOtherWaysToChooseClusters)
{
  expectTruth(resultOf(attributes_ + "-cut 1 -k 5 -min-size 20"));
  const auto labels = fieldOf(resultOf(attributes_ + "-cut 100 -single"), "label");
  EXPECT_EQ(std::vector<double>(points, 0.0), labels);
}

TEST_F(ClusterTool, NamesTheLabelsThatThereAre)
{
  for (const char* surface : {"", "-surface membership", "-surface hull"}) {
    expectError(attributes_ + "-cluster 9 " + surface, "no_such_cluster", "0, 1, 2");
    expectError(attributes_ + "-cluster -1 " + surface, "no_such_cluster", "0, 1, 2");
    expectError(std::string("-label truth -cluster 3 ") + surface,
                "no_such_cluster",
                "0, 1, 2");
  }
}

/** A table beside the output is output as well. */
TEST_F(ClusterTool, LeavesNoTreeBehindWhenItFails)
{
  expectError(attributes_ + "-cluster 9 -tree " + tree_, "no_such_cluster");
  uvol_test::writeFile(in_, attributeTable());
  expectError(attributes_ + "-cluster 1 -surface hull -tree " + tree_,
              "no_coordinates_to_draw");
}

TEST_F(ClusterTool, SaysThatAnAttributeIsConstant)
{
  const auto result = succeeded(run("-attributes a,b,c,d,h -json"));
  EXPECT_TRUE(uvol_test::hasMessage(result, "constant_attribute")) << result.out;
  expectTruth(pcl_uvol::loadDataset(out_));
  std::remove(out_.c_str());
  expectError("-attributes h", "only_constant_attributes");
}

TEST_F(ClusterTool, PointsWithMissingValuesAreInNoCluster)
{
  uvol_test::writeFile(in_, tableOf("a,b,c,d", [](const Sample& s) {
                         const std::string row = joined(s.attributes);
                         return s.index % 10 == 3 ? row.substr(0, row.rfind(',') + 1)
                                                  : row;
                       }));
  const auto result = succeeded(run(attributes_ + "-json"));
  EXPECT_NE(std::string::npos, result.out.find("\"missing_values\": 30"));
  const auto labels = fieldOf(pcl_uvol::loadDataset(out_), "label");
  ASSERT_EQ(points, labels.size());
  for (std::size_t i = 0; i < points; ++i)
    EXPECT_EQ(i % 10 == 3 ? -1 : truthOf(i), labels[i]) << i;
}

/** \param report of JSON, however it is broken into lines */
void
expectPart(const std::string& report, const std::string& part)
{
  std::string dense;
  std::remove_copy(report.begin(), report.end(), std::back_inserter(dense), '\n');
  dense.erase(std::remove(dense.begin(), dense.end(), ' '), dense.end());
  EXPECT_NE(std::string::npos, dense.find(part)) << part << '\n' << report;
}

TEST_F(ClusterTool, NoiseAndMissingValuesAreCountedApart)
{
  uvol_test::writeFile(in_, tableOf("a,b,c,d", [](const Sample& s) {
                         return s.index == 6 || s.index == 12 ? ",1,1,1"
                                : s.index == 0                ? "900,900,900,900"
                                                              : joined(s.attributes);
                       }));
  const auto result = run(attributes_ + "-json");
  expectPart(result.out, R"("clusters":[147,100,50],"labels":[0,1,2])");
  expectPart(result.out, R"("missing_values":2)");
  expectPart(result.out, R"("noise":1)");
}

TEST_F(ClusterTool, ReportsListSizesOfAllGivenLabels)
{
  uvol_test::writeFile(in_, tableOf("a,truth", [](const Sample& s) {
                         const int label =
                             s.index < 16 ? 3 * static_cast<int>(s.index) - 3 : -1;
                         return "0," + std::to_string(label);
                       }));
  const std::string choice = "-label truth -cluster 3 ";
  const auto result = run(choice + "-json");
  expectPart(result.out, R"("clusters":[1,1,1,1,1,1,1,1,1,1,1,1,1,1,1])");
  expectPart(result.out, R"("labels":[0,3,6,9,12,15,18,21,24,27,30,33,36,39,42])");
  expectPart(result.out, R"("in_no_cluster":285)");
  const std::string shown = run(choice).out;
  EXPECT_NE(std::string::npos, shown.find(" 33: 1, ... (15 in all)\n")) << shown;
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
  const auto result = succeeded(run(attributes_ + "-json -min-size 200"));
  EXPECT_TRUE(uvol_test::hasMessage(result, "no_clusters")) << result.out;
  const Dataset dataset = pcl_uvol::loadDataset(out_);
  EXPECT_EQ(std::vector<double>(points, -1.0), fieldOf(dataset, "label"));
  EXPECT_EQ(std::vector<double>(points, 0.0), fieldOf(dataset, "probability"));
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
      succeeded(
          run(attributes_ + options + " -tree " + tree_ + " -threads " + threads));
      const std::string bytes = readFile(out_) + readFile(tree_);
      if (expected.empty())
        expected = bytes;
      EXPECT_TRUE(expected == bytes) << options << ' ' << threads;
    }
  }
}

TEST_F(ClusterTool, RefusesOptionsThatDoNotGoTogether)
{
  expectError("", "command_line", "-attributes");
  expectUsageErrors(attributes_,
                    {"-surface hull",
                     "-scale 1,1,2",
                     "-label truth",
                     "-grid 20",
                     "-distance 1",
                     "-probability probability",
                     "-smoothing-length h"});
  expectUsageErrors(
      "-label truth ",
      {"-k 5", "-min-size 5", "-cut 1", "-single", "-tree tree.csv", "-raw"});
  expectUsageErrors(attributes_ + "-cluster 0 -surface membership ",
                    {"-grid 20", "-distance 1"});
  expectUsageErrors(attributes_ + "-cluster 0 -surface hull ",
                    {"-probability probability", "-smoothing-length h"});
}

TEST_F(ClusterTool, RefusesValuesThatAreNone)
{
  expectUsageErrors(attributes_ + "-cluster 0 -surface hull ",
                    {"-scale 1,1",
                     "-scale 1,1,x",
                     "-scale 1,1,0",
                     "-scale 1,1,-1",
                     "-grid 3",
                     "-distance 0"});
  expectUsageErrors(attributes_,
                    {"-cluster 0.5",
                     "-cluster 1e99",
                     "-cluster nan",
                     "-cluster abc",
                     "-cluster 0,1",
                     "-cluster ''",
                     "-k 1001",
                     "-k -1",
                     "-min-size 1",
                     "-cut 0",
                     "-cut -1",
                     "-cut inf",
                     "-surface ball -cluster 0",
                     "-wat",
                     "more"});
  for (const char* names : {"a,,b", ",a", "a,", ",", "''"})
    expectUsageErrors("", {std::string("-attributes ") + names});
}

TEST_F(ClusterTool, RefusesFieldsThatAreNotThere)
{
  expectError("-attributes a,nope", "unknown_lone_field", R"("nope")");
  expectError("-attributes a,b,a", "same_attributes");
  expectError("-label nope -cluster 1", "unknown_field", "\"nope\"");
  expectError("-label a -cluster 1", "labels_not_integers");
  expectError(attributes_ + "-where 'nope>1'", "unknown_operand", "\"nope\"");
  expectError(attributes_ + "-where 'a>1e9'", "no_points_where");
  const std::string border = attributes_ + "-cluster 1 -surface membership ";
  expectError(border + "-probability nope", "unknown_field", "\"nope\"");
  expectError(border + "-smoothing-length nope", "unknown_field", "\"nope\"");
}

TEST_F(ClusterTool, RefusesOtherFiles)
{
  expectError(
      attributes_ + "-tree " + (folder_ / "tree.txt"), "unwritten_ending", ".csv");
  expectError(
      attributes_ + "-tree " + (folder_ / "no/tree.csv"), "no_folder", "tree.csv");
  out_ = folder_ / "out.pcd";
  expectError(attributes_ + "-cluster 1 -surface hull", "unwritten_ending", ".ply");
  out_ = folder_ / "out.what";
  expectError(attributes_, "unwritten_ending", "out.what");
  out_ = folder_ / "out.ply";
  uvol_test::writeFile(in_, "a,b,c,d\n");
  expectError(attributes_, "no_points");
  in_ = folder_ / "missing.csv";
  expectError(attributes_, "no_such_file", "missing.csv");
}

} // namespace test_uvol_cluster
