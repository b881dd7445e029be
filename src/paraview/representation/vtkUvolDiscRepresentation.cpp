// SPDX-License-Identifier: BSD-3-Clause
#include "paraview/representation/vtkUvolDiscRepresentation.h"

#include "paraview/representation/vtkUvolDiscActor.h"

#include <vtkObjectFactory.h>

vtkStandardNewMacro(vtkUvolDiscRepresentation);

vtkUvolDiscRepresentation::vtkUvolDiscRepresentation()
{
  Actor->Delete();
  Actor = vtkUvolDiscActor::New();
  SetupDefaults();
  SuppressLOD = true;
}

void
vtkUvolDiscRepresentation::PrintSelf(std::ostream& out, vtkIndent indent)
{
  Superclass::PrintSelf(out, indent);
}

vtkUvolDiscActor&
vtkUvolDiscRepresentation::discs()
{
  return *static_cast<vtkUvolDiscActor*>(Actor);
}

void
vtkUvolDiscRepresentation::SetAmbientOcclusion(double strength)
{
  discs().settings().ambient_occlusion = strength;
}

void
vtkUvolDiscRepresentation::SetSilhouettes(bool is_drawn)
{
  discs().settings().silhouettes = is_drawn;
}

void
vtkUvolDiscRepresentation::SetCullBackFaces(bool are_culled)
{
  discs().settings().cull_back_faces = are_culled;
}

void
vtkUvolDiscRepresentation::SetSuppressLOD(bool)
{
}
