// SPDX-License-Identifier: BSD-3-Clause
// The door between image-space rendering and what carries out its passes (thesis 4.3):
// what these do, and plain C++ or OpenGL (gl/context.h) that does it. All give the same
// picture.
#pragma once

#include <pcl_uvol/common/export.h>
#include <pcl_uvol/common/stage.h>
#include <pcl_uvol/render/color_map.h>
#include <pcl_uvol/render/renderer.h>

#include <string>
#include <vector>

namespace pcl_uvol {

/** \brief Low-pass filters of size 3 x 3 (Table 4.1). */
enum class SmoothingFilter {
  None,
  Box,               ///< all pixels alike
  Gaussian,          ///< 1 2 1, 2 4 2, 1 2 1
  AlleviatedGaussian ///< the same with 16 in the middle (default)
};

/** \brief Steps and thresholds, in the order of the passes. Depths are linear:
 * distance to the eye over that of the farthest place of the cloud, background 1. */
struct ImageSpaceSettings {
  // Projection (4.3.1)
  /** Leave out points that face away from the eye (back-face culling). It is faster,
   * and right for closed surfaces whose normals point outwards. Otherwise both sides
   * are lit, and discs of one side do not blend into the other. */
  bool cull_back_faces = false;
  /** Oriented discs where points lie farther apart than pixels; beyond the thesis. */
  bool footprints = true;
  /** Pixels, above 0: points whose disc has a smaller radius are single pixels, and
   * larger discs are blended into each other. Smaller numbers are smoother, larger ones
   * faster. With supersampling it counts the finer pixels: masks close no gaps between
   * rows of points, as lattices have, that are wider than a pixel. */
  double smallest_disc = 0.7;

  // Pixel filling (4.3.2): most iterations; fewer if nothing changes, 0 leaves it out
  int background_fill = 64;
  int occluded_fill = 3;
  /** Least distance between two layers of surface, as a depth. */
  double layer_distance = 1e-4;

  // Shading (4.3.1, after the fills) and smoothing (4.3.3)
  /** Off: the surface is white, as paper for lines. */
  bool shading = true;
  Material material;
  std::vector<Light> lights = defaultLights();
  /** Part of the light that walls around a position hide, in [0, 1]: pits and creases
   * are darker; 0 switches it off. Beyond the thesis. */
  double ambient_occlusion = 0.0;
  SmoothingFilter smoothing = SmoothingFilter::AlleviatedGaussian;
  /** In [0, 6]. */
  int smoothing_iterations = 1;

  // Illustrative rendering (4.3.5)
  bool silhouettes = false;
  /** Least value of the Laplace filter on depth (Table 4.2). */
  double silhouette_threshold = 0.02;
  /** Lines are 2 t - 1 pixels of the picture wide for the thickness t in [1, 7], with
   * supersampling as without. */
  int silhouette_thickness = 2;
  bool feature_lines = false;
  /** Least 1 - cos of the angle between the normals of a pixel and two of its
   * neighbours. */
  double feature_threshold = 0.06;
  Color line_color{0.0f, 0.0f, 0.0f};

  // Anti-aliasing (4.3.4), after the lines so that it smooths them as well; lines of
  // pictures with supersampling come later, and are smooth by that
  bool anti_aliasing = true;
  /** Least absolute value of the Laplace filter on depth: high for the border to the
   * background only, low for borders between layers of surface as well. */
  double anti_aliasing_threshold = 0.01;

  Background background;
};

struct Frame;

/** \brief Which planes of an image are filled in besides color. */
struct ImagePlanes {
  bool depth = false, normal = false, id = false;
};

/** \brief Carries out the passes. */
class PCL_UVOL_EXPORTS ImageSpaceBackend {
public:
  virtual ~ImageSpaceBackend() = default;

  /** \brief Name of the backend: "cpu (avx512)", or context, version and renderer of
   * GL. */
  virtual std::string
  describe() const = 0;

  /** \brief Draw a frame.
   * \param report gets the time of every pass and the counts "background_iterations"
   * and "occluded_iterations"
   * \param frame camera, points and settings
   * \param image gets the pixels */
  virtual void
  render(const Frame& frame, Image& image, Report& report) = 0;
};

} // namespace pcl_uvol
