// SPDX-License-Identifier: BSD-3-Clause
// What lies over the surface in the window: texts, slider, triad and scale bar.
#include "viewer/keys.h"
#include "viewer/observe.h"
#include "viewer/value_histogram.h"
#include "viewer/viewer_window.h"

#include <vtkAxesActor.h>
#include <vtkCaptionActor2D.h>
#include <vtkCommand.h>
#include <vtkProperty2D.h>
#include <vtkTextProperty.h>

#include <utility>

namespace uvol_tools {

namespace {

/** What is read on a background. */
double
greyOn(const pcl_uvol::Background& background)
{
  const pcl_uvol::Color& color = background.color;
  return color.r + color.g + color.b > 1.5f ? 0.15 : 0.85;
}

void
setColor(vtkTextProperty& text, double grey)
{
  // Letters are read on any surface.
  constexpr double opacity = 0.6;
  const double ground = grey < 0.5 ? 1.0 : 0.0;
  text.SetColor(grey, grey, grey);
  text.SetBackgroundColor(ground, ground, ground);
  text.SetBackgroundOpacity(opacity);
  text.SetFontSize(12);
  text.ShadowOff();
  text.ItalicOff();
  text.BoldOff();
}

} // namespace

void
ViewerWindow::setUpTexts(const pcl_uvol::Background& background)
{
  const double grey = greyOn(background);
  setColor(*help_->GetTextProperty(), grey);
  setColor(*message_->GetTextProperty(), grey);
  setColor(*slider_shape_->GetTitleProperty(), grey);
  setColor(*slider_shape_->GetLabelProperty(), grey);
  help_->SetInput(describeKeys().c_str());
  help_->GetPositionCoordinate()->SetCoordinateSystemToNormalizedViewport();
  help_->SetPosition(0.02, 0.98);
  help_->GetTextProperty()->SetVerticalJustificationToTop();
  help_->VisibilityOff();
  message_->GetPositionCoordinate()->SetCoordinateSystemToNormalizedViewport();
  message_->SetPosition(0.02, 0.02);
  message_->VisibilityOff();
  legend_.addTo(*renderer_);
  renderer_->AddViewProp(help_);
  renderer_->AddViewProp(message_);
}

void
ViewerWindow::setUpSlider()
{
  slider_shape_->SetMinimumValue(0.0);
  slider_shape_->SetMaximumValue(1.0);
  slider_shape_->ShowSliderLabelOff();
  slider_shape_->SetSliderLength(0.03); // parts of the window
  slider_shape_->SetSliderWidth(0.03);
  slider_shape_->SetTubeWidth(0.008);
  slider_shape_->SetEndCapLength(0.0);
  slider_shape_->GetTubeProperty()->SetColor(0.6, 0.6, 0.6);
  slider_shape_->GetCapProperty()->SetColor(0.6, 0.6, 0.6);
  slider_shape_->GetSliderProperty()->SetColor(0.2, 0.4, 0.7);
  slider_shape_->GetSelectedProperty()->SetColor(0.3, 0.6, 1.0);
  for (const auto& [end, x] : {std::pair(slider_shape_->GetPoint1Coordinate(), 0.1),
                               std::pair(slider_shape_->GetPoint2Coordinate(), 0.9)}) {
    end->SetCoordinateSystemToNormalizedDisplay();
    end->SetValue(x, 0.12);
  }
  message_->SetPosition(0.02, 0.21); // above the slider, below which isovalues stand
  fitSlider();
  slider_->KeyPressActivationOff(); // else the key i hides it
  slider_->SetInteractor(interactor_);
  slider_->SetRepresentation(slider_shape_);
  slider_->SetAnimationModeToJump();
  observe(*slider_, vtkCommand::InteractionEvent, [this](const void*) {
    attempt([this] { followSlider(); });
  });
  slider_->EnabledOn();
}

void
ViewerWindow::fitSlider()
{
  // Fields of many decades have most of their surfaces in the lower ones.
  constexpr double many_decades = 1e3;
  const auto& [low, high] = surface_.getRange();
  scale_ = {low, high, low > 0.0 && high / low >= many_decades};
  slider_shape_->SetValue(scale_.placeOf(surface_.getIsoValue()));
  nameIsoValue();
  renderer_->RemoveViewProp(histogram_);
  histogram_ = drawHistogram(surface_.readValues(), scale_, {{0.1, 0.125, 0.9, 0.2}});
  renderer_->AddViewProp(histogram_);
}

void
ViewerWindow::setUpTriad(const pcl_uvol::Background& background)
{
  vtkNew<vtkAxesActor> axes;
  axes->SetXAxisLabelText("x");
  axes->SetYAxisLabelText("y");
  axes->SetZAxisLabelText("z");
  for (vtkCaptionActor2D* const caption : {axes->GetXAxisCaptionActor2D(),
                                           axes->GetYAxisCaptionActor2D(),
                                           axes->GetZAxisCaptionActor2D()}) {
    vtkTextProperty& letters = *caption->GetCaptionTextProperty();
    setColor(letters, greyOn(background));
    letters.SetBackgroundOpacity(0.0);
    caption->GetTextActor()->SetTextScaleModeToNone(); // else it goes by the corner
  }
  triad_->SetOrientationMarker(axes);
  triad_->KeyPressActivationOff(); // else the key i hides it
  triad_->SetInteractor(interactor_);
  triad_->EnabledOn();
  triad_->InteractiveOff(); // the mouse turns the surface there, too
}

void
ViewerWindow::setUpScaleBar(const pcl_uvol::Background& background)
{
  const double grey = greyOn(background);
  const double factor = surface_.getFactors().x();
  if (surface_.getFactors() != Eigen::Vector3d::Constant(factor))
    return;
  setColor(scale_bar_.getLetters(), grey);
  scale_bar_.addTo(*renderer_, grey);
  observe(*renderer_, vtkCommand::StartEvent, [this, factor](const void*) {
    scale_bar_.fit(*renderer_, factor);
  });
}

} // namespace uvol_tools
