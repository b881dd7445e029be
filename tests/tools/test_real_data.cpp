// SPDX-License-Identifier: BSD-3-Clause
// Every real data set through uvol_info and uvol_isosurface at isovalues of its README;
// the edges of the small ones against brute force.
#include "common/scalar_field.h"
#include "neighbors/sample_set.h"
#include "support/environment.h"
#include "support/neighbor_oracle.h"
#include "tools/json_warnings.h"
#include <pcl_uvol/io/dataset.h>
#include <pcl_uvol/isosurface/isosurface_extraction.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <string>
#include <vector>

namespace test_real_data {

using uvol_test::runCommand;

struct RealData {
  const char* file;
  const char* field;
  const char* isovalues;
  const char* options;
};

const RealData data_sets[] = {
    {"particles/starsmasher_giant.csv", "rho", "3e-4,1e-3,1e-2,0.1,1", ""},
    {"particles/starsmasher_giant.csv", "u", "0.3,1", ""},
    {"particles/planet_remnant.csv", "rho_g_cm3", "3.45,4.5,8,12", ""},
    {"particles/planet_remnant.csv", "entropy_erg_gK", "2e7", ""},
    {"particles/dam_break_frame_9.csv", "density", "500,700,900", ""},
    {"particles/dam_break_frame_9.csv", "|vx,vy,vz|", "1,2,4", ""},
    {"particles/double_dam_break_frame_26.vtk", "|velocity|", "1,2,3", ""},
    {"sensors/babbitt_drillholes.csv", "cu_pct", "0.3,0.6,1.0", ""},
    {"sensors/babbitt_drillholes.csv", "ni_pct", "0.1,0.2", ""},
    {"sensors/seaglider_sg542.csv", "temperature_C", "4,6,9", "-scale auto"},
    {"sensors/seaglider_sg542.csv", "oxygen_umol_kg", "200,250", "-scale auto"},
    {"sensors/seaglider_sg542.csv", "salinity_psu", "34.3", "-scale auto"},
    {"sensors/argo_4901079_gulfstream.csv",
     "temperature_C",
     "8,12,16,18",
     "-scale auto"},
    {"sensors/argo_4901079_gulfstream.csv", "salinity_psu", "35.5", "-scale auto"},
    {"sensors/orebro_gas_network.csv",
     "mean_ppm",
     "1",
     "-where experiment=1 -xyz 1,2,3"},
    {"cfd/comb.vts", "Density", "0.25,0.30,0.38,0.5", ""},
    {"cfd/bluntfin.vts", "Density", "0.6,0.9,1.5,2.5", ""},
    {"cfd/bluntfin.vts", "Pressure", "1.5,3", ""},
    {"cfd/disk_out_ref.vtu", "Temp", "350,450,600,800", ""},
    {"cfd/disk_out_ref.vtu", "AsH3", "0.14", ""},
    {"cfd/blow.vtk", "thickness9", "0.3,0.5,0.9", ""},
    {"cfd/can.vtu", "|VEL|", "2000,4000", ""},
    {"volumes/ironProt.vtk", "scalars", "36,80,128", ""}};

class OnRealData : public testing::TestWithParam<RealData> {
protected:
  void
  SetUp() override
  {
    if (uvol_test::dataFolder().empty())
      GTEST_SKIP() << "the folder of real data is not there ($PCL_UVOL_DATA)";
    path_ = uvol_test::dataFolder() + "/" + GetParam().file;
  }

