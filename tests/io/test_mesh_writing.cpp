// SPDX-License-Identifier: BSD-3-Clause
// Meshes written and read again: triangles, places and the fields of vertices.
#include "random_dataset.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/io/dataset.h>

#include <cstring>

namespace test_mesh_writing {

using namespace pcl_uvol;
using namespace uvol_test;

const std::vector<FieldSpec> specs{
    {"rho", Type::FLOAT32}, {"mark", Type::UINT8}, {"time", Type::FLOAT64}};

/** Triangles of a strip over that many vertices, the last one back to the start. */
std::vector<Triangle>
makeStrip(std::uint32_t vertices)
{
  std::vector<Triangle> triangles;
  for (std::uint32_t i = 0; i < vertices; ++i)
    triangles.push_back({{i, (i + 1) % vertices, (i + 2) % vertices}});
  return triangles;
}

SaveOptions
asText(bool ascii)
{
  SaveOptions options;
  options.ascii = ascii;
  return options;
}

TEST(MeshWriting, TrianglesAndFieldsSurvive)
{
  const TemporaryFolder folder;
  // As many as fill the buffer of a writer several times.
  for (const std::uint32_t vertices : {3u, 50000u})
    for (const bool ascii : {false, true}) {
      const Dataset dataset = makeDataset(specs, vertices, 4);
      const auto triangles = makeStrip(vertices);
      saveMesh(folder / "a.ply", dataset, triangles, asText(ascii));
      const Mesh mesh = loadMesh(folder / "a.ply");
      EXPECT_EQ(triangles, mesh.triangles) << vertices << ascii;
      ASSERT_EQ(vertices, mesh.vertices.size());
      for (std::size_t i = 0; i < vertices; i += 101)
        for (std::size_t axis = 0; axis < 3; ++axis)
          ASSERT_EQ(coordinateOf(dataset, axis, i),
                    mesh.vertices[i][axis] + mesh.origin[axis]);
      expectSameFields(loadDataset(folder / "a.ply"), dataset);
      EXPECT_EQ(std::vector<std::string>{"a.ply"}, folder.list());
    }
}

TEST(MeshWriting, LargeCoordinatesKeepTheirDigits)
{
  const TemporaryFolder folder;
  for (const bool ascii : {false, true}) {
    Dataset dataset = makeDataset({}, 3, 4);
    for (std::size_t i = 0; i < 9; ++i) // multiples of a quarter
      put(dataset.cloud.data.data() + 4 * i, 0.25f * static_cast<float>(i * i));
    dataset.origin = {{5505024.0, -393216.0, 0.0}};
    dataset.double_coordinates = true;
    saveMesh(folder / "far.ply", dataset, {{{0, 1, 2}}}, asText(ascii));
    const Mesh mesh = loadMesh(folder / "far.ply");
    ASSERT_EQ(3u, mesh.vertices.size());
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t axis = 0; axis < 3; ++axis)
        EXPECT_EQ(coordinateOf(dataset, axis, i),
                  mesh.vertices[i][axis] + mesh.origin[axis])
            << ascii;
  }
}

TEST(MeshWriting, VerticesOfMeshesGetNormals)
{
  const TemporaryFolder folder;
  Mesh mesh;
  mesh.origin = {{1048576.0, 0.0, 0.0}};
  mesh.vertices = {{{0, 0, 0}}, {{1, 0, 0}}, {{0, 1, 0}}, {{9, 9, 9}}};
  mesh.triangles = {{{0, 1, 2}}};
  const Dataset dataset = toDataset(mesh);
  EXPECT_EQ(mesh.origin, dataset.origin);
  ASSERT_EQ(4u, dataset.cloud.width);
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      EXPECT_EQ(mesh.vertices[i][axis] + mesh.origin[axis],
                coordinateOf(dataset, axis, i));
    EXPECT_EQ(0.0, valueOf(dataset, "normal_x", i));
    EXPECT_EQ(i < 3 ? 1.0 : 0.0, valueOf(dataset, "normal_z", i));
  }
  saveMesh(folder / "a.ply", dataset, mesh.triangles);
  EXPECT_EQ(mesh.triangles, loadMesh(folder / "a.ply").triangles);
  EXPECT_EQ(1.0, valueOf(loadDataset(folder / "a.ply"), "normal_z", 1));
}

TEST(MeshWriting, AnEmptyMeshHasNoVertices)
{
  EXPECT_EQ(0u, toDataset(Mesh()).cloud.width);
}

TEST(MeshWriting, WithoutTrianglesThereAreOnlyPoints)
{
  const TemporaryFolder folder;
  const Dataset dataset = makeDataset(specs, 5, 4);
  saveMesh(folder / "a.ply", dataset, {});
  expectSameFields(loadDataset(folder / "a.ply"), dataset);
  EXPECT_THROW(loadMesh(folder / "a.ply"), IOError);
}

TEST(MeshWriting, OtherNamesAreRefused)
{
  const TemporaryFolder folder;
  const Dataset dataset = makeDataset({}, 3, 4);
  for (const char* name : {"a.pcd", "a.dxf", "a", "a.ply.gz", "no/such.ply", ""}) {
    EXPECT_THROW(checkMeshPath(folder / name), IOError) << name;
    EXPECT_THROW(saveMesh(folder / name, dataset, {{{0, 1, 2}}}), IOError) << name;
  }
  EXPECT_NE(messageOf<IOError>([&] { checkMeshPath(folder / "a.pcd"); }).find(".ply"),
            std::string::npos);
  checkMeshPath(folder / "A.PLY");
  EXPECT_TRUE(folder.list().empty());
}

TEST(MeshWriting, FieldsThatPlyCannotHoldAreLeftOut)
{
  const TemporaryFolder folder;
  Dataset dataset = makeDataset({{"id", Type::INT64}, {"a", Type::FLOAT32}}, 3, 4);
  const auto offset = findField(dataset.cloud.fields, "id")->offset;
  constexpr std::int64_t beyond = (std::int64_t(1) << 53) + 1;
  std::memcpy(&dataset.cloud.data[offset], &beyond, sizeof(beyond));
  saveMesh(folder / "a.ply", dataset, {{{0, 1, 2}}});
  std::vector<Triangle> triangles;
  const Dataset loaded = loadMesh(folder / "a.ply", triangles);
  EXPECT_EQ(1u, triangles.size());
  EXPECT_EQ(nullptr, findField(loaded.cloud.fields, "id"));
  EXPECT_EQ(valueOf(dataset, "a", 2), valueOf(loaded, "a", 2));
}

} // namespace test_mesh_writing
