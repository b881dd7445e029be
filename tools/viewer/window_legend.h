// SPDX-License-Identifier: BSD-3-Clause
// What the colours in the window stand for.
#pragma once

#include "viewer/color_choice.h"
#include <pcl_uvol/render/color_map.h>

#include <vtkActor2D.h>
#include <vtkImageMapper.h>
#include <vtkNew.h>
#include <vtkRenderer.h>

namespace uvol_tools {

/** \brief The bar that pictures have, on ground of its own as in these: what the window
 * shows beside it is what pictures show. */
class WindowLegend {
public:
  /** \brief Show it from now on, below all that is added later. */
  void
  addTo(vtkRenderer& renderer);

  /** \brief Draw it anew for the next frame. */
  void
  change()
  {
    is_drawn_ = false;
  }

  /** \brief Make it fit the window's size, unless it does. */
  void
  fit(vtkRenderer& renderer,
      const ColorChoice& colors,
      const pcl_uvol::Background& background);

private:
  vtkNew<vtkImageMapper> mapper_;
  vtkNew<vtkActor2D> actor_;
  bool is_drawn_ = false;
  int width_ = 0, height_ = 0;
};

} // namespace uvol_tools
