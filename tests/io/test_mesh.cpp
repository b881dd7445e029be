// SPDX-License-Identifier: BSD-3-Clause
// PLY meshes: what is read, and what is refused.
#include "support/environment.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/io/dataset.h>

#include <gtest/gtest.h>

#include <cstring>

namespace test_mesh {

using pcl_uvol::IOError;
using pcl_uvol::loadMesh;
using uvol_test::writeFile;

/** A unit square at that place as one polygon; corners are called by that property. */
std::string
asciiSquare(const std::string& x, const std::string& x1, const std::string& corners)
{
  return "ply\nformat ascii 1.0\nelement vertex 4\nproperty double x\nproperty double "
         "y\nproperty double z\nelement face 1\nproperty list uchar int " +
         corners + "\nend_header\n" + x + " 0 0\n" + x1 + " 0 0\n" + x1 + " 1 0\n" + x +
         " 1 0\n4 0 1 2 3\n";
}

/** Many triangles in binary, of the byte order of this machine. */
std::string
binaryStrip(std::int32_t triangles)
{
  std::string ply = "ply\nformat binary_little_endian 1.0\nelement vertex " +
                    std::to_string(triangles + 2) +
                    "\nproperty float x\nproperty float y\nproperty float z\nelement "
                    "face " +
                    std::to_string(triangles) +
                    "\nproperty list uchar int vertex_indices\nend_header\n";
  const auto append = [&ply](const auto& value) {
    char bytes[sizeof(value)];
    std::memcpy(bytes, &value, sizeof(value));
    ply.append(bytes, sizeof(value));
  };
  for (std::int32_t i = 0; i < triangles + 2; ++i)
    for (const float coordinate :
         {static_cast<float>(i / 2), static_cast<float>(i % 2), 0.0f})
      append(coordinate);
  for (std::int32_t i = 0; i < triangles; ++i) {
    append(std::uint8_t(3));
    for (std::int32_t k = 0; k < 3; ++k)
      append(i + k);
  }
  return ply;
}

TEST(Mesh, PolygonsBecomeFansUnderBothNamesOfTheirCorners)
{
  const uvol_test::TemporaryFolder folder;
  for (const char* corners : {"vertex_indices", "vertex_index"}) {
    writeFile(folder / "square.ply", asciiSquare("0", "1", corners));
    const auto mesh = loadMesh(folder / "square.ply");
    ASSERT_EQ(2u, mesh.triangles.size()) << corners;
    EXPECT_EQ((std::array<std::uint32_t, 3>{0, 2, 3}), mesh.triangles[1]);
  }
}

TEST(Mesh, FarVerticesKeepTheirDigits)
{
  const uvol_test::TemporaryFolder folder;
  writeFile(folder / "far.ply",
            asciiSquare("5500000.25", "5500001.25", "vertex_index"));
  const auto mesh = loadMesh(folder / "far.ply");
  EXPECT_EQ(5500000.25, mesh.vertices[0][0] + mesh.origin[0]);
  EXPECT_EQ(5500001.25, mesh.vertices[1][0] + mesh.origin[0]);
}

TEST(Mesh, EveryTruncationThrows)
{
  const uvol_test::TemporaryFolder folder;
  const std::string whole = binaryStrip(20);
  for (std::size_t size = 0; size < whole.size(); ++size) {
    writeFile(folder / "part.ply", whole.substr(0, size));
    EXPECT_THROW(loadMesh(folder / "part.ply"), IOError) << size;
  }
  writeFile(folder / "part.ply", whole);
  EXPECT_EQ(20u, loadMesh(folder / "part.ply").triangles.size());
}

TEST(Mesh, CornersMustBeVertices)
{
  const uvol_test::TemporaryFolder folder;
  for (const char* corners : {"4 0 1 2 4", "4 0 1 2 -1"}) {
    std::string ply = asciiSquare("0", "1", "vertex_indices");
    ply.replace(ply.rfind("4 0 1 2 3"), 9, corners);
    writeFile(folder / "wrong.ply", ply);
    EXPECT_THROW(loadMesh(folder / "wrong.ply"), IOError) << corners;
  }
}

} // namespace test_mesh
