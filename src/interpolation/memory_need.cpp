// SPDX-License-Identifier: BSD-3-Clause
#include "interpolation/memory_need.h"

#include "interpolation/field_model.h"
#include "interpolation/variogram.h"

#include <algorithm>
#include <cmath>

namespace pcl_uvol {

namespace {

using detail::QueryShape;

constexpr double index_bytes = sizeof(std::uint32_t), number_bytes = sizeof(double);

/** Spacings of samples within which fits are made on both sides of a query, buckets
 * that are reached at a corner included; samples that cluster about a plane add as many
 * (measured on even and clustered samples). */
constexpr double fit_reach = 16.0;

/** Samples whose fits are made. */
double
fittedSamples(double samples, QueryShape shape)
{
  const double side = std::cbrt(samples);
  const double about = shape == QueryShape::Space ? samples
                       : shape == QueryShape::Plane
                           ? 2.0 * fit_reach * side * side
                           : 4.0 * fit_reach * fit_reach * side;
  return std::min(samples, about);
}

/** What a model keeps of its samples besides their values. */
double
modelBytes(double samples, double fields, InterpolationModel model, QueryShape shape)
{
  const double fit_bytes = 50.0 + 168.0 * fields; // see BucketFits
  const double metric_bytes = index_bytes;        // see SampleMetrics
  switch (model) {
  case InterpolationModel::Fit:
    return fit_bytes * fittedSamples(samples, shape) + metric_bytes * samples;
  case InterpolationModel::Auto: // which makes fits all over the samples
    return (fit_bytes + metric_bytes) * samples;
  case InterpolationModel::Sph:
    return 4.0 * number_bytes * samples;
  default:
    return 0.0;
  }
}

/** Whether it kriges, if only where it has no better value. */
bool
usesVariogram(InterpolationModel model)
{
  return model == InterpolationModel::Kriging || model == InterpolationModel::Fit ||
         model == InterpolationModel::Auto;
}

} // namespace

double
interpolationBytes(double samples,
                   double fields,
                   const InterpolationParameters& parameters,
                   const detail::ExpectedQueries& expected)
{
  // Samples in leaf order with their values, which came by input index.
  constexpr double tree_bytes = 36.0, building_bytes = 16.0;
  const double in_order = (tree_bytes + number_bytes * fields) * samples;
  const double building = (building_bytes + number_bytes * fields) * samples;
  const double of_variogram =
      usesVariogram(parameters.model) ? detail::variogramBytes(samples) : 0.0;
  const double answering =
      modelBytes(samples, fields, parameters.model, expected.shape) +
      answerBytes(expected.count, fields, parameters);
  // Pairs of a variogram are given back in blocks that the heap keeps.
  return in_order + of_variogram + std::max(building, answering);
}

double
answerBytes(double queries, double fields, const InterpolationParameters& parameters)
{
  // Queries as they came and among the samples, their order and how it is found.
  const double of_query = 3.0 * number_bytes + sizeof(detail::Query) +
                          2.0 * index_bytes + 2.0 * number_bytes;
  const double numbers =
      1.0 + (parameters.errors ? 1.0 : 0.0) + (parameters.gradients ? 3.0 : 0.0);
  const double of_answer = number_bytes * numbers * fields + 1.0;
  return (of_query + of_answer) * queries;
}

} // namespace pcl_uvol
