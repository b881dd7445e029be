// SPDX-License-Identifier: BSD-3-Clause
// What the window does with single points, and without those in front.
#include "viewer/point_picking.h"
#include "viewer/viewer_window.h"
#include <pcl_uvol/common/cloud_view.h>

#include <vtkCamera.h>

namespace uvol_tools {

void
ViewerWindow::showPoint(int column, int row)
{
  if (!surface_.getCloud())
    return;
  const auto point = findPointAt(*surface_.getCloud(), *renderer_, column, row);
  show(point ? describePoint(*surface_.getData(), surface_.getOrigin(), *point) : "");
}

void
ViewerWindow::turnAboutPoint()
{
  if (!surface_.getCloud())
    return;
  const int* const mouse = interactor_->GetEventPosition();
  const auto point = findPointAt(*surface_.getCloud(), *renderer_, mouse[0], mouse[1]);
  if (!point) {
    show("no point is under the mouse");
    return;
  }
  const float* const p = pcl_uvol::viewOf(*surface_.getCloud()).xyz(*point);
  renderer_->GetActiveCamera()->SetFocalPoint(p[0], p[1], p[2]);
  renderer_->ResetCameraClippingRange();
  show("turns about this point");
}

void
ViewerWindow::switchCut()
{
  if (surface_.isCut())
    surface_.setCut(std::nullopt);
  else {
    const pcl_uvol::Camera camera = getCamera();
    surface_.setCut(
        Eigen::Hyperplane<double, 3>((camera.eye - camera.at).normalized(), camera.at));
  }
  showSurface();
  show(!surface_.isCut()     ? ""
       : surface_.isMeshed() ? "points are cut, a mesh stays whole"
       : surface_.getCloud() ? "cut at the centre of turning"
                             : "all of it is cut away");
}

} // namespace uvol_tools
