// SPDX-License-Identifier: BSD-3-Clause
// Meshes of scattered samples: ours, marching tetrahedra in CGAL's Delaunay
// triangulation, and VTK's marching cubes (flying edges) on a grid of as many exact
// values, in one run: time, triangles, shape, distance to the true surface, and the
// figures measured of them.
// usage: meshes [n [seed]]
#include "mesh/triangle_tree.h"
#include "support/smooth_fields.h"
#include <pcl_uvol/isosurface/isosurface_extraction.h>
#include <pcl_uvol/mesh/surface_measures.h>
#include <pcl_uvol/mesh/surface_mesh.h>
#include <pcl_uvol/pipeline/isosurface_pipeline.h>

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>
#include <Eigen/Geometry>
#include <vtkCellArray.h>
#include <vtkFlyingEdges3D.h>
#include <vtkIdList.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPolyData.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <map>
#include <utility>

namespace {

using pcl_uvol::Triangle;
using uvol_test::SmoothField;
using Cloud = pcl::PointCloud<pcl::PointXYZI>;
using Place = Eigen::Vector3d;

struct PlainMesh {
  pcl::PointCloud<pcl_uvol::PointIso> vertices;
  std::vector<Triangle> triangles;

  Place
  placeOf(std::uint32_t vertex) const
  {
    return vertices[vertex].getVector3fMap().cast<double>();
  }

