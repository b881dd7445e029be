// SPDX-License-Identifier: BSD-3-Clause
// How the field between the samples is modelled.
#pragma once

#include <pcl_uvol/common/export.h>
#include <pcl_uvol/common/parameters.h>

#include <Eigen/Core>

#include <array>
#include <cstddef>
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
  Laplace
};

constexpr std::array<EnumWord<InterpolationModel>, 6>
listWords(InterpolationModel)
{
  return {{{InterpolationModel::Fit, "fit"},
           {InterpolationModel::Nearest, "nearest"},
           {InterpolationModel::Shepard, "shepard"},
           {InterpolationModel::Sibson, "natural"},
           {InterpolationModel::Laplace, "laplace"},
           {InterpolationModel::Sibson, "sibson"}}};
}

/** \brief Parameters of InterpolationModel::Shepard. */
struct PCL_UVOL_EXPORTS ShepardParameters {
  /** Nearest samples, all where there are fewer; at least 1. */
  std::size_t k = 16;
  /** Of the inverse distance; greater than 0. */
  double power = 3.0;

  static auto
  listMembers()
  {
    using Own = ShepardParameters;
    return std::make_tuple(Member{"k", &Own::k}, Member{"power", &Own::power});
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
  ShepardParameters shepard;

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
                           Member{"shepard", &Own::shepard});
  }

  std::string
  toJson() const;

  /** \brief Parameters that the text does not name have their defaults.
   * \throws InvalidArgument for an unknown name or a value of another type */
  static InterpolationParameters
  fromJson(const std::string& text);
};

/** \throws InvalidArgument for a parameter out of its range */
PCL_UVOL_EXPORTS void
checkParameters(const InterpolationParameters& parameters);

} // namespace pcl_uvol
