// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/scale_bar.h"

#include "charts/view_marks.h"

#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkMath.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper2D.h>
#include <vtkProperty2D.h>
#include <vtkTextProperty.h>

#include <cmath>

namespace uvol_tools {

namespace {

/** Of the window's width. */
constexpr double longest = 0.2;

/** Pixels to the borders of the window, of the lines at the ends, and between bar and
 * text. */
constexpr double margin = 18.0, cap = 4.0, beside = 7.0;

double
pixelsPerUnit(vtkRenderer& renderer)
{
  vtkCamera& camera = *renderer.GetActiveCamera();
  const double half_angle = vtkMath::RadiansFromDegrees(0.5 * camera.GetViewAngle());
  return 0.5 * renderer.GetSize()[1] / (std::tan(half_angle) * camera.GetDistance());
}

} // namespace

void
WindowScaleBar::addTo(vtkRenderer& renderer, double grey)
{
  constexpr int lines = 3;
  vtkNew<vtkCellArray> cells;
  ends_->SetNumberOfPoints(2 * lines);
  for (vtkIdType i = 0; i < lines; ++i)
    cells->InsertNextCell({2 * i, 2 * i + 1});
  vtkNew<vtkPolyData> shape;
  shape->SetPoints(ends_);
  shape->SetLines(cells);
  vtkNew<vtkPolyDataMapper2D> mapper;
  mapper->SetInputData(shape);
  const auto add = [&](vtkActor2D& actor, double ink, float width) {
    actor.SetMapper(mapper);
    actor.GetProperty()->SetColor(ink, ink, ink);
    actor.GetProperty()->SetLineWidth(width);
    renderer.AddViewProp(&actor);
  };
  add(*ground_, grey < 0.5 ? 1.0 : 0.0, 4.0f);
  add(*line_, grey, 2.0f);
  // Above the bar is the slider of the isovalue.
  text_->GetTextProperty()->SetJustificationToRight();
  text_->GetTextProperty()->SetVerticalJustificationToCentered();
  renderer.AddViewProp(text_);
}

void
WindowScaleBar::fit(vtkRenderer& renderer, double factor)
{
  const int* const size = renderer.GetSize();
  const double pixels_per_unit = factor * pixelsPerUnit(renderer);
  const ScaleBar bar(pixels_per_unit, longest * size[0], "");
  const bool is_seen = bar.width > 0.0;
  for (vtkProp* const prop : {static_cast<vtkProp*>(line_),
                              static_cast<vtkProp*>(ground_),
                              static_cast<vtkProp*>(text_)})
    prop->SetVisibility(is_seen);
  if (!is_seen)
    return;
  const double right = size[0] - margin, left = right - bar.width;
  ends_->SetPoint(0, left, margin, 0.0);
  ends_->SetPoint(1, right, margin, 0.0);
  for (const auto& [first, column] : {std::pair(2, left), std::pair(4, right)}) {
    ends_->SetPoint(first, column, margin - cap, 0.0);
    ends_->SetPoint(first + 1, column, margin + cap, 0.0);
  }
  ends_->Modified();
  text_->SetInput(bar.text.c_str());
  text_->SetPosition(left - beside, margin);
}

} // namespace uvol_tools
