// SPDX-License-Identifier: BSD-3-Clause
// Splats of a surface given as points in a VTK pipeline.
#pragma once

#include <pcl_uvol/filters/vtkUvolFilter.h>

/** \brief Discs with fields of normals that cover a surface given as points: what
 * pcl_uvol::SplatGeneration and the tool uvol_splats make.
 *
 * The input's active normals are used; where it has none they are estimated, with a
 * warning. Output points are the centres; arrays besides those of the points that discs
 * are grown from: Normals (active), tangent_x, tangent_y, tangent_z, radius, error,
 * tilt_u, tilt_v, slope_u, slope_v; see PointSplat. */
class PCL_UVOL_EXPORTS vtkUvolSplats : public vtkUvolFilter {
public:
  vtkTypeMacro(vtkUvolSplats, vtkUvolFilter);
  /** \return A new object, to be held by a vtkNew or vtkSmartPointer. */
  static vtkUvolSplats*
  New();

  /** \brief Write the settings, as VTK's classes do.
   * \param out where to
   * \param indent in front of each line */
  void
  PrintSelf(std::ostream& out, vtkIndent indent) override;

  /** \brief Largest distance of points to the disc that covers them, > 0: as a part of
   * the longest side of the bounding box of all points but a few far ones, or as a
   * length. Default 1e-4, a part. @{ */
  vtkSetMacro(Delta, double);
  vtkGetMacro(Delta, double);
  vtkSetMacro(DeltaIsLength, bool);
  vtkGetMacro(DeltaIsLength, bool);
  vtkBooleanMacro(DeltaIsLength, bool);
  /** @} */

  /** \brief Part of a disc's radius within which no other one starts. Default 0.2.
   * @{ */
  vtkSetClampMacro(Lambda, double, 0.0, 1.0);
  vtkGetMacro(Lambda, double);
  /** @} */

protected:
  vtkUvolSplats() = default;
  ~vtkUvolSplats() override = default;

  void
  Execute(pcl_uvol::FilterRun& run) override;

private:
  vtkUvolSplats(const vtkUvolSplats&) = delete;
  void
  operator=(const vtkUvolSplats&) = delete;

  double Delta = 1e-4;
  bool DeltaIsLength = false;
  double Lambda = 0.2;
};
