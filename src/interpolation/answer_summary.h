// SPDX-License-Identifier: BSD-3-Clause
// What all answers of a run are like, and what the user should know of them.
#pragma once

#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/common/stage.h>
#include <pcl_uvol/interpolation/field_interpolation.h>

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace pcl_uvol::detail {

/** \brief Takes answers one block after another. */
class PCL_UVOL_EXPORTS AnswerSummary {
public:
  /** \brief The values of a field. */
  struct Field {
    std::string name;
    double spread = 0.0;   ///< standard deviation of the samples' values
    std::size_t count = 0; ///< finite values
    double low = 0.0, high = 0.0;
    std::size_t uncertain = 0; ///< values of a standard error above the spread
    double sample_low = 0.0, sample_high = 0.0; ///< range of the samples' values
    std::size_t exceeding = 0; ///< values farther beyond that range than it is wide
  };

  /** \param fields expressions, see ScalarField
   * \param indices of the samples */
  AnswerSummary(const CloudView& cloud,
                const pcl::Indices& indices,
                const std::vector<std::string>& fields);

  void
  add(const InterpolatedFields& answers);

  const std::vector<Field>&
  getFields() const
  {
    return fields_;
  }

  /** \brief One warning where most of the queries lie outside of the data, most of the
   * values rest on little, or most errors are as large as the field varies; and one
   * where values lie far beyond those of the samples. */
  void
  warn(Report& report) const;

private:
  void
  warnOfSupport(Report& report) const;

  /** Answers of a kind. */
  std::size_t
  count(FieldSupport kind) const
  {
    return supports_[static_cast<std::size_t>(kind)];
  }

  std::vector<Field> fields_;
  std::size_t queries_ = 0;
  std::array<std::size_t, 8> supports_{}; ///< by FieldSupport
};

} // namespace pcl_uvol::detail
