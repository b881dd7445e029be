// SPDX-License-Identifier: BSD-3-Clause
#include "common/parameter_json.h"
#include "common/stretch_axes.h"
#include "neighbors/periodic_box.h"
#include "pipeline/periodic_surface.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/pipeline/isosurface_pipeline_parameters.h>

namespace pcl_uvol {

std::string
IsosurfacePipelineParameters::toJson() const
{
  return writeJson(*this);
}

IsosurfacePipelineParameters
IsosurfacePipelineParameters::fromJson(const std::string& text)
{
  return readJson<IsosurfacePipelineParameters>(text);
}

void
checkParameters(const IsosurfacePipelineParameters& parameters)
{
  checkParameters(parameters.isosurface);
  const bool fits = parameters.isosurface.interpolation != Interpolation::Linear;
  if (parameters.normals == NormalMethod::Fit && !fits)
    throw InvalidArgument("Normals by fits need interpolation by fits: linear "
                          "interpolation makes none.");
  if (parameters.validation.folds == 1)
    throw InvalidArgument("A hold-out test with 1 fold leaves no samples: give at "
                          "least 2.");
  if (parameters.normal_neighbors < 2)
    throw InvalidArgument("Normals from " +
                          std::to_string(parameters.normal_neighbors) +
                          " neighbours are not possible: there must be at least 2.");
  if (parameters.max_error && !(*parameters.max_error >= 0.0))
    throw InvalidArgument("The largest error is " +
                          std::to_string(*parameters.max_error) +
                          ": it must be a length from 0.");
  if (parameters.max_error && parameters.automatic_max_error)
    throw InvalidArgument("The largest error is a length or automatic, not both.");
  const bool is_turned = detail::StretchAxes(parameters.rotation).areTurned();
  checkPeriodic(sidesOf(parameters));
  if (isPeriodic(sidesOf(parameters)) && is_turned)
    throw InvalidArgument("A box that repeats goes without a rotation: its sides lie "
                          "along x, y and z.");
  if (isPeriodic(sidesOf(parameters)) && parameters.validation.folds > 0)
    throw InvalidArgument("A hold-out test goes without a box that repeats: images of "
                          "samples that are left out would tell what they are.");
  if (isPeriodic(sidesOf(parameters)) && parameters.fill_gaps)
    throw InvalidArgument("Gaps are not filled in a box that repeats: samples that "
                          "kriging adds would have no images.");
  if (parameters.periodic_mesh == PeriodicMesh::Weld &&
      (!parameters.mesh || !isPeriodic(sidesOf(parameters))))
    throw InvalidArgument(
        "Only a mesh in a box that repeats can be welded across its faces.");
  if (!parameters.mesh)
    return;
  checkParameters(SurfaceMeshParameters{parameters.isosurface, *parameters.mesh});
  if (parameters.max_error || parameters.automatic_max_error || parameters.drop_bridged)
    throw InvalidArgument(
        "A mesh keeps all of its vertices: leave out the bound of the "
        "error and bridged points, or the mesh.");
  if (parameters.normals == NormalMethod::Pca)
    throw InvalidArgument(
        "The vertices of a mesh have the normals of their fits: those "
        "by principal components are for isopoints.");
}

} // namespace pcl_uvol
