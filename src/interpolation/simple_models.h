// SPDX-License-Identifier: BSD-3-Clause
// What people know: the nearest sample's value, and inverse distances.
#pragma once

#include "interpolation/field_model.h"
#include <pcl_uvol/interpolation/interpolation_parameters.h>

namespace pcl_uvol::detail {

/** \brief The value of the nearest sample; of equally far ones that of lower index. */
class NearestModel : public FieldModel {
public:
  explicit NearestModel(const SampledFields& sampled);

  void
  evaluate(const Query* queries,
           std::size_t count,
           const Estimates& estimates) const override;

private:
  const SampledFields& sampled_;
  std::vector<Position> sparse_;
};

/** \brief Inverse distances of the k nearest samples. The standard error is the
 * weighted standard deviation of their values. */
class ShepardModel : public FieldModel {
public:
  ShepardModel(const SampledFields& sampled, const ShepardParameters& parameters);

  void
  evaluate(const Query* queries,
           std::size_t count,
           const Estimates& estimates) const override;

private:
  const SampledFields& sampled_;
  ShepardParameters parameters_;
  std::vector<Position> sparse_;
};

} // namespace pcl_uvol::detail
