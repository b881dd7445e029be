// SPDX-License-Identifier: BSD-3-Clause
// Accuracy of a model on held-out samples: folds of samples, and the
// errors of fields interpolated from the others.
#pragma once

#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/common/stage.h>
#include <pcl_uvol/interpolation/interpolation_parameters.h>

#include <pcl/types.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace pcl_uvol {

/** \brief A division of points into folds that are left out one after the other. It
 * depends on the points alone. */
class PCL_UVOL_EXPORTS Folds {
public:
  /** \brief Every point at random. Good for evenly spread samples; where samples follow
   * one another closely, as along a track, each held-out sample has a neighbour that is
   * not held out.
   * \param count of points
   * \param folds 2 to count
   * \throws InvalidArgument for folds out of range */
  static Folds
  byRandom(std::size_t count, std::size_t folds);

  /** \brief Compact blocks of space, eight to a fold. Points without a place are in the
   * first fold.
   * \param cloud the samples
   * \param folds how many, from 2 to the number of points
   * \param threads 0: all cores
   * \throws InvalidArgument for folds out of range, and as SampleSet::build */
  static Folds
  byBlocks(const CloudView& cloud, std::size_t folds, unsigned threads);

  /** \brief Points of the same value stay together: those of a drill hole, a dive, a
   * flight. Points without a value are in the first fold.
   * \param cloud the samples
   * \param field whose equal values stay together
   * \param folds how many, from 2 to the number of values
   * \throws InvalidArgument for an unknown field and one of fewer values than folds */
  static Folds
  byField(const CloudView& cloud, const std::string& field, std::size_t folds);

  /** \brief Number of folds. */
  std::size_t
  size() const
  {
    return folds_;
  }

  /** \brief Fold of a point.
   * \param point index in the cloud */
  std::size_t
  operator[](std::size_t point) const
  {
    return fold_of_[point];
  }

private:
  Folds(std::size_t folds, std::vector<std::uint32_t> fold_of);

  std::size_t folds_;
  std::vector<std::uint32_t> fold_of_;
};

/** \brief How well a field was interpolated at held-out samples. */
struct FieldScore {
  std::string field;
  std::size_t tested = 0;  ///< points with a value
  std::size_t covered = 0; ///< of these, those that got one: the others lie outside
  double rms = 0.0;        ///< root mean squared error, in units of the field
  double bias = 0.0;       ///< mean error: interpolated less measured
  double share = 0.0;      ///< proportion of errors within the estimated error;
                           ///< NaN if the model does not estimate errors
};

/** \brief Interpolate at the points of each fold from those of the others.
 * \param indices points to take part
 * \param most points of a fold that are tested: random ones; 0: all
 * \param report gets warnings of the model
 * \param cloud the samples
 * \param parameters of the model, with its fields
 * \param folds of the points of the cloud
 * \param threads 0: all cores
 * \return one per field
 * \throws InvalidArgument as FieldInterpolation::interpolate, and
 * for folds that leave no samples */
PCL_UVOL_EXPORTS std::vector<FieldScore>
crossValidate(const CloudView& cloud,
              const pcl::Indices& indices,
              const InterpolationParameters& parameters,
              const Folds& folds,
              std::size_t most,
              unsigned threads,
              Report& report);

/** \brief Error of a model at held-out samples. */
struct ModelScore {
  InterpolationModel model;
  /** Root mean squared error by the standard deviation of the measured values; over
   * several fields the root mean square of these. */
  double error = 0.0;
};

/** \brief How models compare. */
struct ModelChoice {
  std::vector<ModelScore> scores; ///< the best model first
  std::size_t tested = 0;         ///< samples that all of them were tested at
};

/** \brief Compare models by cross-validation, on a sample of folds: 3 of 10, 2000
 * points each. Folds are random. If most samples are on lines or sheets, folds are
 * blocks, because neighbours on the same line would make every model look good.
 *
 * The models are fit, natural, kriging, shepard and nearest, and sph where the
 * parameters name a field of particles. They are compared where all of them have a
 * value. A model without values at half of the points is left out, and so is one that
 * these samples do not allow.
 *
 * \param parameters of the models; which model they name does not matter
 *
 * \param report gets a warning for fewer than 10 samples, too few to choose: fit
 *
 * \param cloud the samples
 * \param indices points to take part
 * \param threads 0: all cores
 * \throws InvalidArgument as FieldInterpolation::interpolate */
PCL_UVOL_EXPORTS ModelChoice
chooseModel(const CloudView& cloud,
            const pcl::Indices& indices,
            const InterpolationParameters& parameters,
            unsigned threads,
            Report& report);

/** \brief The same on given folds, such as drill holes: 3 of them.
 *
 * \param cloud the samples
 * \param indices points to take part
 * \param parameters of the models
 * \param folds of the points of the cloud
 * \param threads 0: all cores
 * \param report as above
 * \throws InvalidArgument as FieldInterpolation::interpolate */
PCL_UVOL_EXPORTS ModelChoice
chooseModel(const CloudView& cloud,
            const pcl::Indices& indices,
            const InterpolationParameters& parameters,
            const Folds& folds,
            unsigned threads,
            Report& report);

/** \brief Factors along three axes that make a field change alike along all of them. */
struct ScaleChoice {
  Eigen::Array3f scale{1.0f, 1.0f, 1.0f}; ///< to take; the least of them is 1
  /** Shares of the variance of differences, of their logarithm over classes of pairs,
   * that distance explains: in the space stretched by the factors that explain most,
   * and in the original one. @{ */
  double explained = 0.0, explained_before = 0.0;
  /** @} */
  /** Mean error at held-out samples, divided by that with factors of 1. It is the mean
   * of the roots of absolute errors, so that a few large errors do not decide. */
  double error_ratio = 1.0;
  std::size_t tested = 0; ///< held-out samples
};

/** \brief Find the scale of a field from its samples.
 *
 * Pairs of samples of all parts of the cloud show how the difference of two values
 * grows with the distance along each axis: a variogram in every direction. The factors
 * are those with which these variograms become the same function of the stretched
 * distance.
 *
 * These factors, and some between them and 1, are then tested on held-out samples. With
 * each of these, all samples nearer than the width of the gaps are held out. Factors of
 * 1 are used unless others lower the error by at least a tenth, and by more than chance
 * explains. So factors stay 1 if the field changes equally fast along all axes, if
 * samples are dense, noisy or few. Takes the time of a tree.
 *
 * \param cloud the samples
 * \param indices points to take part
 * \param field see ScalarField
 * \param rotation of the axes, see InterpolationParameters::rotation
 * \param threads 0: all cores; the choice does not depend on it
 * \param report gets the time of "scale"
 * \throws InvalidArgument for an unknown field, and for one without a finite value */
PCL_UVOL_EXPORTS ScaleChoice
chooseScale(const CloudView& cloud,
            const pcl::Indices& indices,
            const std::string& field,
            const Eigen::Array3d& rotation,
            unsigned threads,
            Report& report);

} // namespace pcl_uvol
