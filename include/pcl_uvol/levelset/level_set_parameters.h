// SPDX-License-Identifier: BSD-3-Clause
// The start of a level set, its evolution, and its summary.
#pragma once

#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/common/parameters.h>
#include <pcl_uvol/derivatives/gradient_estimation.h>
#include <pcl_uvol/isosurface/isosurface_extraction.h>
#include <pcl_uvol/neighbors/neighbor_graph.h>

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

namespace pcl_uvol {

/** \brief What the function at the start is. */
enum class InitialKind {
  Values, ///< f - f_iso, scaled to a distance by its slope (default)
  Field,  ///< another scalar field of the cloud, in units of length
  Sphere, ///< signed distances to shapes
  Box,
  Plane
};

/** \return The words for its values in JSON and options. */
constexpr std::array<EnumWord<InitialKind>, 5>
listWords(InitialKind)
{
  return {{{InitialKind::Values, "values"},
           {InitialKind::Field, "field"},
           {InitialKind::Sphere, "sphere"},
           {InitialKind::Box, "box"},
           {InitialKind::Plane, "plane"}}};
}

/** \brief The level-set function at the start: the scaled scalar field itself, a field
 * of the cloud, or the signed distance to a shape, positive inside where values are
 * higher inside (Outside::Lower), else negative. */
struct PCL_UVOL_EXPORTS InitialFunction {
  InitialKind kind = InitialKind::Values;
  std::string field_name; ///< of InitialKind::Field, see ScalarField
  /** Centre of a sphere, lowest corner of a box, a point of a plane. */
  Eigen::Array3d first{0.0, 0.0, 0.0};
  /** Highest corner of a box; normal of a plane to the outside, not 0. */
  Eigen::Array3d second{0.0, 0.0, 0.0};
  double radius = 0.0; ///< of a sphere, > 0

  /** \param radius > 0
   * \param center in the coordinates of the cloud
   * \throws InvalidArgument */
  static InitialFunction
  sphere(const Eigen::Vector3d& center, double radius);

  /** \param low, high opposite corners, low < high along every axis
   * \throws InvalidArgument */
  static InitialFunction
  box(const Eigen::Vector3d& low, const Eigen::Vector3d& high);

  /** \param normal to the outside, not 0
   * \param point any of the plane
   * \throws InvalidArgument */
  static InitialFunction
  plane(const Eigen::Vector3d& point, const Eigen::Vector3d& normal);

  /** \brief A scalar field of the cloud, in units of length; see ScalarField.
   * \param name of the field */
  static InitialFunction
  field(const std::string& name);

  /** \return Whether it is a shape in space, not made of values of the cloud. */
  bool
  isShape() const
  {
    return kind != InitialKind::Values && kind != InitialKind::Field;
  }

  /** \brief Distance of a place to the shape, positive inside.
   *
   * \param scale factors per axis: the distance in the stretched space; that to a
   * sphere is then one to first order, exact at its surface
   * \param x the place, in the coordinates of the cloud */
  double
  computeDistance(const Eigen::Vector3d& x,
                  const Eigen::Array3d& scale = Eigen::Array3d::Ones()) const;

  /** \throws InvalidArgument for an invalid shape */
  void
  check() const;

