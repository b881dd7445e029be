// SPDX-License-Identifier: BSD-3-Clause
// What the mouse does in the window.
#pragma once

#include <vtkInteractorStyleTrackballCamera.h>
#include <vtkRenderWindowInteractor.h>

#include <algorithm>
#include <cstdlib>
#include <functional>

namespace uvol_tools {

/** \brief VTK's way to turn, move and zoom with the mouse, without its keys. */
class MouseStyle : public vtkInteractorStyleTrackballCamera {
public:
  vtkTypeMacro(MouseStyle, vtkInteractorStyleTrackballCamera);
  static MouseStyle*
  New();

  void
  OnChar() override
  {
    press(Interactor->GetKeyCode());
  }

  /** VTK's own would turn on while a button is held: the timers are not meant for it.
   */
  void
  OnTimer() override
  {
  }

  void
  OnLeftButtonDown() override
  {
    std::copy_n(Interactor->GetEventPosition(), 2, pressed_at_);
    vtkInteractorStyleTrackballCamera::OnLeftButtonDown();
  }

  void
  OnLeftButtonUp() override
  {
    vtkInteractorStyleTrackballCamera::OnLeftButtonUp();
    const int* const at = Interactor->GetEventPosition();
    if (std::abs(at[0] - pressed_at_[0]) + std::abs(at[1] - pressed_at_[1]) <=
        still_pixels)
      click(at[0], at[1]);
  }

  std::function<void(char)> press;
  std::function<void(int column, int row)> click;

private:
  /** A hand that clicks moves the mouse by no more. */
  static constexpr int still_pixels = 2;

  int pressed_at_[2] = {0, 0};
};

} // namespace uvol_tools
