// SPDX-License-Identifier: BSD-3-Clause
// Ordinary and universal kriging in moving neighbourhoods (Chiles and Delfiner,
// Geostatistics, chapter 3): the best linear unbiased estimate, with its deviation.
#pragma once

#include "common/value_frame.h"
#include "interpolation/field_model.h"
#include "interpolation/kriging_system.h"
#include "interpolation/variogram.h"

#include <string>
#include <vector>

namespace pcl_uvol::detail {

/** \brief Kriging of every field by a variogram of its own.
 *
 * A nugget is taken as noise of the samples: estimates are those of the field without
 * it, and continuous; the standard deviation is that of another sample, with the
 * nugget, as in gstat. Memory: nothing per sample. */
class KrigingModel : public FieldModel {
public:
  /** \param frames of the fields
   * \param names of the fields, for messages
   * \param turn from offsets of the input to the axes of the samples */
  KrigingModel(const SampledFields& sampled,
               const KrigingParameters& parameters,
               const Eigen::Matrix3d& turn,
               const std::vector<ValueFrame>& frames,
               const std::vector<std::string>& names);

  void
  evaluate(const Query* queries,
           std::size_t count,
           const Estimates& estimates) const override;

  void
  addTo(Report& report) const override;

  /** \brief After the metric. */
  const FittedVariogram*
  findVariogram(std::size_t field) const override
  {
    return &variograms_[field];
  }

private:
  const SampledFields& sampled_;
  KrigingParameters parameters_;
  Eigen::Matrix3d metric_;
  std::vector<FittedVariogram> variograms_;
  std::vector<KrigingTarget> targets_; ///< of each field
  std::vector<std::string> constant_;  ///< names of fields that are
  std::vector<Message> total_sills_;   ///< given as partial ones, as it seems
  std::vector<Position> sparse_;
};

} // namespace pcl_uvol::detail
