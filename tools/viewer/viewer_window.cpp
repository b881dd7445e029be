// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/viewer_window.h"

#include "io/files.h"
#include "shared/flat_colors.h"
#include "viewer/keys.h"
#include "viewer/mouse_style.h"
#include "viewer/observe.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/filters/point_data.h>

#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkCommand.h>
#include <vtkErrorCode.h>
#include <vtkPNGWriter.h>
#include <vtkPolyData.h>
#include <vtkProperty.h>
#include <vtkStringArray.h>
#include <vtkWindowToImageFilter.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <string_view>
#include <utility>

namespace uvol_tools {

namespace {

/** The value at a place between the ends of a scale, 0 and 1. */
double
valueAt(const pcl_uvol::ColorScale& scale, double place)
{
  const double value = scale.is_logarithmic
                           ? scale.low * std::pow(scale.high / scale.low, place)
                           : (1.0 - place) * scale.low + place * scale.high;
  return std::clamp(value, scale.low, scale.high);
}

/** Part of the range of the field that + and - move the isovalue by. */
constexpr double isovalue_step = 0.01;

/** Milliseconds between looks for a new surface: less than a frame takes. */
constexpr unsigned long look_interval = 15;

/** Keys that mean the surface that was asked for, and not those on the way to it. */
constexpr std::string_view keys_of_surface = "7efkprsSxXyYzZ";

/** "ERROR: In file, line 5\nImageSpaceProp (0x1): Words.\n\n" -> "Words." */
std::string
extractWords(const std::string& error)
{
  const std::size_t start = error.find("): ");
  std::string words = error.substr(start == std::string::npos ? 0 : start + 3);
  return words.substr(0, words.find('\n'));
}

} // namespace

ViewerWindow::ViewerWindow(const std::string& path,
                           ShownSurface& surface,
                           const RenderOptions& look,
                           const Options& options,
                           pcl_uvol::WindowBackend backend,
                           Open open)
    : surface_(surface)
    , look_(look)
    , open_(std::move(open))
    , opacities_(look.getOpacities())
{
  surface_.finish();
  const pcl::PCLPointCloud2::ConstPtr& cloud = surface_.getCloud();
  if (!cloud)
    throw pcl_uvol::InvalidArgument("no_points_at_isovalue",
                                    {{"field", surface_.getField()}});
  prop_->setBackend(backend);
  pcl_uvol::ImageSpaceRendererBase& renderer = prop_->renderer();
  look_.applyLook(options, pcl_uvol::viewOf(*cloud), renderer);
  passes_ = renderer.settings();
  colors_ = std::make_unique<ColorChoice>(look_, *cloud);
  observe(*prop_, vtkCommand::ErrorEvent, [this](const void* text) {
    error_ = extractWords(static_cast<const char*>(text));
  });
  const pcl_uvol::Background background = renderer.settings().background;
  setUpScene(background);
  setUpTexts(background);
  showSurface();
  lookFirst(options.given("eye"));
  nameWindow(path);
  if (!surface_.getField().empty())
    setUpSlider();
  setUpTriad(background);
  setUpScaleBar(background);
  render();
  if (!error_.empty())
    throw pcl_uvol::Exception(error_);
  // Nobody else tells what is wrong with frames that the system asks for.
  observe(*prop_, vtkCommand::ErrorEvent, [](const void* text) {
    std::cerr << "uvol_viewer: " << extractWords(static_cast<const char*>(text))
              << '\n';
  });
}

void
ViewerWindow::setUpScene(const pcl_uvol::Background& background)
{
  const pcl_uvol::Color& below = background.color;
  const pcl_uvol::Color& top = background.top;
  renderer_->SetBackground(below.r, below.g, below.b);
  renderer_->SetBackground2(top.r, top.g, top.b);
  renderer_->SetGradientBackground(background.kind ==
                                   pcl_uvol::Background::Kind::Gradient);
  renderer_->AddViewProp(prop_);
  mesh_actor_->SetMapper(mesh_);
  mesh_actor_->VisibilityOff();
  mesh_actor_->GetProperty()->SetEdgeVisibility(1);
  mesh_actor_->GetProperty()->SetEdgeColor(0.3, 0.3, 0.3);
  mesh_actor_->GetProperty()->SetColor(0.8, 0.8, 0.8);
  renderer_->AddViewProp(mesh_actor_);
  observe(*renderer_, vtkCommand::StartEvent, [this](const void*) { fitFrame(); });
  window_->SetMultiSamples(0); // the prop smooths its borders itself
  window_->SetSize(look_.getWidth(), look_.getHeight());
  window_->AddRenderer(renderer_);

  vtkNew<MouseStyle> style;
  style->press = [this](char key) { press(key); };
  style->click = [this](int column, int row) {
    attempt([&] {
      finish();
      showPoint(column, row);
    });
    render();
  };
  interactor_->SetRenderWindow(window_);
  interactor_->SetInteractorStyle(style);
  observe(*interactor_, vtkCommand::DropFilesEvent, [this](const void* files) {
    const auto& paths = *static_cast<const vtkStringArray*>(files);
    if (!open_ || paths.GetNumberOfValues() == 0)
      return;
    attempt([&] { openFile(paths.GetValue(0)); });
    render();
  });
  observe(*interactor_, vtkCommand::TimerEvent, [this](const void* timer) {
    if (!awaits_surface_ || *static_cast<const int*>(timer) != timers_[1])
      return;
    awaits_surface_ = false;
    bool is_new = true;
    attempt([&] {
      is_new = surface_.update();
      if (is_new)
        showNewSurface();
    });
    if (is_new) // or an error is to be told
      render();
    awaitSurface();
  });
}

void
ViewerWindow::nameWindow(const std::string& path)
{
  window_->SetWindowName(("uvol_viewer " + path + " (h: keys)").c_str());
}

void
ViewerWindow::showSurface()
{
  prop_->setInputCloud(surface_.getCloud(), surface_.getPrepared());
  applyColor();
  applyOpacities();
  showMesh();
  renderer_->ResetCameraClippingRange();
}

void
ViewerWindow::showMesh()
{
  const bool has_mesh = !surface_.getTriangles().empty();
  mesh_actor_->SetVisibility(has_mesh);
  prop_->SetVisibility(!has_mesh);
  if (!has_mesh)
    return;
  const auto data = pcl_uvol::fromPointCloud(*surface_.getCloud());
  vtkNew<vtkCellArray> triangles;
  for (const auto& [a, b, c] : surface_.getTriangles())
    triangles->InsertNextCell({a, b, c});
  data->SetVerts(nullptr);
  data->SetPolys(triangles);
  mesh_->SetInputData(data);
}

void
ViewerWindow::switchMesh()
{
  surface_.setMeshed(!surface_.isMeshed());
  awaitSurface();
}

void
ViewerWindow::fitTriad()
{
  constexpr double part = 0.14, most = 0.25, least_pixels = 64.0; // of the sides
  const PictureCell free = findFreePart();
  const int* const size = window_->GetSize();
  const auto lengthOn = [&](double side) {
    return std::clamp(least_pixels / side, part, most);
  };
  const double right = static_cast<double>(free.width) / size[0];
  double corner[4] = {
      std::max(0.0, right - lengthOn(size[0])), 1.0 - lengthOn(size[1]), right, 1.0};
  if (!std::equal(corner, corner + 4, triad_->GetViewport()))
    triad_->SetViewport(corner);
}

void
ViewerWindow::fitFrame()
{
  centerView();
  fitTriad();
  legend_.fit(*renderer_, *colors_, prop_->renderer().settings().background);
}

void
ViewerWindow::applyColor()
{
  legend_.change();
  applyPasses();
  if (surface_.getCloud())
    colors_->apply(*surface_.getCloud(), prop_->renderer());
  const std::string& field = colors_->getField();
  mesh_->SetScalarVisibility(colors_->hasScale());
  mesh_->SetScalarModeToUsePointFieldData();
  mesh_->SelectColorArray(field.c_str());
  mesh_->SetLookupTable(&colors_->getTable());
  mesh_->UseLookupTableScalarRangeOn();
}

void
ViewerWindow::applyPasses()
{
  pcl_uvol::ImageSpaceSettings& settings = prop_->renderer().settings();
  settings = passes_;
  if (!colors_->getField().empty())
    showColorsWithoutLight(settings);
}

bool
ViewerWindow::switchPassOf(char key)
{
  const bool is_pass = switchPass(key, passes_);
  if (is_pass)
    applyPasses();
  return is_pass;
}

void
ViewerWindow::nextColor()
{
  const bool had_bar = colors_->hasLegend(), was_fitted = isFitted();
  colors_->next();
  applyColor();
  if (was_fitted && colors_->hasLegend() != had_bar)
    lookAtAll(getCamera());
  const std::string& field = colors_->getField();
  show(field.empty() ? "one colour" : "coloured by " + field);
}

void
ViewerWindow::followSlider()
{
  askForIsoValue(valueAt(scale_, slider_shape_->GetValue()));
}

void
ViewerWindow::askForIsoValue(double isovalue)
{
  surface_.setIsoValue(isovalue);
  nameIsoValue();
  awaitSurface();
}

void
ViewerWindow::awaitSurface()
{
  if (awaits_surface_ || !surface_.isBusy())
    return;
  // VTK uses a timer once more after its event: here the one before is over for sure.
  interactor_->DestroyTimer(timers_[0]);
  timers_ = {{timers_[1], interactor_->CreateOneShotTimer(look_interval)}};
  awaits_surface_ = true;
}

void
ViewerWindow::finish()
{
  if (surface_.finish())
    showNewSurface();
}

void
ViewerWindow::showNewSurface()
{
  showSurface();
  if (typed_.isBegun()) // whose digits are shown
    return;
  const std::size_t triangles = surface_.getTriangles().size();
  show(!surface_.getCloud() ? "no points at this isovalue"
       : triangles > 0      ? std::to_string(triangles) + " triangles"
                            : "");
}

void
ViewerWindow::typeIsoValue(char key)
{
  if (surface_.getField().empty())
    return;
  const std::optional<double> isovalue = typed_.press(key);
  show(typed_.isBegun() ? surface_.getField() + " = " + typed_.getText() + "_" : "");
  if (!isovalue)
    return;
  askForIsoValue(*isovalue);
  slider_shape_->SetValue(scale_.placeOf(*isovalue));
}

void
ViewerWindow::keepIsoValue(bool keeps)
{
  if (surface_.getField().empty())
    return;
  if (keeps)
    surface_.keepIsoValue();
  else
    surface_.setIsoValues({surface_.getIsoValue()});
  nameIsoValue();
  awaitSurface();
}

void
ViewerWindow::applyOpacities()
{
  const bool is_of_samples = !surface_.getField().empty();
  if (surface_.getCloud())
    prop_->renderer().setOpacities(opacities_.find(
        *surface_.getCloud(),
        is_of_samples ? surface_.getIsoValues() : std::vector<double>()));
}

void
ViewerWindow::nextOpacities()
{
  const double opacity = opacities_.next();
  applyOpacities();
  show(opacity < 0.0
           ? "opacities of the options"
           : "opacity " + shortNumber(opacity) + " of all isovalues but the innermost");
}

void
ViewerWindow::nameIsoValue()
{
  const std::vector<double>& isovalues = surface_.getIsoValues();
  std::string text = surface_.getField() + " = " + shortNumber(isovalues.back());
  for (std::size_t i = 0; i + 1 < isovalues.size(); ++i)
    text += (i == 0 ? ", kept: " : ", ") + shortNumber(isovalues[i]);
  slider_shape_->SetTitleText(text.c_str());
}

void
ViewerWindow::stepIsoValue(int steps)
{
  if (surface_.getField().empty())
    return;
  slider_shape_->SetValue(scale_.placeOf(surface_.getIsoValue()) +
                          steps * isovalue_step);
  followSlider();
}

void
ViewerWindow::press(char key)
{
  if (key != 'h')
    help_->VisibilityOff();
  attempt([this, key] {
    if (keys_of_surface.find(key) != std::string_view::npos)
      finish();
    if (key == '=' || typed_.isBegun())
      typeIsoValue(key);
    else if (switchPassOf(key))
      show(colors_->getField().empty() && isInvisible(passes_)
               ? "white without light: 4 and 5 draw lines"
               : "");
    else if (key == 'c')
      nextColor();
    else if (key == 'f')
      turnAboutPoint();
    else if (key == 'k')
      switchCut();
    else if (key == 'm')
      switchMesh();
    else if (key == '+' || key == '-')
      stepIsoValue(key == '+' ? 1 : -1);
    else if (key == 'i' || key == 'I')
      keepIsoValue(key == 'i');
    else if (key == 'o')
      nextOpacities();
    else if (key == 'r')
      lookAtAll(getCamera());
    else if (key == 's')
      savePicture();
    else if (key == 'S')
      saveRayTracedPicture();
    else if (key == 'e')
      saveSurface();
    else if (key == 'p')
      printCamera();
    else if (key == 'h')
      help_->SetVisibility(!help_->GetVisibility());
    else if (const char* const side = sideOf(key))
      lookFrom(side);
    else if (key == 'q')
      interactor_->TerminateApp();
  });
  render();
}

void
ViewerWindow::save(const std::string& path)
{
  finish();
  render();
  if (!error_.empty())
    throw pcl_uvol::Exception(error_);
  vtkNew<vtkWindowToImageFilter> picture;
  picture->SetInput(window_);
  picture->SetInputBufferTypeToRGB();
  picture->ReadFrontBufferOff();
  pcl_uvol::writeAtomically(path, [&](const std::string& temporary_path) {
    vtkNew<vtkPNGWriter> writer;
    writer->SetInputConnection(picture->GetOutputPort());
    writer->SetFileName(temporary_path.c_str());
    writer->Write();
    if (writer->GetErrorCode() != vtkErrorCode::NoError)
      pcl_uvol::io::throwUnwritable(
          path,
          {"library_error",
           "VTK",
           vtkErrorCode::GetStringFromErrorCode(writer->GetErrorCode())});
  });
}

void
ViewerWindow::render()
{
  error_.clear();
  window_->Render();
}

void
ViewerWindow::run()
{
  help_->VisibilityOn(); // until a key is pressed
  render();
  interactor_->Start();
}

pcl_uvol::Report
ViewerWindow::getReport()
{
  finish();
  pcl_uvol::Report report = surface_.getReport();
  report.merge(prop_->renderer().getReport());
  return report;
}

void
ViewerWindow::attempt(const std::function<void()>& action)
{
  try {
    action();
  }
  catch (const pcl_uvol::Exception& error) {
    showFailure(error.asMessage().text(pcl_uvol::ParameterNames::Options));
  }
  catch (const std::exception& error) {
    showFailure(error.what());
  }
}

void
ViewerWindow::showFailure(const std::string& message)
{
  if (!surface_.getField().empty())
    nameIsoValue(); // which is that of the surface before
  show(message);
  if (message != error_) // which was written when it was found
    std::cerr << "uvol_viewer: " << message << '\n';
}

void
ViewerWindow::show(const std::string& message)
{
  message_->SetInput(message.c_str());
  message_->SetVisibility(!message.empty());
}

} // namespace uvol_tools
