// SPDX-License-Identifier: BSD-3-Clause
// The window of uvol_viewer: mouse, keys, slider, colour bar.
#pragma once

#include "shared/render_options.h"
#include "viewer/color_choice.h"
#include "viewer/opacity_choice.h"
#include "viewer/scale_bar.h"
#include "viewer/shown_surface.h"
#include "viewer/typed_number.h"
#include "viewer/window_legend.h"
#include <pcl_uvol/vtk/image_space_prop.h>

#include <vtkActor.h>
#include <vtkActor2D.h>
#include <vtkNew.h>
#include <vtkOrientationMarkerWidget.h>
#include <vtkPolyDataMapper.h>
#include <vtkRenderWindow.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkRenderer.h>
#include <vtkSliderRepresentation2D.h>
#include <vtkSliderWidget.h>
#include <vtkSmartPointer.h>
#include <vtkTextActor.h>

#include <array>
#include <functional>
#include <memory>
#include <string>

namespace uvol_tools {

/** \brief A file that is shown. */
struct ShownFile {
  ShownSurface surface;
  RenderOptions look;      ///< which knows the labels and the colours of the file
  pcl_uvol::Report report; ///< of reading it
};

/** \brief Shows a surface until the user closes it. Failures of single actions are told
 * in the window and on stderr. */
class ViewerWindow {
public:
  /** \brief Reads a file as the command line says; surfaces of samples need no isovalue
   * yet. */
  using Open = std::function<ShownFile(const std::string& path)>;

  /** \brief Open the window and draw the first frame. There must be a display.
   * \param path of the file that is shown
   * \param surface outlives the window, its isovalue is set where it has a field
   * \param open reads files that are dropped on the window; empty: none can be
   * \throws pcl_uvol::Exception if it cannot be drawn */
  ViewerWindow(const std::string& path,
               ShownSurface& surface,
               const RenderOptions& look,
               const Options& options,
               pcl_uvol::WindowBackend backend = pcl_uvol::WindowBackend::Auto,
               Open open = {});
  ViewerWindow(const ViewerWindow&) = delete;
  ViewerWindow&
  operator=(const ViewerWindow&) = delete;

  /** \brief Serve mouse and keys until the window is closed. */
  void
  run();

  /** \brief Do what a key does; see describeKeys(). */
  void
  press(char key);

  /** \brief Wait for the surface that was asked for, and show it.
   * \throws what its extraction has thrown */
  void
  finish();

  /** \brief Write what the window shows as a PNG file, once it shows what was asked
   * for.
   * \throws pcl_uvol::Exception if it could not be drawn, IOError */
  void
  save(const std::string& path);

  /** \brief For events from elsewhere. */
  vtkRenderWindowInteractor&
  interactor()
  {
    return *interactor_;
  }

  /** \brief What draws, see ImageSpaceProp::describeBackend. */
  std::string
  describeBackend() const
  {
    return prop_->describeBackend();
  }

  /** \brief Counts and times of the last isosurface and frame, once it is shown. */
  pcl_uvol::Report
  getReport();

private:
  void
  setUpScene(const pcl_uvol::Background& background);

  void
  setUpTexts(const pcl_uvol::Background& background);

  void
  setUpSlider();

  /** Fit slider and histogram to the surface's field. */
  void
  fitSlider();

  void
  nameWindow(const std::string& path);

  /** Show a file in the place of what is shown. */
  void
  openFile(const std::string& path);

  /** Read a file, and extract from its samples what is shown of those before. */
  ShownFile
  readFile(const std::string& path);

  /** Show a surface that has taken the place of another one, with its slider. */
  void
  showOtherSurface();

  /** Show how the axes lie, in a corner. */
  void
  setUpTriad(const pcl_uvol::Background& background);

  /** Keep that corner large enough for letters, and beside the bar. */
  void
  fitTriad();

  /** Before a frame: put surface, bar and axes in their places. */
  void
  fitFrame();

  /** Show a bar of a round length, where all directions have one scale. */
  void
  setUpScaleBar(const pcl_uvol::Background& background);

  /** Show the surface as it is now, coloured. */
  void
  showSurface();

  /** Draw as keys have chosen. */
  void
  applyPasses();

  /** Switch what a key of a pass switches.
   * \return false for other keys */
  bool
  switchPassOf(char key);

