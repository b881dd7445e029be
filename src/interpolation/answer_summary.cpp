// SPDX-License-Identifier: BSD-3-Clause
#include "interpolation/answer_summary.h"

#include "common/scalar_field.h"

#include <algorithm>
#include <cmath>

namespace pcl_uvol::detail {

namespace {

/** Range and standard deviation of the finite values. */
void
describeSamples(const CloudView& cloud,
                const pcl::Indices& indices,
                AnswerSummary::Field& described)
{
  const ScalarField field(cloud.fields, described.name);
  double count = 0.0, mean = 0.0, squares = 0.0;
  for (const int index : indices) {
    const double value = field.read(cloud.point(static_cast<std::size_t>(index)));
    if (!std::isfinite(value))
      continue;
    described.sample_low = count > 0.0 ? std::min(described.sample_low, value) : value;
    described.sample_high =
        count > 0.0 ? std::max(described.sample_high, value) : value;
    // Welford (1962)
    count += 1.0;
    const double off = value - mean;
    mean += off / count;
    squares += off * (value - mean);
  }
  described.spread = count > 0.0 ? std::sqrt(squares / count) : 0.0;
}

} // namespace

AnswerSummary::AnswerSummary(const CloudView& cloud,
                             const pcl::Indices& indices,
                             const std::vector<std::string>& fields)
{
  for (const std::string& name : fields) {
    Field field;
    field.name = name;
    describeSamples(cloud, indices, field);
    fields_.push_back(field);
  }
}

void
AnswerSummary::add(const InterpolatedFields& answers)
{
  queries_ += answers.size;
  for (const FieldSupport kind : answers.support)
    ++supports_[static_cast<std::size_t>(kind)];
  for (std::size_t f = 0; f < fields_.size(); ++f) {
    Field& field = fields_[f];
    const double extent = field.sample_high - field.sample_low;
    for (std::size_t i = 0; i < answers.size; ++i) {
      const double value = answers.getValue(f, i);
      if (!std::isfinite(value))
        continue;
      field.low = field.count == 0 ? value : std::min(field.low, value);
      field.high = field.count == 0 ? value : std::max(field.high, value);
      ++field.count;
      field.exceeding +=
          value < field.sample_low - extent || value > field.sample_high + extent;
      field.uncertain +=
          !answers.errors.empty() && answers.getError(f, i) > field.spread;
    }
  }
}

void
AnswerSummary::warn(Report& report) const
{
  warnOfSupport(report);
  for (const Field& field : fields_)
    if (field.exceeding > 0)
      report.warn("overshoots",
                  {{"exceeding", field.exceeding},
                   {"values", field.count},
                   {"field", field.name}});
}

void
AnswerSummary::warnOfSupport(Report& report) const
{
  const std::size_t outside = count(FieldSupport::Outside),
                    invalid = count(FieldSupport::Invalid);
  if (2 * invalid > queries_) {
    report.warn("invalid_queries", {{"invalid", invalid}, {"queries", queries_}});
    return;
  }
  if (2 * outside > queries_) {
    const bool has_values =
        std::any_of(fields_.begin(), fields_.end(), [&](const Field& field) {
          return field.count > queries_ - outside;
        });
    report.warn(
        "queries_outside",
        {{"outside", outside}, {"queries", queries_}, {"has_values", has_values}});
    return;
  }
  const std::size_t weak = count(FieldSupport::Bridged) + count(FieldSupport::Rim) +
                           count(FieldSupport::Reduced);
  if (2 * weak > queries_ - outside) {
    report.warn("weak_support", {{"weak", weak}, {"queries", queries_}});
    return;
  }
  for (const Field& field : fields_)
    if (2 * field.uncertain > field.count)
      report.warn("uncertain_values",
                  {{"uncertain", field.uncertain},
                   {"values", field.count},
                   {"field", field.name}});
}

} // namespace pcl_uvol::detail