  /** \return The members under the names that JSON has for them. */
  static auto
  listMembers()
  {
    using Own = InitialFunction;
    return std::make_tuple(Member{"kind", &Own::kind},
                           Member{"field", &Own::field_name},
                           Member{"first", &Own::first},
                           Member{"second", &Own::second},
                           Member{"radius", &Own::radius});
  }
};

/** \brief The smoothing term of thesis (3.7). */
enum class CurvatureFlow {
  Mean,    ///< the mean curvature, which shrinks spheres (thesis)
  Relative ///< the mean curvature less its mean over the surroundings, in units of the
           ///< local spacing instead of the median one: smooths as much and keeps the
           ///< radius (default)
};

/** \return The words for its values in JSON and options. */
constexpr std::array<EnumWord<CurvatureFlow>, 2>
listWords(CurvatureFlow)
{
  return {{{CurvatureFlow::Mean, "mean"}, {CurvatureFlow::Relative, "relative"}}};
}

/** \brief What bounds the time step. */
enum class StepBound {
  Cfl,    ///< thesis 3.5.1, by the distance to the nearest neighbour
  Stencil ///< by the stencil's own weights: sharper on random samples (default)
};

/** \return The words for its values in JSON and options. */
constexpr std::array<EnumWord<StepBound>, 2>
listWords(StepBound)
{
  return {{{StepBound::Cfl, "cfl"}, {StepBound::Stencil, "stencil"}}};
}

/** \brief Whose step is taken. */
enum class Integration {
  Synchronous, ///< all samples take the smallest step that any of them allows
  Asynchronous ///< thesis 3.5.2: every sample takes its own, in classes of powers of
               ///< two; neighbours are interpolated linearly in time (default)
};

/** \return The words for its values in JSON and options. */
constexpr std::array<EnumWord<Integration>, 2>
listWords(Integration)
{
  return {{{Integration::Synchronous, "synchronous"},
           {Integration::Asynchronous, "asynchronous"}}};
}

/** \brief What makes the level-set function a distance again when its slope has left 1
 * by too much. */
enum class Reinitialization {
  None,
  Distance, ///< distance to the extracted isopoints (Rosenthal, Molchanov, Linsen
            ///< 2010; default)
  Eikonal,  ///< thesis 3.4, after Peng et al. 1999
  Diffusion ///< thesis 3.4, after Li et al. 2005: a term of the evolution itself; slow,
            ///< moves the surface, and is unstable where the slope is below 1
};

/** \return The words for its values in JSON and options. */
constexpr std::array<EnumWord<Reinitialization>, 4>
listWords(Reinitialization)
{
  return {{{Reinitialization::None, "none"},
           {Reinitialization::Distance, "distance"},
           {Reinitialization::Eikonal, "eikonal"},
           {Reinitialization::Diffusion, "diffusion"}}};
}

/** \brief One step of an evolution. Lengths are in units of the spacing, times in its
 * square; numbers are those of the samples within one spacing of the zero level. */
struct LevelSetStep {
  double time;      ///< after the step
  double change;    ///< root mean square of the motion of the zero level, per unit of
                    ///< time
  double min_slope; ///< of |grad phi|
  double max_slope;
  double slope_error; ///< mean of | |grad phi| - 1 |
  double energy;      ///< mean of mu (f - f_iso - phi)^2 / 2 + (1 - mu) |grad phi|
  bool reinitialized; ///< after it

  /** \return The members under the names that tables and Python have for them. */
  static auto
  listMembers()
  {
    using Own = LevelSetStep;
    return std::make_tuple(
        Member{"time", &Own::time},
        Member{"change",
               &Own::change,
               {"change of the zero level, spacings per unit of time"}},
        Member{"min_slope", &Own::min_slope},
        Member{"max_slope", &Own::max_slope},
        Member{"slope_error", &Own::slope_error, {"mean of | |grad phi| - 1 |"}},
        Member{"energy", &Own::energy, {"energy"}},
        Member{"reinitialized", &Own::reinitialized});
  }
};

/** \brief What an evolution found out. */
struct LevelSetSummary {
  double spacing = 0.0; ///< median spacing of the samples near the surface: the unit of
                        ///< length
  double noise = 0.0;   ///< standard deviation of f over its slope, in spacings, from
                        ///< residuals of local fits or from close pairs of samples
  bool logarithmic = false; ///< f_iso log(f / f_iso) replaced f - f_iso, because it is
                            ///< closer to quadratics: both have the same surface
  double mu = 0.0;          ///< as given, or the last one of those that were chosen
  /** False where an automatic mu found nothing to smooth and no outliers were replaced:
   * phi has the zero level of the field itself, after 0 steps. */
  bool smoothed = true;
  /** The zero level rests, or the steps of an automatic mu are done; never where it has
   * vanished. */
  bool converged = false;
  std::vector<LevelSetStep> steps;
};

/** \brief Called after every so many steps, with the results so far, and phi, in units
 * of length, by index of the input cloud. */
using SnapshotCallback =
    std::function<void(const LevelSetSummary& summary, const std::vector<float>& phi)>;

/** \brief Parameters of LevelSetEvolution. */
struct PCL_UVOL_EXPORTS LevelSetParameters {
  std::string field = "intensity"; ///< see ScalarField
  /** In units of the field; there is no default. */
  double isovalue = std::numeric_limits<double>::quiet_NaN();
  /** Weight of the data against smoothness, in [0, 1]: 1 follows the data, 0 only
   * smooths. Not set, from the values: smaller and smaller weights one after another,
   * as long as the expected deviation from the true surface falls. (Stein's unbiased
   * risk estimate gives its mean square.) Nothing is smoothed unless the mean square
   * falls by a quarter. Not set, from another start: the last of these weights. */
  std::optional<double> mu;
  FitScheme scheme = FitScheme::Quadratic;
  CurvatureFlow flow = CurvatureFlow::Relative;
  StepBound bound = StepBound::Stencil;
  Integration integration = Integration::Asynchronous;
  Reinitialization reinitialization = Reinitialization::Distance;
  InitialFunction initial;
  Outside outside = Outside::Lower; ///< of the shapes of initial
  /** Factors per axis, finite and positive: neighbours, curvature and phi belong to the
   * stretched space. */
  Eigen::Array3f scale{1.0f, 1.0f, 1.0f};
  /** Turns the axes that these factors belong to, see
   * InterpolationParameters::rotation. */
  Eigen::Array3d rotation{0.0, 0.0, 0.0};
  /** Nearest neighbours of a stencil: at least 3, with the quadratic scheme 9. */
  std::size_t k = 26;
  /** A run that ends there has a warning in its report. */
  std::size_t max_steps = 400;
  /** The evolution ends when the zero level moves by less, in spacings per unit of
   * time.
   */
  double tolerance = 0.002;
  /** Only samples so near to the zero level, in spacings, are advanced; the band
   * follows it (Rosenthal, Molchanov, Linsen 2010). At least 3; 0: all samples are. */
  double band_width = 5.0;

