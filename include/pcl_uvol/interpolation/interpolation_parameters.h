// SPDX-License-Identifier: BSD-3-Clause
// How the field between the samples is modelled.
#pragma once

#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/common/parameters.h>

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <limits>
#include <string>
#include <tuple>
#include <vector>

namespace pcl_uvol {

/** \brief What a field is taken to be between its samples. */
enum class InterpolationModel {
  /** Cubic or quadratic least-squares fits around every sample, blended by smooth
   * compact weights (Renka 1988, whose fits are quadratic): continuously
   * differentiable, exact for cubics (default). */
  Fit,
  /** The value of the nearest sample. */
  Nearest,
  /** The mean of the k nearest samples, weighted by a power of their inverse distance
   * (Shepard 1968): passes through the samples, flat there. */
  Shepard,
  /** Sibson's natural-neighbour coordinates (1981): passes through the samples, smooth
   * between them, exact for linear functions; no values outside of their convex hull.
   */
  Sibson,
  /** Laplace's natural-neighbour coordinates (Belikov et al. 1997): the same with bends
   * where neighbours change; cheaper without gradients, which are made by differences.
   */
  Laplace,
  /** Kriging in moving neighbourhoods, ordinary or with a trend: the best linear
   * unbiased estimate for fields as rough as the variogram says, with its standard
   * deviation. */
  Kriging,
  /** Sums of smoothing kernels over particles with their own smoothing lengths and
   * masses. */
  Sph,
  /** The most accurate of these models on held-out samples, see chooseModel. */
  Auto
};

/** \return The words for its values in JSON and options. */
constexpr std::array<EnumWord<InterpolationModel>, 9>
listWords(InterpolationModel)
{
  return {{{InterpolationModel::Fit, "fit"},
           {InterpolationModel::Nearest, "nearest"},
           {InterpolationModel::Shepard, "shepard"},
           {InterpolationModel::Sibson, "natural"},
           {InterpolationModel::Laplace, "laplace"},
           {InterpolationModel::Kriging, "kriging"},
           {InterpolationModel::Sph, "sph"},
           {InterpolationModel::Auto, "auto"},
           {InterpolationModel::Sibson, "sibson"}}};
}

/** \brief How values that are h apart are correlated, with the range a. */
enum class VariogramKind {
  Spherical,   ///< 1 - 1.5 h / a + 0.5 (h / a)^3, 0 beyond a (default)
  Exponential, ///< exp(-h / a)
  Gaussian,    ///< exp(-(h / a)^2): very smooth fields
  Matern32,    ///< smoothness 3/2: differentiable once
  Matern52     ///< smoothness 5/2: differentiable twice
};

/** \return The words for its values in JSON and options. */
constexpr std::array<EnumWord<VariogramKind>, 6>
listWords(VariogramKind)
{
  return {{{VariogramKind::Spherical, "spherical"},
           {VariogramKind::Exponential, "exponential"},
           {VariogramKind::Gaussian, "gaussian"},
           {VariogramKind::Matern32, "matern32"},
           {VariogramKind::Matern52, "matern52"},
           {VariogramKind::Matern32, "matern"}}};
}

/** \brief Parameters of InterpolationModel::Kriging. */
struct PCL_UVOL_EXPORTS KrigingParameters {
  VariogramKind variogram = VariogramKind::Spherical;
  /** Nugget and partial sill (the sill without the nugget) in squared units of the
   * field, >= 0, and range in units of length, > 0; NaN (default): fitted to the
   * samples, for every field. @{ */
  double nugget = std::numeric_limits<double>::quiet_NaN();
  double psill = std::numeric_limits<double>::quiet_NaN();
  double range = std::numeric_limits<double>::quiet_NaN();
  /** @} */
  /** Ranges along the axes of the anisotropy by that of the variogram, > 0. */
  Eigen::Array3f ratios{1.0f, 1.0f, 1.0f};
  /** Angles in degrees that turn the axes of the coordinates into those of the
   * anisotropy: about z, then about the new x, then about the new z. */
  Eigen::Array3f rotation{0.0f, 0.0f, 0.0f};
  /** Samples of a neighbourhood: the nearest by the ellipsoid of the anisotropy, all
   * where there are fewer; 1 to 512. */
  std::size_t k = 32;
  /** Take an eighth of them from each octant, of four times as many nearest ones. */
  bool octants = false;
  /** Degree of the polynomial that the mean is: 0 (ordinary kriging), 1 or 2. */
  int trend = 0;
  /** Sides of the block about each query whose mean is estimated, along the axes of the
   * coordinates, >= 0: block kriging. Zeros (default): the value at the query. */
  Eigen::Array3f block{0.0f, 0.0f, 0.0f};

