// SPDX-License-Identifier: BSD-3-Clause
// Symbols: model takes the cloud's to world coordinates, view these to those of the eye
// (x right, y up, z backward), projection these to clip space.
#include "vtk/window_view.h"

#include <pcl_uvol/common/exceptions.h>

#include <Eigen/Core>
#include <vtkMatrix3x3.h>
#include <vtkMatrix4x4.h>
#include <vtkOpenGLCamera.h>
#include <vtkRenderer.h>

#include <algorithm>
#include <cmath>

namespace pcl_uvol {

namespace {

constexpr double degrees = 180.0 / 3.14159265358979323846;

/** How far, relative to its entries, a matrix may be off: VTK's come from products of
 * several in double, and some users' from float. */
constexpr double matrix_tolerance = 1e-5;

Eigen::Matrix4d
toEigen(const vtkMatrix4x4& matrix, bool is_transposed = false)
{
  using Rows = Eigen::Matrix<double, 4, 4, Eigen::RowMajor>;
  const Eigen::Matrix4d rows = Eigen::Map<const Rows>(&matrix.Element[0][0]);
  return is_transposed ? Eigen::Matrix4d(rows.transpose()) : rows;
}

/** The scale of a matrix that is a rotation times it. */
double
uniformScale(const Eigen::Matrix3d& matrix)
{
  const double scale = std::cbrt(matrix.determinant());
  const Eigen::Matrix3d rotation = matrix / scale;
  if (!(scale > 0.0) || !(rotation * rotation.transpose())
                             .isApprox(Eigen::Matrix3d::Identity(), matrix_tolerance))
    throw InvalidArgument("uneven_camera", {});
  return scale;
}

bool
isParallel(const Eigen::Matrix4d& projection)
{
  if (projection.row(3) == Eigen::RowVector4d(0.0, 0.0, 0.0, 1.0))
    return true;
  if (projection.row(3) != Eigen::RowVector4d(0.0, 0.0, -1.0, 0.0))
    throw InvalidArgument("unknown_projection", {});
  return false;
}

/** How far behind VTK's eye ours is, in the world's unit: for a parallel projection as
 * far as Camera::parallel_fov asks for, from the middle of the cloud. */
double
findRetreat(const Eigen::Matrix4d& projection,
            const Eigen::Matrix4d& cloud_to_eye,
            const BoundingSphere& bounds)
{
  if (!isParallel(projection))
    return 0.0;
  const double middle =
      cloud_to_eye.row(2).dot(bounds.center.homogeneous().transpose());
  return middle +
         1.0 / (projection(1, 1) * std::tan(0.5 * Camera::parallel_fov / degrees));
}

/** Our camera: x right, y down, z forward, in units of the cloud. */
Camera
makeCamera(const Eigen::Matrix4d& cloud_to_eye, double scale, double vertical_fov)
{
  const Eigen::Matrix3d turn = cloud_to_eye.topLeftCorner<3, 3>() / scale;
  Camera camera;
  camera.eye = -turn.transpose() * cloud_to_eye.topRightCorner<3, 1>() / scale;
  // Far from the origin a step of 1 is lost in rounding.
  const double distance = camera.eye.norm(), step = distance > 0x1p20 ? distance : 1.0;
  camera.at = camera.eye - step * turn.row(2).transpose();
  camera.up = turn.row(1).transpose();
  camera.vertical_fov = vertical_fov;
  return camera;
}

} // namespace

WindowView
makeWindowView(vtkRenderer& renderer, vtkMatrix4x4& model, const BoundingSphere& bounds)
{
  auto* const camera = vtkOpenGLCamera::SafeDownCast(renderer.GetActiveCamera());
  if (camera == nullptr)
    throw InvalidArgument("no_opengl_camera", {});
  // VTK's own, so that depths and places agree with those of other props.
  vtkMatrix4x4 *view_matrix, *projection_matrix, *product;
  vtkMatrix3x3* normal_matrix;
  camera->GetKeyMatrices(
      &renderer, view_matrix, normal_matrix, projection_matrix, product);
  Eigen::Matrix4d projection = toEigen(*projection_matrix, true);
  Eigen::Matrix4d cloud_to_eye = toEigen(*view_matrix, true) * toEigen(model);
  const bool is_parallel = isParallel(projection);
  const double retreat = findRetreat(projection, cloud_to_eye, bounds);
  cloud_to_eye(2, 3) -= retreat;
  projection.col(3) += retreat * projection.col(2);
  const double scale = uniformScale(cloud_to_eye.topLeftCorner<3, 3>());

  int width = 0, height = 0;
  GlFramebuffer target;
  renderer.GetTiledSizeAndOrigin(&width, &height, &target.x, &target.y);
  const double focal_x = 0.5 * width * projection(0, 0);
  const double focal_y = 0.5 * height * projection(1, 1);
  if (std::abs(focal_x - focal_y) > matrix_tolerance * focal_y)
    throw InvalidArgument("stretched_pixels", {});
  const double fov = is_parallel ? Camera::parallel_fov
                                 : 2.0 * degrees * std::atan(1.0 / projection(1, 1));
  View view(makeCamera(cloud_to_eye, scale, fov), bounds, width, height);
  Eigen::Vector2d shift = projection.block<2, 1>(0, 2);
  if (is_parallel)
    shift = -projection.topRightCorner<2, 1>();
  view.center_x -= static_cast<float>(0.5 * width * shift.x());
  view.center_y += static_cast<float>(0.5 * height * shift.y());
  const double near = camera->GetClippingRange()[0] + retreat;
  view.near = std::max(view.near, static_cast<float>(view.unit * near / scale));

  const double length = scale / view.unit;
  const Eigen::Vector4d axes(length, -length, -length, 1.0); // from our camera space
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column)
      target.projection[4 * row + column] =
          static_cast<float>(projection(row, column) * axes[column]);
  return {view, target};
}

} // namespace pcl_uvol
