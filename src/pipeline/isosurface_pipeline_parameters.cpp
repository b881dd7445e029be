// SPDX-License-Identifier: BSD-3-Clause
#include "common/parameter_json.h"
#include "common/stretch_axes.h"
#include "neighbors/periodic_box.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/pipeline/isosurface_pipeline_parameters.h>

#include <cmath>

namespace pcl_uvol {

Interpolation
IsosurfacePipelineParameters::takenInterpolation() const
{
  const Interpolation asked = isosurface.interpolation;
  const bool ends = outside_value && !mesh;
  return ends && asked == Interpolation::Auto ? Interpolation::Linear : asked;
}

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
  const bool fits = parameters.takenInterpolation() != Interpolation::Linear;
  if (parameters.normals == NormalMethod::Fit && !fits)
    throw InvalidArgument("linear_with_fitted_normals", {});
  if (parameters.validation.folds == 1)
    throw InvalidArgument("hold_out_of_one_fold", {});
  if (parameters.normal_neighbors < 2)
    throw InvalidArgument("few_normal_neighbors",
                          {{"neighbors", parameters.normal_neighbors}});
  if (parameters.max_error && !(*parameters.max_error >= 0.0))
    throw InvalidArgument("largest_error_not_allowed",
                          {{"error", *parameters.max_error}});
  if (parameters.max_error && parameters.automatic_max_error)
    throw InvalidArgument("two_largest_errors", {});
  if (parameters.outside_value && !std::isfinite(*parameters.outside_value))
    throw InvalidArgument("value_outside_not_finite",
                          {{"value", *parameters.outside_value}});
  if (parameters.outside_value && parameters.fill_gaps)
    throw InvalidArgument("gaps_beside_value_outside", {});
  const bool is_turned = detail::StretchAxes(parameters.rotation).areTurned();
  const Eigen::Array3d& box = parameters.periodic;
  checkPeriodic({{box[0], box[1], box[2]}});
  const bool is_periodic = (box > 0.0).any();
  if (is_periodic && is_turned)
    throw InvalidArgument("turned_periodic_box", {});
  if (is_periodic && parameters.validation.folds > 0)
    throw InvalidArgument("hold_out_in_periodic_box", {});
  if (is_periodic && parameters.fill_gaps)
    throw InvalidArgument("gaps_in_periodic_box", {});
  if (is_periodic && parameters.outside_value)
    throw InvalidArgument("value_outside_of_periodic_box", {});
  if (parameters.periodic_mesh == PeriodicMesh::Weld &&
      (!parameters.mesh || !is_periodic))
    throw InvalidArgument("nothing_to_weld", {});
  if (!parameters.mesh)
    return;
  checkParameters(SurfaceMeshParameters{parameters.isosurface, *parameters.mesh});
  if (parameters.max_error || parameters.automatic_max_error || parameters.drop_bridged)
    throw InvalidArgument("mesh_without_points", {});
  if (parameters.normals == NormalMethod::Pca)
    throw InvalidArgument("mesh_with_pca_normals", {});
}

} // namespace pcl_uvol
