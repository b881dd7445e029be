// SPDX-License-Identifier: BSD-3-Clause
// Scans drawn from their vertices against their meshes: no hole where the mesh is, and
// nothing behind it shines through.
#include "generation/mesh_scatter.h"
#include "render/image_space/frame.h"
#include "support/environment.h"
#include <pcl_uvol/io/dataset.h>
#include <pcl_uvol/render/image_space/image_space_renderer.h>

#include <Eigen/Geometry>
#include <gtest/gtest.h>
#include <pcl/conversions.h>
#include <pcl/point_types.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <ostream>
#include <string>
#include <vector>

namespace test_scans {

using pcl_uvol::Camera;
using pcl_uvol::Image;
using pcl_uvol::Mesh;
using pcl_uvol::View;

struct Scan {
  const char* file;
  std::uint64_t points; ///< scattered over the mesh; 0: its vertices
  Eigen::Vector3d from;
  double zoom;
  int size;
  std::size_t open; ///< pixels that may be, of those a pixel within the outline
};

void
PrintTo(const Scan& scan, std::ostream* out)
{
  *out << scan.file << ", " << scan.size << " pixels, zoom " << scan.zoom;
}

// A triangle in the dragon's crest faces the eye while the normals of its vertices do
// not: as points they are not seen, and leave a notch. The blade's vertices lie on its
// edges: flat parts have holes of many times their spacing.
const Scan scans[] = {
    {"bunny.ply", 0, {0.2, 0.3, 1.0}, 1.0, 512, 0},
    {"bunny.ply", 0, {-1.0, 0.5, 0.3}, 1.0, 1024, 0},
    {"bunny.ply", 0, {0.2, 0.3, 1.0}, 10.0, 512, 0},
    {"dragon_res3.ply", 0, {0.3, 0.2, 1.0}, 1.0, 512, 0},
    {"dragon_res3.ply", 0, {0.3, 0.2, 1.0}, 1.0, 1024, 6},
    {"turbineblade.ply", 0, {1.0, 0.3, 0.4}, 1.0, 512, 0},
    {"turbineblade.ply", 0, {1.0, 0.3, 0.4}, 1.0, 1024, 0},
    {"turbineblade.ply", 0, {-0.3, 0.1, -1.0}, 1.0, 1024, 0},
    {"turbineblade.ply", 883000, {1.0, 0.3, 0.4}, 1.0, 1024, 0},
};

/** The mesh's vertices with the normals of the file, or points scattered over it. */
pcl::PCLPointCloud2::Ptr
loadPoints(const std::string& path, const Mesh& mesh, std::uint64_t points)
{
  if (points == 0)
    return std::make_shared<pcl::PCLPointCloud2>(
        std::move(pcl_uvol::loadDataset(path).cloud));
  pcl::PointCloud<pcl::PointNormal> cloud;
  for (const auto& [position, normal] : pcl_uvol::scatterOverMesh(mesh, points, 1)) {
    pcl::PointNormal point;
    std::copy(position.begin(), position.end(), point.data);
    std::copy(normal.begin(), normal.end(), point.data_n);
    cloud.push_back(point);
  }
  auto blob = std::make_shared<pcl::PCLPointCloud2>();
  pcl::toPCLPointCloud2(cloud, *blob);
  return blob;
}

/** Depth of the triangles that face the eye in the middle of every pixel; infinite
 * where there are none. */
std::vector<double>
rasterize(const Mesh& mesh, const Camera& camera, const View& view)
{
  const auto size = static_cast<std::size_t>(view.width);
  std::vector<double> depth(size * static_cast<std::size_t>(view.height),
                            std::numeric_limits<double>::infinity());
  const Eigen::Matrix3d turn = camera.rotation();
  const auto seen = [&](std::uint32_t vertex) -> Eigen::Vector3d {
    const auto& v = mesh.vertices[vertex];
    return turn * (Eigen::Vector3d(v[0], v[1], v[2]) - camera.eye);
  };
  const auto project = [&](const Eigen::Vector3d& c) -> Eigen::Vector2d {
    return {0.5 * view.width + view.focal * c.x() / c.z(),
            0.5 * view.height + view.focal * c.y() / c.z()};
  };
  for (const auto& triangle : mesh.triangles) {
    const Eigen::Vector3d a = seen(triangle[0]), b = seen(triangle[1]),
                          c = seen(triangle[2]);
    const Eigen::Vector3d normal = (b - a).cross(c - a);
    const double plane = normal.dot(a);
    if (plane >= 0.0)
      continue;
    const Eigen::Vector2d p[3] = {project(a), project(b), project(c)};
    const auto low = p[0].cwiseMin(p[1]).cwiseMin(p[2]).cwiseMax(0.0).eval();
    const auto high = p[0].cwiseMax(p[1]).cwiseMax(p[2]).eval();
    for (int row = static_cast<int>(low.y()); row < view.height && row <= high.y();
         ++row)
      for (int column = static_cast<int>(low.x());
           column < view.width && column <= high.x();
           ++column) {
        const Eigen::Vector3d ray((column + 0.5 - 0.5 * view.width) / view.focal,
                                  (row + 0.5 - 0.5 * view.height) / view.focal,
                                  1.0);
        const double along = plane / normal.dot(ray);
        const Eigen::Vector3d place = along * ray;
        const auto isLeft = [&](const Eigen::Vector3d& from,
                                const Eigen::Vector3d& to) {
          return (to - from).cross(place - from).dot(normal) >= 0.0;
        };
        if (!(along > 0.0 && isLeft(a, b) && isLeft(b, c) && isLeft(c, a)))
          continue;
        double& here = depth[static_cast<std::size_t>(row) * size +
                             static_cast<std::size_t>(column)];
        here = std::min(here, place.norm() / view.far);
      }
  }
  return depth;
}

class ScanPicture : public testing::TestWithParam<Scan> {};

TEST_P(ScanPicture, HasNoHoles)
{
  if (uvol_test::dataFolder().empty())
    GTEST_SKIP() << "the folder of real data is not there ($PCL_UVOL_DATA)";
  const Scan& scan = GetParam();
  const std::string path = uvol_test::dataFolder() + "/scans/" + scan.file;
  const Mesh mesh = pcl_uvol::loadMesh(path);
  pcl_uvol::ImageSpaceRenderer<pcl::PCLPointCloud2> renderer;
  renderer.setInputCloud(loadPoints(path, mesh, scan.points));
  renderer.setSize(scan.size, scan.size);
  pcl_uvol::ImagePlanes planes;
  planes.depth = true;
  renderer.setPlanes(planes);
  Camera camera = Camera::fit(
      renderer.getBounds(), scan.from, Eigen::Vector3d::UnitY(), 30.0, 1.0, 0.95);
  camera.vertical_fov /= scan.zoom;
  renderer.setCamera(camera);
  Image image;
  renderer.render(image);

  const View view(camera, renderer.getBounds(), scan.size, scan.size);
  const std::vector<double> truth = rasterize(mesh, camera, view);
  const double layer = 0.03 * renderer.getBounds().radius / view.far;
  const std::ptrdiff_t size = scan.size, around = 1;
  std::size_t inside = 0, open = 0, shining = 0, swollen = 0;
  for (std::ptrdiff_t row = around; row + around < size; ++row)
    for (std::ptrdiff_t column = around; column + around < size; ++column) {
      double nearest = std::numeric_limits<double>::infinity(), farthest = 0.0;
      for (std::ptrdiff_t r = row - around; r <= row + around; ++r)
        for (std::ptrdiff_t c = column - around; c <= column + around; ++c) {
          const double depth = truth[static_cast<std::size_t>(r * size + c)];
          nearest = std::min(nearest, depth);
          farthest = std::max(farthest, depth);
        }
      const float drawn = image.depth[static_cast<std::size_t>(row * size + column)];
      swollen += std::isinf(nearest) && drawn < 1.0f ? 1 : 0;
      if (std::isinf(farthest))
        continue; // near the outline
      ++inside;
      open += drawn == 1.0f ? 1 : 0;
      shining += drawn > farthest + layer ? 1 : 0;
    }
  EXPECT_GT(inside, static_cast<std::size_t>(size * size / 20));
  EXPECT_LE(open, scan.open);
  EXPECT_LE(shining, inside / 1000);
  EXPECT_LE(swollen, inside / 70);
}

INSTANTIATE_TEST_SUITE_P(Scans, ScanPicture, testing::ValuesIn(scans));

} // namespace test_scans
