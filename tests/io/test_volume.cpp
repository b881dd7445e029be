// SPDX-License-Identifier: BSD-3-Clause
// Volumes, meshes and what a file holds.
#include "generation/mesh_scatter.h"
#include "pipeline/dataset_info.h"
#include "support/environment.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/io/dataset.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace test_volume {

using pcl_uvol::IOError;
using pcl_uvol::loadVolume;
using uvol_test::writeFile;

/** 3 x 2 x 2 bytes: x + 10 y + 100 z. */
const std::string bytes("\0\1\2\12\13\14\144\145\146\156\157\160", 12);

class VolumeFiles : public testing::Test {
protected:
  void
  expectVolume(const std::string& path) const
  {
    const auto volume = loadVolume(path);
    EXPECT_EQ((std::array<std::size_t, 3>{3, 2, 2}), volume.dims);
    EXPECT_EQ((std::array<double, 3>{0.5, 1.0, 2.0}), volume.spacing);
    EXPECT_EQ((std::array<double, 3>{1.0, 1.0, 2.0}), volume.upper());
    ASSERT_EQ(12u, volume.values.size());
    EXPECT_EQ(112.0f, volume.values[11]);
    EXPECT_DOUBLE_EQ(61.5, volume.sample({0.75, 1.0, 1.0})); // halfway along x and z
    EXPECT_DOUBLE_EQ(112.0, volume.sample({9.0, 9.0, 9.0}));
  }

  uvol_test::TemporaryFolder folder_;
};

const std::string nrrd_header = "NRRD0004\ntype: unsigned char\ndimension: 3\n"
                                "sizes: 3 2 2\nspacings: 0.5 1 2\n";

TEST_F(VolumeFiles, NrrdRawAndGzipAttachedAndDetached)
{
  writeFile(folder_ / "a.nrrd", nrrd_header + "encoding: raw\n\n" + bytes);
  expectVolume(folder_ / "a.nrrd");
  writeFile(folder_ / "b.raw", bytes);
  writeFile(folder_ / "b.nhdr", nrrd_header + "encoding: raw\ndata file: b.raw\n");
  expectVolume(folder_ / "b.nhdr");
  writeFile(folder_ / "c.raw", bytes);
  ASSERT_EQ(0, uvol_test::runCommand("gzip '" + (folder_ / "c.raw") + "'").exit_code);
  writeFile(folder_ / "c.nhdr", nrrd_header + "encoding: gzip\ndata file: c.raw.gz\n");
  expectVolume(folder_ / "c.nhdr");
}

TEST_F(VolumeFiles, LayersInFilesOfTheirOwn)
{
  writeFile(folder_ / "layer1.raw", bytes.substr(0, 6));
  writeFile(folder_ / "layer2.raw", bytes.substr(6));
  const std::string mhd = "NDims = 3\nDimSize = 3 2 2\nElementSpacing = 0.5 1 2\n"
                          "ElementType = MET_UCHAR\nElementDataFile = ";
  const std::string nhdr = nrrd_header + "encoding: raw\ndata file: ";
  const std::string files[] = {"LIST\nlayer1.raw\nlayer2.raw\n",
                               "LIST 2\nlayer1.raw\n\n layer2.raw \n",
                               "layer%d.raw 1 2 1\n"};
  for (const std::string& list : files) {
    writeFile(folder_ / "a.mhd", mhd + list);
    expectVolume(folder_ / "a.mhd");
    writeFile(folder_ / "a.nhdr", nhdr + list);
    expectVolume(folder_ / "a.nhdr");
  }
  for (const char* const wrong :
       {"", "LIST\n", "LIST\nlayer1.raw\n", "LIST\nlayer2.raw\ngone.raw\n"}) {
    writeFile(folder_ / "b.mhd", mhd + wrong);
    EXPECT_THROW(loadVolume(folder_ / "b.mhd"), IOError) << wrong;
    writeFile(folder_ / "b.nhdr", nhdr + wrong);
    EXPECT_THROW(loadVolume(folder_ / "b.nhdr"), IOError) << wrong;
  }
}

TEST_F(VolumeFiles, MetaImageAndVti)
{
  const std::string header = "ObjectType = Image\nNDims = 3\nDimSize = 3 2 2\n"
                             "ElementSpacing = 0.5 1 2\nElementType = MET_UCHAR\n";
  writeFile(folder_ / "a.mha", header + "ElementDataFile = LOCAL\n" + bytes);
  expectVolume(folder_ / "a.mha");
  writeFile(
      folder_ / "a.vti",
      "<VTKFile type=\"ImageData\" version=\"0.1\"><ImageData WholeExtent=\"0 2 0 1 0 "
      "1\" Origin=\"0 0 0\" Spacing=\"0.5 1 2\"><Piece Extent=\"0 2 0 1 0 1\">"
      "<PointData Scalars=\"rho\"><DataArray type=\"UInt8\" Name=\"rho\" "
      "format=\"ascii\">0 1 2 10 11 12 100 101 102 110 111 112</DataArray>"
      "</PointData></Piece></ImageData></VTKFile>");
  expectVolume(folder_ / "a.vti");
  EXPECT_EQ("rho", loadVolume(folder_ / "a.vti").name);
}

