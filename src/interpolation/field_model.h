// SPDX-License-Identifier: BSD-3-Clause
// What the models of a field between its samples have in common: they see samples and
// values in frames of their own, and answer queries block by block.
#pragma once

#include "neighbors/query.h"
#include "neighbors/sample_set.h"
#include <pcl_uvol/interpolation/field_interpolation.h>

#include <cstddef>
#include <memory>
#include <vector>

namespace pcl_uvol::detail {

struct FittedVariogram;

/** \brief Samples and the fields there. */
struct SampledFields {
  SampleSet::ConstPtr samples;
  std::size_t fields = 0;
  std::vector<double> values; ///< [sample][field], in the field's frame

  const double*
  valuesOf(std::size_t sample) const
  {
    return &values[sample * fields];
  }
};

/** \brief Where the answers to a block of queries go; they are NaN before. */
struct Estimates {
  double* values;    ///< [query][field]
  double* gradients; ///< [query][field][axis], or null
  double* errors;    ///< [query][field], or null
  FieldSupport* support;
  bool extrapolate = true; ///< false: answers outside of the data are not needed
};

/** \brief A model of fields between samples. What it answers to a query depends on that
 * query alone. */
class FieldModel {
public:
  FieldModel() = default;
  FieldModel(const FieldModel&) = delete;
  FieldModel&
  operator=(const FieldModel&) = delete;
  virtual ~FieldModel() = default;

  /** \brief Answer queries that are close to one another, best in spatial order. Any
   * number of threads may ask at once. */
  virtual void
  evaluate(const Query* queries,
           std::size_t count,
           const Estimates& estimates) const = 0;

  /** \brief The variogram of a field, in the space of the samples and in the field's
   * frame; null where the model has none. */
  virtual const FittedVariogram*
  findVariogram(std::size_t) const
  {
    return nullptr;
  }

  /** \brief Add what the user should know of all answers so far. */
  virtual void
  addTo(Report&) const
  {
  }
};

} // namespace pcl_uvol::detail