  std::string path_;
};

class OnSmallRealData : public OnRealData {};

/** Up to 25,000 points: brute force looks at all pairs. */
std::vector<RealData>
smallDataSets()
{
  std::vector<RealData> small;
  for (const RealData& data : data_sets) {
    const std::string file = data.file;
    if (file != "cfd/comb.vts" && file != "cfd/bluntfin.vts" &&
        file != "volumes/ironProt.vtk")
      small.push_back(data);
  }
  return small;
}

std::string
nameOf(const testing::TestParamInfo<RealData>& data)
{
  std::string name = std::string(data.param.file) + "_" + data.param.field;
  std::replace_if(
      name.begin(),
      name.end(),
      [](unsigned char c) { return std::isalnum(c) == 0; },
      '_');
  return name;
}

/** Isopoints of the tool: the count that its JSON report tells. */
std::size_t
isopointsIn(const std::string& json)
{
  const std::string key = "\"isopoints\": ";
  const std::size_t found = json.find(key);
  return found == std::string::npos ? 0 : std::stoul(json.substr(found + key.size()));
}

/** Whether an isovalue has no isopoints. */
bool
reportsNoneAround(const std::string& json)
{
  const auto report = nlohmann::json::parse(json);
  return uvol_test::hasWarning(report, "no_isopoints") ||
         uvol_test::hasWarning(report, "constant_field") ||
         uvol_test::hasWarning(report, "lowest_isovalue");
}

/** No data set has enough of them. */
bool
reportsSpikes(const std::string& json)
{
  return uvol_test::hasWarning(nlohmann::json::parse(json), "spikes");
}

TEST_P(OnRealData, ToolsRunAndFindTheSurface)
{
  const RealData& data = GetParam();
  const uvol_test::TemporaryFolder folder;
  EXPECT_EQ(0, runCommand("uvol_info '" + path_ + "'").exit_code);
  const auto result = uvol_test::runWell(
      "uvol_isosurface '" + path_ + "' '" + (folder / "out.ply") + "' -field '" +
      data.field + "' -iso " + data.isovalues + " -json " + data.options);
  // The lowest speed of the can is 2006, so that one of its isovalues is empty.
  EXPECT_EQ(std::string(data.file) == "cfd/can.vtu", reportsNoneAround(result.out))
      << result.out;
  EXPECT_GT(isopointsIn(result.out), 0u) << result.out;
  EXPECT_FALSE(reportsSpikes(result.out)) << result.out;
}

TEST_P(OnSmallRealData, EdgesEqualBruteForce)
{
  const RealData& data = GetParam();
  pcl_uvol::LoadOptions load;
  if (std::string(data.options).find("-xyz 1,2,3") != std::string::npos)
    load.xyz_columns = {{"1", "2", "3"}};
  pcl_uvol::Dataset dataset = pcl_uvol::loadDataset(path_, load);
  const pcl::PCLPointCloud2::ConstPtr cloud(&dataset.cloud, [](const void*) {});
  pcl_uvol::IsosurfaceExtraction<pcl::PCLPointCloud2> extraction;
  extraction.setInputCloud(cloud);
  extraction.setScalarField(data.field);
  const std::string isovalues = data.isovalues;
  const double isovalue = std::stod(isovalues.substr(isovalues.rfind(',') + 1));
  extraction.setIsoValue(isovalue);
  pcl::PointCloud<pcl_uvol::PointIso> surface;
  extraction.extract(surface);

  // With merged duplicates any member may stand for the sample: compare by sample.
  const auto& samples = *extraction.getSamples();
  std::vector<std::uint32_t> sample_of(dataset.cloud.width);
  for (std::uint32_t i = 0; i < samples.size(); ++i)
    sample_of[samples.getInputIndex(i)] = i;
  for (const auto& merged : samples.getMerged())
    for (const auto member : merged.members)
      sample_of[member] = merged.sample;
  const pcl_uvol::ScalarField field(dataset.cloud.fields, data.field);
  std::vector<float> values(samples.size());
  for (std::uint32_t i = 0; i < samples.size(); ++i)
    values[i] = static_cast<float>(field.read(
        &dataset.cloud.data[samples.getInputIndex(i) * dataset.cloud.point_step]));
  for (const auto& merged : samples.getMerged()) {
    std::vector<float> all;
    for (const auto member : merged.members)
      all.push_back(static_cast<float>(
          field.read(&dataset.cloud.data[member * dataset.cloud.point_step])));
    std::sort(all.begin(), all.end());
    values[merged.sample] = all[(all.size() - 1) / 2];
  }
  const auto expected =
      uvol_test::NeighborOracle(samples.getPositions())
          .edges(values, static_cast<float>(isovalue), pcl_uvol::AngleCriterion::Kept);
  EXPECT_EQ(expected.size(), extraction.getReport().getCount("edges"));
  std::set<std::pair<std::uint32_t, std::uint32_t>> found;
  for (const auto& edge : extraction.getEdges())
    found.emplace(std::min(sample_of[edge.first], sample_of[edge.second]),
                  std::max(sample_of[edge.first], sample_of[edge.second]));
  EXPECT_EQ(expected.size(),
            found.size() + extraction.getReport().getCount("coincident"));
  EXPECT_TRUE(
      std::includes(expected.begin(), expected.end(), found.begin(), found.end()));
}

/** Core and mantle: the density jumps from 5.6 to 10. */
TEST(RealData, NoOvershootAtTheCoreOfAPlanet)
{
  if (uvol_test::dataFolder().empty())
    GTEST_SKIP() << "the folder of real data is not there ($PCL_UVOL_DATA)";
  const pcl_uvol::Dataset dataset =
      pcl_uvol::loadDataset(uvol_test::dataFolder() + "/particles/planet_remnant.csv");
  const pcl::PCLPointCloud2::ConstPtr cloud(&dataset.cloud, [](const void*) {});
  pcl_uvol::IsosurfaceExtraction<pcl::PCLPointCloud2> extraction;
  extraction.setInputCloud(cloud);
  extraction.setScalarField("rho_g_cm3");
  extraction.setIsoValue(8.0);
  pcl::PointCloud<pcl_uvol::PointIso> surface;
  extraction.extract(surface);
  EXPECT_GT(surface.size(), 500u);
  const pcl_uvol::CloudView view = pcl_uvol::viewOf(dataset.cloud);
  for (std::size_t i = 0; i < surface.size(); ++i) {
    const auto& edge = extraction.getEdges()[i];
    const Eigen::Array3f a = Eigen::Array3f::Map(view.xyz(edge.first));
    const Eigen::Array3f b = Eigen::Array3f::Map(view.xyz(edge.second));
    const Eigen::Array3f x = surface[i].getArray3fMap();
    const float room = 0.5f * surface[i].edge_length;
    EXPECT_TRUE((x >= a.min(b) - room).all() && (x <= a.max(b) + room).all())
        << x.transpose();
  }
}

/** What GoogleTest calls a parameter; else it prints bytes. */
void
PrintTo(const RealData& data, std::ostream* out)
{
  *out << data.file << ' ' << data.field;
}

INSTANTIATE_TEST_SUITE_P(RealData, OnRealData, testing::ValuesIn(data_sets), nameOf);
INSTANTIATE_TEST_SUITE_P(RealData,
                         OnSmallRealData,
                         testing::ValuesIn(smallDataSets()),
                         nameOf);

/** A can of finite elements whose wall is two layers of nodes: the mesh closes the
 * hollow as well. */
TEST(RealData, MeasuresOfAThinWallAreCoveredOrNotConstrained)
{
  if (uvol_test::dataFolder().empty())
    GTEST_SKIP() << "the folder of real data is not there ($PCL_UVOL_DATA)";
  const uvol_test::TemporaryFolder folder;
  const auto result = uvol_test::runWell(
      "uvol_isosurface '" + uvol_test::dataFolder() + "/cfd/can.vtu' '" +
      (folder / "out.ply") + "' -field '|VEL|' -iso 3000 -mesh -measure -json");
  EXPECT_TRUE(uvol_test::hasMessage(result, "unconstrained_measures"));
  EXPECT_TRUE(uvol_test::hasMessage(result, "uncertain_measures"));
  // Of the part of the cells above 3000, by VTK.
  constexpr double area = 455.4, volume = 43.9;
  const auto found = nlohmann::json::parse(result.out)["surfaces"];
  EXPECT_NEAR(area, found["area"].get<double>(), found["area_error"].get<double>());
  EXPECT_NEAR(
      volume, found["volume"].get<double>(), found["volume_error"].get<double>());
}

class OnRealVolumes
    : public testing::TestWithParam<std::pair<const char*, const char*>> {};

TEST_P(OnRealVolumes, ResampledAtRandomPositions)
{
  if (uvol_test::dataFolder().empty())
    GTEST_SKIP() << "the folder of real data is not there ($PCL_UVOL_DATA)";
  const std::string volume =
      uvol_test::dataFolder() + "/volumes/" + GetParam().first + ".nhdr";
  const uvol_test::TemporaryFolder folder;
  const std::string samples = folder / "samples.pcd";
  EXPECT_EQ(0, runCommand("uvol_info '" + volume + "'").exit_code);
  uvol_test::runWell("uvol_generate '" + volume + "' '" + samples + "' -n 200000");
  EXPECT_EQ(0, runCommand("uvol_info '" + samples + "'").exit_code);
  const auto result =
      uvol_test::runWell("uvol_isosurface '" + samples + "' '" + (folder / "out.ply") +
                         "' -iso " + GetParam().second + " -json");
  EXPECT_FALSE(reportsNoneAround(result.out)) << result.out;
  EXPECT_FALSE(reportsSpikes(result.out)) << result.out;
  EXPECT_GT(isopointsIn(result.out), 0u);
}

INSTANTIATE_TEST_SUITE_P(RealVolumes,
                         OnRealVolumes,
                         testing::Values(std::pair{"fuel", "10,50,100,180"},
                                         std::pair{"hydrogenAtom", "4,8,16,32,60"},
                                         std::pair{"engine", "60,110,180,220"},
                                         std::pair{"BostonTeapot", "20,40,60,90"},
                                         std::pair{"neghip", "30,60,120,200"},
                                         std::pair{"nucleon", "40,100,140,200"},
                                         std::pair{"marschnerlobb", "127.5"},
                                         std::pair{"bucky", "70,120,180"}),
                         [](const auto& volume) {
                           return std::string(volume.param.first);
                         });

} // namespace test_real_data
