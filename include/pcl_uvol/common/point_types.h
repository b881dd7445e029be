// SPDX-License-Identifier: BSD-3-Clause
// Point types, registered with PCL so that its file readers and converters know them.
#pragma once

#include <pcl/point_types.h>
#include <pcl/register_point_struct.h>

/** \brief One point of an isosurface.
 *
 * normal_x/y/z: unit vector to the outside, where values are lower (as for densities
 * and in VTK) unless the extraction was told otherwise; isovalue: the value the surface
 * was extracted for, in units of the scalar field; edge_length: distance of the two
 * samples the point lies between, in units of the coordinates. */
struct EIGEN_ALIGN16 PointIso {
  PCL_ADD_POINT4D;
  PCL_ADD_NORMAL4D;
  union {
    struct {
      float isovalue;
      float edge_length;
    };
    float data_c[4];
  };

  PointIso()
  {
    x = y = z = 0.0f;
    data[3] = 1.0f;
    normal_x = normal_y = normal_z = data_n[3] = 0.0f;
    data_c[0] = data_c[1] = data_c[2] = data_c[3] = 0.0f;
  }
  PCL_MAKE_ALIGNED_OPERATOR_NEW
};

// clang-format off
POINT_CLOUD_REGISTER_POINT_STRUCT(PointIso,
    (float, x, x)(float, y, y)(float, z, z)
    (float, normal_x, normal_x)(float, normal_y, normal_y)(float, normal_z, normal_z)
    (float, isovalue, isovalue)(float, edge_length, edge_length))
// clang-format on
