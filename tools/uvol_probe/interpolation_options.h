// SPDX-License-Identifier: BSD-3-Clause
// The model of a field between its samples, on the command line.
#pragma once

#include "shared/options.h"
#include "shared/scale_option.h"
#include <pcl_uvol/common/dataset.h>
#include <pcl_uvol/interpolation/cross_validation.h>
#include <pcl_uvol/interpolation/interpolation_parameters.h>

#include <cstdint>
#include <string>
#include <vector>

namespace uvol_tools {

/** \brief -field, -model and what belongs to single models, and -validate. */
class InterpolationOptions {
public:
  void
  declare(Options& options);

  /** \brief Take over what was given: to be called before any file is read.
   * \throws UsageError for what does not go together, InvalidArgument for numbers out
   * of range */
  void
  finish(const Options& options);

  /** \brief The parameters for samples, with fields and scale. Expressions become
   * fields of the samples, see addDerivedField.
   * \param facts tell how a scale was found
   * \throws InvalidArgument for a field that is not there, or no expression */
  pcl_uvol::InterpolationParameters
  resolve(const Options& options,
          pcl_uvol::Dataset& samples,
          pcl_uvol::Report& report,
          Facts& facts) const;

  /** \brief After finish(), without fields and scale. */
  const pcl_uvol::InterpolationParameters&
  getParameters() const
  {
    return parameters_;
  }

  bool
  hasValidation() const
  {
    return folds_ > 0;
  }

  /** \brief See pcl_uvol::chooseModel: by the folds of -validate-by, if blocks or a
   * field make these. */
  pcl_uvol::ModelChoice
  chooseModel(const pcl_uvol::Dataset& samples,
              const pcl::Indices& indices,
              const pcl_uvol::InterpolationParameters& parameters,
              unsigned threads,
              pcl_uvol::Report& report) const;

  /** \brief Compare values measured with those from other samples: facts of every
   * field. */
  Facts
  validate(const pcl_uvol::Dataset& samples,
           const pcl::Indices& indices,
           const pcl_uvol::InterpolationParameters& parameters,
           unsigned threads,
           pcl_uvol::Report& report) const;

private:
  void
  checkModel(const Options& options) const;

  void
  parseVariogram();

  pcl_uvol::Folds
  makeFolds(const pcl_uvol::Dataset& samples, unsigned threads) const;

  pcl_uvol::InterpolationParameters parameters_;
  ScaleOption scale_;
  std::string fields_, variogram_, validate_by_ = "random";
  std::vector<double> block_;
  std::uint64_t k_ = 0, folds_ = 0;
};

/** \brief Facts of an automatic choice: the models and how far each was off. */
Facts
describe(const pcl_uvol::ModelChoice& choice);

} // namespace uvol_tools
