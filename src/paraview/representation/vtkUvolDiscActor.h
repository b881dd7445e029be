// SPDX-License-Identifier: BSD-3-Clause
// What draws points in ParaView's views.
#pragma once

#include <pcl_uvol/vtk/image_space_prop.h>

#include <vtkNew.h>
#include <vtkPVLODActor.h>
#include <vtkSmartPointer.h>
#include <vtkTimeStamp.h>

#include <array>

class vtkDataObject;
class vtkPolyData;

/** \brief An actor whose points are drawn as a surface by image-space rendering.
 *
 * Points are those of the mapper's input, colours those of its lookup table, colour,
 * opacity and place those of the actor. Triangles and lines, and what a selection looks
 * for, are drawn as other actors' are. Errors as ImageSpaceProp. */
class vtkUvolDiscActor : public vtkPVLODActor {
public:
  vtkTypeMacro(vtkUvolDiscActor, vtkPVLODActor);
  static vtkUvolDiscActor*
  New();

  void
  PrintSelf(std::ostream& out, vtkIndent indent) override;

  /** \brief Settings of the passes. */
  pcl_uvol::ImageSpaceSettings&
  settings()
  {
    return discs_->renderer().settings();
  }

  int
  RenderOpaqueGeometry(vtkViewport* viewport) override;

  /** \return 0 for points, which are drawn with what is opaque. */
  vtkTypeBool
  HasTranslucentPolygonalGeometry() override;

  void
  ReleaseGraphicsResources(vtkWindow* window) override;

protected:
  vtkUvolDiscActor() = default;
  ~vtkUvolDiscActor() override = default;

private:
  vtkUvolDiscActor(const vtkUvolDiscActor&) = delete;
  void
  operator=(const vtkUvolDiscActor&) = delete;

  /** Take the mapper's input if it has changed. */
  void
  readInput();

  void
  convertPoints();

  /** Take the look of the actor. */
  void
  applyLook(vtkRenderer& renderer);

  void
  colorPoints();

  vtkSmartPointer<vtkDataObject> input_; // that was read last
  vtkSmartPointer<vtkPolyData> points_;  // of all its blocks
  vtkTimeStamp read_, converted_, colored_;
  std::array<double, 3> origin_{}; // that was subtracted from the coordinates
  vtkNew<pcl_uvol::ImageSpaceProp> discs_;
};