  /** \return The members under the names that JSON has for them. */
  static auto
  listMembers()
  {
    using Own = LevelSetParameters;
    constexpr double none = std::numeric_limits<double>::infinity();
    constexpr double above_zero = std::numeric_limits<double>::min();
    return std::make_tuple(
        Member{"field", &Own::field},
        Member{"isovalue", &Own::isovalue, {"isovalue (required)", -none, none, "iso"}},
        Member{
            "mu",
            &Own::mu,
            {"weight of the data against smoothness, 0 to 1; if it is chosen "
             "automatically, the surface is smoothed as far as its expected deviation "
             "falls (thesis 3.7)",
             0.0,
             1.0}},
        Member{"scheme",
               &Own::scheme,
               {"degree of the local fits that derivatives come from; linear is the "
                "thesis's and unstable on noise"}},
        Member{"flow",
               &Own::flow,
               {"smoothing flow: mean is the mean curvature of the thesis (3.7), which "
                "shrinks; relative is that less its local mean, which keeps radii"}},
        Member{
            "bound",
            &Own::bound,
            {"bound of time steps: cfl is the distance to the nearest neighbour, as in "
             "the thesis (3.5.1); stencil uses the weights of the neighbours"}},
        Member{"integration",
               &Own::integration,
               {"time steps: asynchronous uses one per sample "
                "(thesis 3.5.2), synchronous the smallest of all"}},
        Member{"reinitialization",
               &Own::reinitialization,
               {"method that restores phi to a distance (thesis 3.4): distance to the "
                "isopoints, the eikonal equation, or a diffusion term",
                -none,
                none,
                "reinit"}},
        Member{"initial", &Own::initial},
        Member{"outside",
               &Own::outside,
               {"with an initial shape: values outside of it are lower or higher"}},
        Member{"scale", &Own::scale},
        Member{"rotation", &Own::rotation},
        Member{"k",
               &Own::k,
               {"nearest neighbours of a fit; quadratic ones need 9", 3, 1000}},
        Member{"max_steps",
               &Own::max_steps,
               {"time steps at most; a run that ends there warns", 1, 1e6, "steps"}},
        Member{"tolerance",
               &Own::tolerance,
               {"end when the surface moves by less, in spacings per unit of time",
                above_zero,
                none}},
        Member{"band_width",
               &Own::band_width,
               {"advance only samples so many spacings from the surface, at least 3; "
                "0: all",
                0.0,
                none,
                "band"}});
  }

  /** \return All parameters as an object of JSON. */
  std::string
  toJson() const;

  /** \brief Parameters that the text does not name have their defaults.
   * \param text an object of JSON, as toJson() writes it
   * \throws InvalidArgument for an unknown name or a value of another type */
  static LevelSetParameters
  fromJson(const std::string& text);
};

/** \brief What an evolution leaves. */
struct LevelSet {
  std::vector<float> phi; ///< by input index, in units of length; NaN where a point has
                          ///< no coordinates or no value
  std::vector<float> deviations;      ///< by input index: see
                                      ///< LevelSetEvolution::getDeviations()
  std::vector<std::uint32_t> sources; ///< the points whose values the samples have: of
                                      ///< merged ones one
  LevelSetSummary summary;
  std::optional<SamplingSummary> sampling; ///< how the samples lie
  SurfaceTally tally;                      ///< see LevelSetEvolution::getTally()
};

} // namespace pcl_uvol