  void
  addVertex(const Place& place)
  {
    pcl_uvol::PointIso point;
    point.getVector3fMap() = place.cast<float>();
    vertices.push_back(point);
  }
};

/** A field with the figures of its isosurface. */
struct Solid {
  SmoothField field;
  double area, volume;
  pcl_uvol::Outside outside;
  std::vector<Place> places; // all over the isosurface
};

PlainMesh
makeMesh(const Solid& solid, const Cloud::Ptr& samples, pcl_uvol::Remeshing remeshing)
{
  pcl_uvol::SurfaceMesh<pcl::PointXYZI> mesher;
  mesher.setInputCloud(samples);
  pcl_uvol::SurfaceMeshParameters parameters;
  parameters.isosurface.isovalues = {solid.field.isovalue};
  parameters.isosurface.outside = solid.outside;
  parameters.meshing.remesh = remeshing;
  mesher.setParameters(parameters);
  pcl_uvol::SurfaceTriangles surface;
  mesher.extract(surface);
  return {std::move(surface.vertices), std::move(surface.triangles)};
}

/** The mesh of a level set on the samples. */
PlainMesh
makeSmoothMesh(const Solid& solid, const Cloud::Ptr& samples)
{
  auto dataset = std::make_shared<pcl_uvol::Dataset>();
  pcl::toPCLPointCloud2(*samples, dataset->cloud);
  pcl_uvol::IsosurfacePipelineParameters parameters;
  parameters.isosurface.isovalues = {solid.field.isovalue};
  parameters.isosurface.outside = solid.outside;
  parameters.smooth = true;
  parameters.mesh.emplace();
  pcl_uvol::IsosurfacePipeline pipeline;
  pipeline.setInput(dataset);
  pipeline.setParameters(parameters);
  pcl_uvol::IsosurfaceResult result = pipeline.run();
  PlainMesh mesh;
  pcl::fromPCLPointCloud2(result.surface.cloud, mesh.vertices);
  mesh.triangles = std::move(result.triangles);
  return mesh;
}

PlainMesh
findIsopoints(const Solid& solid, const Cloud::Ptr& samples)
{
  pcl_uvol::IsosurfaceExtraction<pcl::PointXYZI> extraction;
  extraction.setInputCloud(samples);
  extraction.setIsoValue(solid.field.isovalue);
  extraction.setInterpolation(pcl_uvol::Interpolation::Fit);
  PlainMesh points;
  extraction.extract(points.vertices);
  return points;
}

/** Adds a triangle whose normal looks along a direction. */
void
addTriangle(PlainMesh& mesh, Triangle triangle, const Place& direction)
{
  const Place a = mesh.placeOf(triangle[0]);
  const Place normal =
      (mesh.placeOf(triangle[1]) - a).cross(mesh.placeOf(triangle[2]) - a);
  if (normal.dot(direction) < 0.0)
    std::swap(triangle[1], triangle[2]);
  mesh.triangles.push_back(triangle);
}

PlainMesh
marchDelaunay(const Solid& solid, const Cloud::Ptr& samples)
{
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Vertex = CGAL::Triangulation_vertex_base_with_info_3<std::uint32_t, Kernel>;
  using Structure = CGAL::Triangulation_data_structure_3<
      Vertex,
      CGAL::Delaunay_triangulation_cell_base_3<Kernel>,
      CGAL::Parallel_tag>;
  using Delaunay = CGAL::Delaunay_triangulation_3<Kernel, Structure>;
  std::vector<std::pair<Kernel::Point_3, std::uint32_t>> points;
  CGAL::Bbox_3 box;
  for (const auto& point : *samples) {
    points.emplace_back(Kernel::Point_3(point.x, point.y, point.z),
                        static_cast<std::uint32_t>(points.size()));
    box += points.back().first.bbox();
  }
  Delaunay::Lock_data_structure locks(box, 50);
  const Delaunay delaunay(points.begin(), points.end(), &locks);
  const double side = solid.outside == pcl_uvol::Outside::Lower ? 1.0 : -1.0;
  const auto valueOf = [&](std::uint32_t sample) {
    return side * ((*samples)[sample].intensity - solid.field.isovalue);
  };
  PlainMesh mesh;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> vertex_of;
  const auto crossing = [&](std::uint32_t above, std::uint32_t below) {
    const auto [at, is_new] = vertex_of.insert(
        {{above, below}, static_cast<std::uint32_t>(vertex_of.size())});
    if (is_new) {
      const Place a = (*samples)[above].getVector3fMap().cast<double>(),
                  b = (*samples)[below].getVector3fMap().cast<double>();
      mesh.addVertex(a + valueOf(above) / (valueOf(above) - valueOf(below)) * (b - a));
    }
    return at->second;
  };
  for (const auto& cell : delaunay.finite_cell_handles()) {
    std::vector<std::uint32_t> above, below;
    Place direction = Place::Zero(); // from those above to those below
    for (int i = 0; i < 4; ++i) {
      const std::uint32_t sample = cell->vertex(i)->info();
      (valueOf(sample) >= 0.0 ? above : below).push_back(sample);
    }
    if (above.empty() || below.empty())
      continue;
    for (const std::uint32_t sample : above)
      direction -= (*samples)[sample].getVector3fMap().cast<double>() /
                   static_cast<double>(above.size());
    for (const std::uint32_t sample : below)
      direction += (*samples)[sample].getVector3fMap().cast<double>() /
                   static_cast<double>(below.size());
    std::vector<std::uint32_t> ring;
    if (above.size() == 2)
      ring = {crossing(above[0], below[0]),
              crossing(above[0], below[1]),
              crossing(above[1], below[1]),
              crossing(above[1], below[0])};
    else
      for (const std::uint32_t a : above)
        for (const std::uint32_t b : below)
          ring.push_back(crossing(a, b));
    addTriangle(mesh, {ring[0], ring[1], ring[2]}, direction);
    if (ring.size() == 4)
      addTriangle(mesh, {ring[0], ring[2], ring[3]}, direction);
  }
  return mesh;
}

/** On a grid of spacing 1, of exact values. */
PlainMesh
marchCubes(const Solid& solid)
{
  const int nodes = static_cast<int>(std::lround(solid.field.side));
  vtkNew<vtkImageData> grid;
  grid->SetDimensions(nodes, nodes, nodes);
  const double lower = -0.5 * (nodes - 1);
  grid->SetOrigin(lower, lower, lower);
  grid->AllocateScalars(VTK_FLOAT, 1);
  auto* value = static_cast<float*>(grid->GetScalarPointer());
  for (int z = 0; z < nodes; ++z)
    for (int y = 0; y < nodes; ++y)
      for (int x = 0; x < nodes; ++x)
        *value++ =
            static_cast<float>(solid.field.value({lower + x, lower + y, lower + z}));
  vtkNew<vtkFlyingEdges3D> contour;
  contour->SetInputData(grid);
  contour->SetValue(0, solid.field.isovalue);
  contour->Update();
  PlainMesh mesh;
  vtkPolyData& found = *contour->GetOutput();
  for (vtkIdType i = 0; i < found.GetNumberOfPoints(); ++i)
    mesh.addVertex(Place(found.GetPoint(i)));
  vtkNew<vtkIdList> corners;
  for (vtkIdType i = 0; i < found.GetNumberOfPolys(); ++i) {
    found.GetCellPoints(i, corners);
    Triangle triangle{};
    for (vtkIdType k = 0; k < 3; ++k)
      triangle[static_cast<std::size_t>(k)] =
          static_cast<std::uint32_t>(corners->GetId(k));
    mesh.triangles.push_back(triangle);
  }
  return mesh;
}

double
smallestAngleOf(const PlainMesh& mesh)
{
  double smallest = 180.0;
  for (const Triangle& triangle : mesh.triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      const Place tip = mesh.placeOf(triangle[i]),
                  u = mesh.placeOf(triangle[(i + 1) % 3]) - tip,
                  v = mesh.placeOf(triangle[(i + 2) % 3]) - tip;
      smallest =
          std::min(smallest, std::atan2(u.cross(v).norm(), u.dot(v)) * 180.0 / M_PI);
    }
  return smallest;
}

/** Hausdorff's distance to the true surface: the largest from a place on a triangle to
 * that, or from a place there to the triangles. */
double
hausdorffDistance(const PlainMesh& mesh, const Solid& solid)
{
  constexpr int steps = 4; // along an edge
  PlainMesh on_triangles;
  std::vector<Place> corners;
  for (std::uint32_t i = 0; i < mesh.vertices.size(); ++i)
    corners.push_back(mesh.placeOf(i));
  for (const Triangle& triangle : mesh.triangles)
    for (int i = 0; i <= steps; ++i)
      for (int j = 0; i + j <= steps; ++j)
        on_triangles.addVertex((i * corners[triangle[0]] + j * corners[triangle[1]] +
                                (steps - i - j) * corners[triangle[2]]) /
                               steps);
  double largest = uvol_test::quantile(
      uvol_test::deviations(solid.field, on_triangles.vertices), 1.0);
  const pcl_uvol::detail::TriangleTree tree(corners, mesh.triangles);
  for (const Place& place : solid.places)
    largest = std::max(largest, tree.find(place).distance);
  return largest;
}

/** Area and volume as parts of the true ones, and how many pieces and handles. */
void
printFigures(const PlainMesh& mesh, const Solid& solid)
{
  auto vertices = std::make_shared<pcl_uvol::Dataset>();
  pcl::toPCLPointCloud2(mesh.vertices, vertices->cloud);
  pcl_uvol::SurfaceMeasures measures;
  measures.setInputSurface(vertices, mesh.triangles);
  for (const bool curved : {false, true}) {
    pcl_uvol::SurfaceMeasuresParameters parameters;
    parameters.curved = curved;
    measures.setParameters(parameters);
    const auto figures = measures.compute();
    const pcl_uvol::PieceMeasures& all = figures.isovalues[0];
    if (!curved && all.genus)
      std::printf(" %zu | %u |", figures.pieces.size(), *all.genus);
    if (!curved && !all.genus) // points have no triangles, bent or flat
      std::printf(" | | %zu | | | |", figures.pieces.size());
    if (curved || all.genus)
      std::printf(" %+.1e | %+.1e |",
                  all.area.value / solid.area - 1.0,
                  std::abs(all.volume.value) / solid.volume - 1.0);
  }
}

void
printRow(const std::string& name,
         const Solid& solid,
         const std::function<PlainMesh()>& make)
{
  double milliseconds = std::numeric_limits<double>::infinity();
  PlainMesh mesh;
  for (int run = 0; run < 2; ++run) {
    const auto start = std::chrono::steady_clock::now();
    mesh = make();
    milliseconds = std::min(milliseconds,
                            std::chrono::duration<double, std::milli>(
                                std::chrono::steady_clock::now() - start)
                                .count());
  }
  const auto away = uvol_test::deviations(solid.field, mesh.vertices);
  std::printf("| %s | %s | %.0f | %zu | %zu | %.1e |",
              solid.field.name,
              name.c_str(),
              milliseconds,
              mesh.vertices.size(),
              mesh.triangles.size(),
              uvol_test::quantile(away, 0.999));
  if (!mesh.triangles.empty())
    std::printf(
        " %.1e | %.2g |", hausdorffDistance(mesh, solid), smallestAngleOf(mesh));
  printFigures(mesh, solid);
  std::printf("\n");
  std::fflush(stdout);
}

/** Places all over a torus; without a hole, a sphere. */
std::vector<Place>
listPlaces(double large, double small)
{
  constexpr int around = 1500, across = 500;
  std::vector<Place> places;
  for (int i = 0; i < around; ++i)
    for (int j = 0; j < across; ++j) {
      const double u = 2.0 * M_PI * i / around, v = 2.0 * M_PI * j / across;
      const double radius = large + small * std::cos(v);
      places.emplace_back(
          radius * std::cos(u), radius * std::sin(u), small * std::sin(v));
    }
  return places;
}

std::vector<Solid>
listSolids(std::size_t n)
{
  const SmoothField radial = uvol_test::makeSmoothField("radial", n),
                    torus = uvol_test::makeSmoothField("torus", n);
  const double radius = radial.isovalue, unit = 0.5 * torus.side, large = 0.65 * unit,
               small = (0.25 - torus.isovalue) * unit;
  return {{radial,
           4.0 * M_PI * radius * radius,
           4.0 / 3.0 * M_PI * std::pow(radius, 3),
           pcl_uvol::Outside::Higher,
           listPlaces(0.0, radius)},
          {torus,
           4.0 * M_PI * M_PI * large * small,
           2.0 * M_PI * M_PI * large * small * small,
           pcl_uvol::Outside::Lower,
           listPlaces(large, small)}};
}

} // namespace

