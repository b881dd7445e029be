// SPDX-License-Identifier: BSD-3-Clause
// Point types, registered with PCL so that its file readers and converters know them.
#pragma once

#include <pcl_uvol/common/export.h>

#include <pcl/pcl_base.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>
#include <pcl/register_point_struct.h>

#include <cstdint>
#include <limits>

namespace pcl_uvol {

/** \brief What an isopoint stands on. */
enum class IsoSupport : std::uint8_t {
  Unknown = 0,  ///< not examined: linear interpolation
  Measured = 1, ///< samples all around
  Bridged = 2,  ///< its edge reaches across a gap of the sampling, or past samples
  Rim = 3,      ///< beside a wide cone without samples: border of a gap or of the cloud
  Predicted = 4 ///< in a gap that was filled with predicted samples, see GapFilling
};

/** \brief One point of an isosurface. Lengths are in units of the coordinates.
 *
 * normal_x/y/z: unit vector to the outside, by default where values are lower (as for
 * densities and in VTK); isovalue: the value the surface was extracted for, in units of
 * the scalar field; mean_curvature: 1/length, positive where the enclosed side is
 * convex, NaN where no fit gave one; error: estimated distance to the true surface, NaN
 * where there is no estimate; edge_length: distance of the two samples the point lies
 * between; support: an IsoSupport. */
struct EIGEN_ALIGN16 PointIso {
  PCL_ADD_POINT4D;
  PCL_ADD_NORMAL4D;
  union {
    struct {
      float isovalue;
      float mean_curvature;
      float error;
      float edge_length;
    };
    float data_c[4];
  };
  union {
    std::uint8_t support;
    float data_s[4];
  };

  PointIso()
  {
    x = y = z = 0.0f;
    data[3] = 1.0f;
    normal_x = normal_y = normal_z = data_n[3] = 0.0f;
    isovalue = edge_length = 0.0f;
    mean_curvature = error = std::numeric_limits<float>::quiet_NaN();
    data_s[0] = data_s[1] = data_s[2] = data_s[3] = 0.0f;
    support = static_cast<std::uint8_t>(IsoSupport::Unknown);
  }
  PCL_MAKE_ALIGNED_OPERATOR_NEW
};

/** \brief First derivatives of a scalar field, per unit of length, and the mean
 * curvature of its level set, half the divergence of the normalised gradient: 1/length,
 * positive where the level set bulges towards higher values of the field. NaN where no
 * derivatives are available. */
struct PointGradient {
  float gradient_x, gradient_y, gradient_z;
  float mean_curvature;

  PointGradient()
  {
    gradient_x = gradient_y = gradient_z = mean_curvature =
        std::numeric_limits<float>::quiet_NaN();
  }
};

/** \brief A disc that covers a part of a surface, with a linear field of normals
 * (thesis 4.2.1).
 *
 * x, y, z: centre; normal_x/y/z: unit normal of its plane, to the outside; radius: a
 * length; error: largest distance of the points that it covers to its plane, a length;
 * tangent_x/y/z: unit vector u in the plane, the direction in which the normals turn
 * most or least, v is the normal times u. The normal at (u, v), in radii from the
 * centre, is normal + (tilt_u + slope_u u) u + (tilt_v + slope_v v) v. It does not have
 * unit length (equation 4.1 with slope = lambda r, and with the centre's normal free).
 */
struct EIGEN_ALIGN16 PointSplat {
  PCL_ADD_POINT4D;
  PCL_ADD_NORMAL4D;
  union {
    struct {
      float tangent_x;
      float tangent_y;
      float tangent_z;
      float radius;
    };
    float data_t[4];
  };
  float error = 0.0f;
  float tilt_u = 0.0f, tilt_v = 0.0f;
  float slope_u = 0.0f, slope_v = 0.0f;

  PointSplat()
  {
    x = y = z = 0.0f;
    data[3] = 1.0f;
    normal_x = normal_y = normal_z = data_n[3] = 0.0f;
    tangent_x = tangent_y = tangent_z = radius = 0.0f;
  }

  /** \return tangent_x, tangent_y and tangent_z, to be read and written. */
  Eigen::Map<Eigen::Vector3f>
  getTangentVector3fMap()
  {
    return Eigen::Map<Eigen::Vector3f>(data_t);
  }

  /** \return tangent_x, tangent_y and tangent_z. */
  Eigen::Map<const Eigen::Vector3f>
  getTangentVector3fMap() const
  {
    return Eigen::Map<const Eigen::Vector3f>(data_t);
  }
  PCL_MAKE_ALIGNED_OPERATOR_NEW
};

/** \brief Isopoints as PCL's own points with normals, for algorithms that PCL has
 * compiled for these: clustering, triangulation, registration. curvature is the mean
 * curvature.
 * \param isopoints of an extraction */
PCL_UVOL_EXPORTS pcl::PointCloud<pcl::PointNormal>
toPointNormal(const pcl::PointCloud<PointIso>& isopoints);

} // namespace pcl_uvol

// clang-format off
POINT_CLOUD_REGISTER_POINT_STRUCT(pcl_uvol::PointIso,
    (float, x, x)(float, y, y)(float, z, z)
    (float, normal_x, normal_x)(float, normal_y, normal_y)(float, normal_z, normal_z)
    (float, isovalue, isovalue)(float, mean_curvature, mean_curvature)
    (float, error, error)(float, edge_length, edge_length)
    (std::uint8_t, support, support))
POINT_CLOUD_REGISTER_POINT_STRUCT(pcl_uvol::PointSplat,
    (float, x, x)(float, y, y)(float, z, z)
    (float, normal_x, normal_x)(float, normal_y, normal_y)(float, normal_z, normal_z)
    (float, radius, radius)(float, error, error)
    (float, tangent_x, tangent_x)(float, tangent_y, tangent_y)(float, tangent_z, tangent_z)
    (float, tilt_u, tilt_u)(float, tilt_v, tilt_v)
    (float, slope_u, slope_u)(float, slope_v, slope_v))
POINT_CLOUD_REGISTER_POINT_STRUCT(pcl_uvol::PointGradient,
    (float, gradient_x, gradient_x)(float, gradient_y, gradient_y)
    (float, gradient_z, gradient_z)(float, mean_curvature, mean_curvature))
// clang-format on

// What stages on isosurfaces derive from. PCL has it, KdTreeFLANN and search::KdTree
// compiled for its own types only; core has all of them for isopoints.
extern template class PCL_UVOL_EXPORTS pcl::PCLBase<pcl_uvol::PointIso>;