TEST_F(VolumeFiles, BadOnesThrowInOneSentence)
{
  writeFile(folder_ / "short.nrrd",
            nrrd_header + "encoding: raw\n\n" + bytes.substr(0, 7));
  writeFile(folder_ / "lost.nhdr",
            nrrd_header + "encoding: raw\ndata file: lost.raw\n");
  writeFile(folder_ / "text.nrrd", "not a volume\n");
  writeFile(folder_ / "text.mha", "not a volume\n");
  writeFile(folder_ / "text.vti", "not a volume\n");
  writeFile(folder_ / "empty.nrrd", "");
  writeFile(folder_ / "volume.png", "x");
  for (const char* name : {"short.nrrd",
                           "lost.nhdr",
                           "text.nrrd",
                           "text.mha",
                           "text.vti",
                           "empty.nrrd",
                           "volume.png",
                           "missing.nrrd",
                           ""})
    try {
      loadVolume(folder_ / name);
      ADD_FAILURE() << name;
    }
    catch (const IOError& error) {
      EXPECT_NE(std::string::npos, error.message().find(name)) << error.message();
      EXPECT_EQ(std::string::npos, error.message().find('\n')) << error.message();
    }
}

TEST_F(VolumeFiles, MeshPointsAreSpreadByArea)
{
  // A square of side 2 as one polygon, and a triangle of area 1 far away.
  writeFile(
      folder_ / "mesh.ply",
      "ply\nformat ascii 1.0\nelement vertex 7\nproperty float x\nproperty float y\n"
      "property float z\nelement face 2\nproperty list uchar int vertex_indices\n"
      "end_header\n0 0 0\n2 0 0\n2 2 0\n0 2 0\n10 0 0\n12 0 0\n10 1 0\n"
      "4 0 1 2 3\n3 4 5 6\n");
  const auto points =
      pcl_uvol::scatterOverMesh(pcl_uvol::loadMesh(folder_ / "mesh.ply"), 50000, 1);
  std::size_t far = 0, quarter = 0;
  for (const auto& point : points) {
    far += point.position[0] > 5.0f;
    quarter += point.position[0] < 1.0f && point.position[1] < 1.0f;
    EXPECT_EQ((std::array<float, 3>{0, 0, 1}), point.normal);
  }
  EXPECT_NEAR(10000.0, static_cast<double>(far), 1.0); // stratified by area
  EXPECT_NEAR(10000.0, static_cast<double>(quarter), 500.0);
  writeFile(
      folder_ / "points.ply",
      "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
      "property float z\nend_header\n0 0 0\n");
  EXPECT_THROW(pcl_uvol::loadMesh(folder_ / "points.ply"), IOError);
  EXPECT_THROW(pcl_uvol::loadMesh(folder_ / "missing.ply"), IOError);
  EXPECT_THROW(pcl_uvol::scatterOverMesh({}, 5, 1), pcl_uvol::InvalidArgument);
}

TEST(DatasetInfo, ValuesAndPositions)
{
  const double nan_value = std::numeric_limits<double>::quiet_NaN();
  const auto values = pcl_uvol::describeValues({3, 1, 2, nan_value, 2, 1, 9});
  EXPECT_EQ(6u, values.finite);
  EXPECT_EQ(1u, values.missing);
  EXPECT_EQ(1.0, values.min);
  EXPECT_EQ(9.0, values.max);
  EXPECT_EQ(3.0, values.mean);
  EXPECT_EQ(2u, values.histogram.front());
  EXPECT_EQ(1u, values.histogram.back());
  EXPECT_EQ((std::vector<double>{2.0}), values.isovalues); // of 2, 2, 3 between 1 and 9
  EXPECT_TRUE(pcl_uvol::describeValues({}).isovalues.empty());
  EXPECT_TRUE(pcl_uvol::describeValues({5.0, 5.0}).isovalues.empty());

  pcl_uvol::Dataset dataset;
  pcl_uvol::setCoordinates(dataset,
                           {0, 0, 0, 1, 0, 0, 3, 0, 0, 3, 0, 0, nan_value, 0, 0});
  const auto positions = pcl_uvol::describePositions(dataset, {}, 0, nullptr);
  EXPECT_EQ(1u, positions.non_finite);
  EXPECT_EQ(1u, positions.duplicates);
  EXPECT_EQ(3.0, positions.upper[0]);
  EXPECT_EQ(1.0, positions.spacing_min);
  EXPECT_EQ(2.0, positions.spacing_max);
}

} // namespace test_volume
