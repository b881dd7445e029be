// SPDX-License-Identifier: BSD-3-Clause
// What a level set starts from.
#pragma once

#include <pcl_uvol/common/export.h>
#include <pcl_uvol/common/parameters.h>

#include <Eigen/Core>

#include <array>
#include <string>
#include <tuple>

namespace pcl_uvol {

/** \brief What the function at the start is. */
enum class InitialKind {
  Values, ///< f - f_iso, scaled to a distance by its slope (default)
  Field,  ///< another scalar field of the cloud, in units of length
  Sphere, ///< signed distances to shapes
  Box,
  Plane
};

/** \return The words for its values in JSON and options. */
constexpr std::array<EnumWord<InitialKind>, 5>
listWords(InitialKind)
{
  return {{{InitialKind::Values, "values"},
           {InitialKind::Field, "field"},
           {InitialKind::Sphere, "sphere"},
           {InitialKind::Box, "box"},
           {InitialKind::Plane, "plane"}}};
}

/** \brief The level-set function at the start: the scaled scalar field itself, a field
 * of the cloud, or the signed distance to a shape, positive inside where values are
 * higher inside (Outside::Lower), else negative. */
struct PCL_UVOL_EXPORTS InitialFunction {
  InitialKind kind = InitialKind::Values;
  std::string field_name; ///< of InitialKind::Field, see ScalarField
  /** Centre of a sphere, lowest corner of a box, a point of a plane. */
  Eigen::Array3d first{0.0, 0.0, 0.0};
  /** Highest corner of a box; normal of a plane to the outside, not 0. */
  Eigen::Array3d second{0.0, 0.0, 0.0};
  double radius = 0.0; ///< of a sphere, > 0

  /** \param radius > 0
   * \param center in the coordinates of the cloud
   * \throws InvalidArgument */
  static InitialFunction
  sphere(const Eigen::Vector3d& center, double radius);

  /** \param low, high opposite corners, low < high along every axis \throws
   * InvalidArgument */
  static InitialFunction
  box(const Eigen::Vector3d& low, const Eigen::Vector3d& high);

  /** \param normal to the outside, not 0
   * \param point any of the plane
   * \throws InvalidArgument */
  static InitialFunction
  plane(const Eigen::Vector3d& point, const Eigen::Vector3d& normal);

  /** \brief A scalar field of the cloud, in units of length; see ScalarField.
   * \param name of the field */
  static InitialFunction
  field(const std::string& name);

  /** \return Whether it is a shape in space, not made of values of the cloud. */
  bool
  isShape() const
  {
    return kind != InitialKind::Values && kind != InitialKind::Field;
  }

  /** \brief Distance of a place to the shape, positive inside.
   *
   * \param scale factors per axis: the distance in the stretched space; that to a
   * sphere is then one to first order, exact at its surface
   * \param x the place, in the coordinates of the cloud */
  double
  computeDistance(const Eigen::Vector3d& x,
                  const Eigen::Array3d& scale = Eigen::Array3d::Ones()) const;

  /** \throws InvalidArgument for a shape that is none */
  void
  check() const;

  /** \return The members under the names that JSON has for them. */
  static auto
  listMembers()
  {
    using Own = InitialFunction;
    return std::make_tuple(Member{"kind", &Own::kind},
                           Member{"field", &Own::field_name},
                           Member{"first", &Own::first},
                           Member{"second", &Own::second},
                           Member{"radius", &Own::radius});
  }
};

} // namespace pcl_uvol
