// SPDX-License-Identifier: BSD-3-Clause
// Points of a surface in ParaView's views.
#pragma once

#include <pcl_uvol/common/export.h>

#include <vtkGeometryRepresentationWithFaces.h>

class vtkUvolDiscActor;

/** \brief Shows points with normals as the surface that they lie on, by the image-space
 * rendering of this library. What it shows, and how it is coloured and placed, is set
 * as for ParaView's other representations of geometry. */
class PCL_UVOL_EXPORTS vtkUvolDiscRepresentation
    : public vtkGeometryRepresentationWithFaces {
public:
  vtkTypeMacro(vtkUvolDiscRepresentation, vtkGeometryRepresentationWithFaces);
  static vtkUvolDiscRepresentation*
  New();

  void
  PrintSelf(std::ostream& out, vtkIndent indent) override;

  /** \brief How much darker pits and creases are, in [0, 1]; default 0. */
  void
  SetAmbientOcclusion(double strength);

  /** \brief Draw outlines; default false. */
  void
  SetSilhouettes(bool is_drawn);

  /** \brief Leave out points that look away; default false. */
  void
  SetCullBackFaces(bool are_culled);

  /** \brief Does nothing: while the view turns the actor draws coarser by itself. */
  void
  SetSuppressLOD(bool is_suppressed) override;

protected:
  vtkUvolDiscRepresentation();
  ~vtkUvolDiscRepresentation() override = default;

private:
  vtkUvolDiscRepresentation(const vtkUvolDiscRepresentation&) = delete;
  void
  operator=(const vtkUvolDiscRepresentation&) = delete;

  vtkUvolDiscActor&
  discs();
};
