// SPDX-License-Identifier: BSD-3-Clause
// How long lengths are in the window.
#pragma once

#include <vtkActor2D.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkRenderer.h>
#include <vtkTextActor.h>

namespace uvol_tools {

/** \brief A bar of a round length in the lower right corner, as lengths look where the
 * camera turns about. */
class WindowScaleBar {
public:
  /** \brief Show it from now on.
   * \param grey of its lines */
  void
  addTo(vtkRenderer& renderer, double grey);

  /** \brief Make it fit the camera.
   * \param factor that data are stretched by */
  void
  fit(vtkRenderer& renderer, double factor);

  vtkTextProperty&
  getLetters()
  {
    return *text_->GetTextProperty();
  }

private:
  vtkNew<vtkPoints> ends_;           // of the bar, and of the line across each end
  vtkNew<vtkActor2D> line_, ground_; // which makes it seen on any surface
  vtkNew<vtkTextActor> text_;
};

} // namespace uvol_tools