/** meshes [SAMPLES [SEED [NOISE]]], of the sphere alone with noise, whose standard
 * deviation is that part of the radius */
int
main(int argc, char** argv)
{
  const std::size_t n = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 1000000;
  const std::uint64_t seed = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 1;
  const double noise = argc > 3 ? std::strtod(argv[3], nullptr) : 0.0;
  std::printf(
      "| field | mesh | ms | vertices | triangles | 99.9 %% within | Hausdorff "
      "distance | smallest angle | pieces | handles | area, flat | volume, flat | "
      "area, bent | "
      "volume, bent |\n|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  std::vector<Solid> solids = listSolids(n);
  if (noise > 0.0)
    solids.resize(1);
  for (const Solid& solid : solids) {
    const Cloud::Ptr samples =
        uvol_test::sampleSmoothField(solid.field, n, seed, false, noise);
    printRow("isopoints", solid, [&] { return findIsopoints(solid, samples); });
    printRow("even", solid, [&] {
      return makeMesh(solid, samples, pcl_uvol::Remeshing::Even);
    });
    printRow("as the cells make it", solid, [&] {
      return makeMesh(solid, samples, pcl_uvol::Remeshing::None);
    });
    if (noise > 0.0)
      printRow("even, smoothed", solid, [&] { return makeSmoothMesh(solid, samples); });
    printRow("Delaunay", solid, [&] { return marchDelaunay(solid, samples); });
    printRow("grid, exact values", solid, [&] { return marchCubes(solid); });
  }
  return 0;
}