  /** Show the triangles of the surface, coloured, instead of its points, if it has any.
   */
  void
  showMesh();

  void
  switchMesh();

  /** Colour by the current field. */
  void
  applyColor();

  void
  nextColor();

  /** Tell what the point at a pixel holds, counted from the lower left. */
  void
  showPoint(int column, int row);

  /** Turn about the point under the mouse from now on. */
  void
  turnAboutPoint();

  /** Cut away what lies in front of the centre of turning, or show it again. */
  void
  switchCut();

  /** Take a key of an isovalue that is typed. */
  void
  typeIsoValue(char key);

  /** Ask for the isosurface of another value. */
  void
  askForIsoValue(double isovalue);

  /** Look soon for the surface that was asked for, if one was. */
  void
  awaitSurface();

  /** Show a surface that has come, and what is to be said of it. */
  void
  showNewSurface();

  /** Ask for the isovalue of the slider. */
  void
  followSlider();

  void
  stepIsoValue(int steps);

  /** Keep the isovalue that moves, or let go of all that are kept. */
  void
  keepIsoValue(bool keeps);

  /** Let light through isovalues as chosen. */
  void
  applyOpacities();

  void
  nextOpacities();

  /** Write the isovalues beside the slider. */
  void
  nameIsoValue();

  /** The part of the window beside the bar and above the slider. */
  PictureCell
  findFreePart() const;

  /** Show what a camera of the whole window sees in the middle of its free part. */
  void
  centerView();

  /** The same of another camera. */
  void
  setCamera(const pcl_uvol::Camera& camera);

  pcl_uvol::Camera
  getCamera() const;

  /** Look at the surface as options say.
   * \param is_placed they place the camera, so that it is fitted to nothing */
  void
  lookFirst(bool is_placed);

  /** Whether nobody has moved the camera since it was fitted to the surface. */
  bool
  isFitted() const;

  /** Show all of the surface from a side. */
  void
  lookFrom(const std::string& side);

  /** Show all of the surface in the direction of a camera. */
  void
  lookAtAll(pcl_uvol::Camera camera);

  /** Call with what cameras are fitted to, and the part of the window that is free. */
  void
  withSeenSurface(const std::function<void(const pcl_uvol::SeenSurface& seen,
                                           const PictureCell& cell)>& call);

  /** A picture of what the window shows, without letters of the window and finer. */
  template <typename RendererT>
  pcl_uvol::Image
  drawPicture(RendererT& renderer);

  /** Print options that give the same view. */
  void
  printCamera();

  /** Save what the window shows, without letters of the window and finer. */
  void
  savePicture();

  /** Save what the window shows as rays see it. */
  void
  saveRayTracedPicture();

  void
  saveSurface();

  void
  render();

  /** Do it; an exception becomes a message. */
  void
  attempt(const std::function<void()>& action);

  void
  showFailure(const std::string& message);

  void
  show(const std::string& message);

  ShownSurface& surface_;
  RenderOptions look_;
  const Open open_;
  std::unique_ptr<ColorChoice> colors_;
  OpacityChoice opacities_;
  pcl_uvol::ImageSpaceSettings passes_;
  TypedNumber typed_;
  pcl_uvol::ColorScale scale_;  // of the slider
  std::array<int, 2> timers_{}; // the last ones; 0: there was none
  bool awaits_surface_ = false;
  std::string error_;       // of the last frame
  pcl_uvol::Camera fitted_; // the last one that was fitted to the surface
  vtkNew<pcl_uvol::ImageSpaceProp> prop_;
  vtkNew<vtkPolyDataMapper> mesh_;
  vtkNew<vtkActor> mesh_actor_;
  vtkNew<vtkRenderer> renderer_;
  vtkNew<vtkRenderWindow> window_;
  vtkNew<vtkRenderWindowInteractor> interactor_;
  vtkNew<vtkTextActor> help_, message_;
  WindowLegend legend_;
  vtkSmartPointer<vtkActor2D> histogram_;
  vtkNew<vtkSliderRepresentation2D> slider_shape_;
  vtkNew<vtkSliderWidget> slider_;
  vtkNew<vtkOrientationMarkerWidget> triad_;
  WindowScaleBar scale_bar_;
};

} // namespace uvol_tools