  /** \return The members under the names that JSON has for them. */
  static auto
  listMembers()
  {
    using Own = KrigingParameters;
    return std::make_tuple(Member{"variogram", &Own::variogram},
                           Member{"nugget", &Own::nugget},
                           Member{"psill", &Own::psill},
                           Member{"range", &Own::range},
                           Member{"ratios", &Own::ratios},
                           Member{"rotation", &Own::rotation},
                           Member{"k", &Own::k},
                           Member{"octants", &Own::octants},
                           Member{"trend", &Own::trend},
                           Member{"block", &Own::block});
  }
};

/** \brief Parameters of InterpolationModel::Shepard. */
struct PCL_UVOL_EXPORTS ShepardParameters {
  /** Nearest samples, all where there are fewer; at least 1. */
  std::size_t k = 16;
  /** The power of the inverse distance; greater than 0. */
  double power = 3.0;

  /** \return The members under the names that JSON has for them. */
  static auto
  listMembers()
  {
    using Own = ShepardParameters;
    return std::make_tuple(Member{"k", &Own::k}, Member{"power", &Own::power});
  }
};

/** \brief Kernels of smoothed particles; of r / h, see Price (2012) and Dehnen and Aly
 * (2012). */
enum class SphKernel {
  CubicSpline, ///< M4, ends at 2 h (default)
  Quartic,     ///< M5, ends at 2.5 h
  Quintic,     ///< M6, ends at 3 h
  WendlandC2,  ///< ends at 2 h, as the other two
  WendlandC4,
  WendlandC6
};

/** \return The words for its values in JSON and options. */
constexpr std::array<EnumWord<SphKernel>, 6>
listWords(SphKernel)
{
  return {{{SphKernel::CubicSpline, "cubic"},
           {SphKernel::Quartic, "quartic"},
           {SphKernel::Quintic, "quintic"},
           {SphKernel::WendlandC2, "wendland2"},
           {SphKernel::WendlandC4, "wendland4"},
           {SphKernel::WendlandC6, "wendland6"}}};
}

/** \brief Parameters of InterpolationModel::Sph. */
struct PCL_UVOL_EXPORTS SphParameters {
  SphKernel kernel = SphKernel::CubicSpline;
  /** Divide by the same sum of ones, so that constants are exact. */
  bool normalized = true;
  /** Field of the smoothing lengths h, in units of length. Where it is empty, and for
   * particles without a positive value, the kernel ends at the k-th nearest neighbour.
   */
  std::string length_field;
  /** Field of the masses; empty: all are equal. */
  std::string mass_field;
  /** Field of the densities; empty: from positions and masses. */
  std::string density_field;
  /** See length_field; at least 1. */
  std::size_t k = 48;

  /** \return The members under the names that JSON has for them. */
  static auto
  listMembers()
  {
    using Own = SphParameters;
    return std::make_tuple(Member{"kernel", &Own::kernel},
                           Member{"normalized", &Own::normalized},
                           Member{"length_field", &Own::length_field},
                           Member{"mass_field", &Own::mass_field},
                           Member{"density_field", &Own::density_field},
                           Member{"k", &Own::k});
  }
};

/** \brief Parameters of FieldInterpolation. */
struct PCL_UVOL_EXPORTS InterpolationParameters {
  /** Fields to interpolate, see ScalarField; empty: the one of
   * ScalarField::defaultName.
   */
  std::vector<std::string> fields;
  InterpolationModel model = InterpolationModel::Fit;
  /** Give values outside of the data as well; false: NaN there. */
  bool extrapolate = false;
  /** Compute gradients, and standard errors, beside the values. @{ */
  bool gradients = true;
  bool errors = true;
  /** @} */
  /** Factors per axis, finite and positive: distances are measured in the stretched
   * space, queries and gradients belong to the original one. */
  Eigen::Array3f scale{1.0f, 1.0f, 1.0f};
  /** Strike, dip and plunge in degrees of the axes that these factors belong to: x is
   * east, y north. The second axis is a line in a plane: the plane goes down, by the
   * dip of 0 to 90, to the right of its strike, which is clockwise from y; the line
   * plunges by no more than the dip. The first axis lies in the plane, the third one is
   * its normal. 0, 0, 0 (default): x, y and z. */
  Eigen::Array3d rotation{0.0, 0.0, 0.0};
  ShepardParameters shepard;
  KrigingParameters kriging;
  SphParameters sph;

  /** \return The members under the names that JSON has for them. */
  static auto
  listMembers()
  {
    using Own = InterpolationParameters;
    return std::make_tuple(Member{"fields", &Own::fields},
                           Member{"model", &Own::model},
                           Member{"extrapolate", &Own::extrapolate},
                           Member{"gradients", &Own::gradients},
                           Member{"errors", &Own::errors},
                           Member{"scale", &Own::scale},
                           Member{"rotation", &Own::rotation},
                           Member{"shepard", &Own::shepard},
                           Member{"kriging", &Own::kriging},
                           Member{"sph", &Own::sph});
  }

  /** \return All parameters as an object of JSON. */
  std::string
  toJson() const;

  /** \brief Parameters that the text does not name have their defaults.
   * \param text an object of JSON, as toJson() writes it
   * \throws InvalidArgument for an unknown name or a value of another type */
  static InterpolationParameters
  fromJson(const std::string& text);
};

/** \throws InvalidArgument for a parameter out of its range
 * \param parameters to be checked before samples are there */
PCL_UVOL_EXPORTS void
checkParameters(const InterpolationParameters& parameters);

} // namespace pcl_uvol
