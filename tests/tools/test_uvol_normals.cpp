// SPDX-License-Identifier: BSD-3-Clause
// uvol_normals from the outside: normals beside all other fields, sides, exit codes.
#include "common/scalar_field.h"
#include "support/environment.h"
#include "tools/json_warnings.h"
#include "tools/sentences.h"
#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/io/dataset.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <sstream>

namespace test_uvol_normals {

/** Unit sphere about (100, 0, 0) with a label, and with outside vectors on demand. */
std::string
sphereCsv(bool with_normals)
{
  uvol_test::Random random(1);
  std::ostringstream csv;
  csv << "x,y,z,label" << (with_normals ? ",normal_x,normal_y,normal_z" : "") << '\n';
  for (int i = 0; i < 2000; ++i) {
    const double z = 2 * random.uniform() - 1, angle = 6.283185307 * random.uniform();
    const double x = std::sqrt(1 - z * z) * std::cos(angle);
    const double y = std::sqrt(1 - z * z) * std::sin(angle);
    csv << 100 + x << ',' << y << ',' << z << ',' << i;
    if (with_normals)
      csv << ',' << 2 * x << ',' << 2 * y << ',' << 2 * z;
    csv << '\n';
  }
  return csv.str();
}

class NormalsTool : public testing::Test {
protected:
  uvol_test::CommandResult
  run(bool with_normals, const std::string& options) const
  {
    uvol_test::writeFile(in_, sphereCsv(with_normals));
    return uvol_test::runCommand("uvol_normals " + in_ + " " + out_ + " " + options);
  }

  /** Every normal within a few degrees of the sphere's, on that side: 1 outside, -1
   * inside, 0 for that of the origin. Labels tell the points apart. */
  void
  expectNormals(int side) const
  {
    const pcl_uvol::Dataset dataset = pcl_uvol::loadDataset(out_);
    ASSERT_EQ(2000u, dataset.cloud.width);
    const pcl_uvol::CloudView view = pcl_uvol::viewOf(dataset.cloud);
    const auto field = [&](const char* name) {
      return pcl_uvol::ScalarField(view.fields, name);
    };
    const auto nx = field("normal_x"), ny = field("normal_y"), nz = field("normal_z");
    const auto curvature = field("curvature"), label = field("label");
    for (std::size_t i = 0; i < view.count; ++i) {
      const std::uint8_t* const point = view.point(i);
      const double x = view.xyz(i)[0] + dataset.origin[0];
      const double y = view.xyz(i)[1] + dataset.origin[1];
      const double z = view.xyz(i)[2] + dataset.origin[2];
      const double radial =
          (x - 100) * nx.read(point) + y * ny.read(point) + z * nz.read(point);
      EXPECT_GT(side == 0 ? std::abs(radial) : side * radial, 0.98);
      const double away = x * nx.read(point) + y * ny.read(point) + z * nz.read(point);
      EXPECT_TRUE(side != 0 || away <= 1e-3) << away;
      EXPECT_LT(curvature.read(point), 0.05);
      EXPECT_EQ(static_cast<double>(i), label.read(point));
    }
  }

  uvol_test::TemporaryFolder folder_;
  std::string in_ = folder_ / "in.csv";
  std::string out_ = folder_ / "out.ply";
};

TEST_F(NormalsTool, NormalsOfTheFileOrientTheNewOnes)
{
  const auto result = uvol_test::succeeded(run(true, "-k 20 -json"));
  EXPECT_FALSE(uvol_test::hasMessage(result, "oriented_to_zero"));
  expectNormals(1);
}

TEST_F(NormalsTool, TheViewPointOrientsWhereThereAreNone)
{
  const auto result =
      uvol_test::succeeded(run(false, "-viewpoint 100,0,0 -threads 1 -json"));
  EXPECT_FALSE(uvol_test::hasMessage(result, "oriented_to_zero"));
  expectNormals(-1);
}

TEST_F(NormalsTool, SaysThatTheOriginOrientsByDefault)
{
  const auto result = uvol_test::succeeded(run(false, "-json"));
  EXPECT_TRUE(uvol_test::hasMessage(result, "oriented_to_zero")) << result.out;
  expectNormals(0);
}

TEST_F(NormalsTool, DrawsABarOnATerminalAndIsQuietInAPipe)
{
  const std::string cloud = folder_ / "cloud.pcd", log = folder_ / "log";
  ASSERT_EQ(0, uvol_test::runCommand("uvol_generate " + cloud + " -n 30000").exit_code);
  const std::string arguments =
      "uvol_normals " + cloud + " " + out_ + " -k 250 -threads 1";
  const auto piped = uvol_test::runWell(arguments);
  EXPECT_EQ(std::string::npos, piped.err.find("s left")) << piped.err;
  // script(1) runs a command on a terminal of its own.
  const std::string command = std::string(PCL_UVOL_TOOL_DIR) + "/" + arguments;
  ASSERT_EQ(0,
            std::system(
                ("script -qec '" + command + "' " + log + " > " + log + "2").c_str()));
  const std::string drawn = uvol_test::readFile(log);
  EXPECT_NE(std::string::npos, drawn.find("nearest_neighbors [=")) << drawn;
  EXPECT_NE(std::string::npos, drawn.find("s left\r\033[K")) << drawn;
}

TEST_F(NormalsTool, RefusesWhatItCannotDo)
{
  for (const char* options :
       {"-k 1", "-k 1.5", "-scale 1,1", "-scale 0,1,1", "-wat", "extra"}) {
    EXPECT_EQ(2, run(true, options).exit_code) << options;
    EXPECT_EQ(1u, folder_.list().size());
  }
  uvol_test::writeFile(in_, "x,y,z\n");
  uvol_test::expectError(
      uvol_test::runCommand("uvol_normals " + in_ + " " + out_ + " -json"),
      "no_points");
  EXPECT_EQ(1u, folder_.list().size());
}

} // namespace test_uvol_normals
