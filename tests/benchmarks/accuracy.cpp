// SPDX-License-Identifier: BSD-3-Clause
// Deviation from the true surface: linear and smooth isopoints of scattered samples,
// and VTK's marching cubes (flying edges) on a regular grid of as many exact values.
#include "support/smooth_fields.h"
#include <pcl_uvol/isosurface/isosurface_extraction.h>

#include <vtkFloatArray.h>
#include <vtkFlyingEdges3D.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>

namespace {

using uvol_test::SmoothField;
using Surface = pcl::PointCloud<pcl_uvol::PointIso>;

Surface
isopoints(const SmoothField& field,
          std::size_t n,
          std::uint64_t seed,
          bool clustered,
          pcl_uvol::Interpolation interpolation)
{
  pcl_uvol::IsosurfaceExtraction<pcl::PointXYZI> extraction;
  extraction.setInputCloud(uvol_test::sampleSmoothField(field, n, seed, clustered));
  extraction.setIsoValue(field.isovalue);
  extraction.setInterpolation(interpolation);
  Surface surface;
  extraction.extract(surface);
  return surface;
}

/** Vertices of marching cubes on a grid of spacing 1. */
Surface
marchingCubes(const SmoothField& field)
{
  const int nodes = static_cast<int>(std::lround(field.side));
  vtkNew<vtkImageData> grid;
  grid->SetDimensions(nodes, nodes, nodes);
  const double lower = -0.5 * (nodes - 1);
  grid->SetOrigin(lower, lower, lower);
  grid->AllocateScalars(VTK_FLOAT, 1);
  auto* value = static_cast<float*>(grid->GetScalarPointer());
  for (int k = 0; k < nodes; ++k)
    for (int j = 0; j < nodes; ++j)
      for (int i = 0; i < nodes; ++i)
        *value++ = static_cast<float>(
            field.value(Eigen::Vector3d(lower + i, lower + j, lower + k)));
  vtkNew<vtkFlyingEdges3D> contour;
  contour->SetInputData(grid);
  contour->SetValue(0, field.isovalue);
  contour->Update();
  Surface surface;
  for (vtkIdType i = 0; i < contour->GetOutput()->GetNumberOfPoints(); ++i) {
    double x[3];
    contour->GetOutput()->GetPoint(i, x);
    pcl_uvol::PointIso point;
    point.getVector3fMap() = Eigen::Vector3d(x).cast<float>();
    surface.push_back(point);
  }
  return surface;
}

void
printRow(const SmoothField& field,
         std::size_t n,
         std::uint64_t seed,
         const char* method,
         const Surface& surface)
{
  const auto found = uvol_test::deviations(field, surface);
  std::printf("%s %zu %d %s %zu %.3g %.3g %.3g\n",
              field.name,
              n,
              static_cast<int>(seed),
              method,
              found.size(),
              uvol_test::mean(found),
              uvol_test::quantile(found, 0.999),
              uvol_test::quantile(found, 1.0));
  std::fflush(stdout);
}

} // namespace

/** accuracy FIELD uniform|clustered SEEDS N...: one row per N, seed and method. */
int
main(int argc, char** argv)
{
  if (argc < 5) {
    std::fputs("usage: accuracy radial|waves|decay|gyroid|torus uniform|clustered "
               "SEEDS N...\n",
               stderr);
    return 2;
  }
  const bool clustered = std::string(argv[2]) == "clustered";
  const auto seeds = static_cast<std::uint64_t>(std::atoi(argv[3]));
  std::puts("# field samples seed method points mean 99.9_% maximum");
  for (int i = 4; i < argc; ++i) {
    const auto n = static_cast<std::size_t>(std::atof(argv[i]));
    const SmoothField field = uvol_test::makeSmoothField(argv[1], n);
    for (std::uint64_t seed = 1; seed <= seeds; ++seed)
      for (const auto& [name, interpolation] :
           {std::pair("linear", pcl_uvol::Interpolation::Linear),
            std::pair("smooth", pcl_uvol::Interpolation::Fit)})
        printRow(
            field, n, seed, name, isopoints(field, n, seed, clustered, interpolation));
    if (!clustered)
      printRow(field, n, 0, "marching_cubes", marchingCubes(field));
  }
  return 0;
}
