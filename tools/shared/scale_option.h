// SPDX-License-Identifier: BSD-3-Clause
// -scale and -rotate: the space that distances are measured in.
#pragma once

#include "common/stretch_axes.h"
#include "shared/facts.h"
#include "shared/options.h"
#include <pcl_uvol/common/stage.h>
#include <pcl_uvol/interpolation/cross_validation.h>

#include <optional>
#include <string>

namespace uvol_tools {

/** \brief What a tool can find a scale from. */
enum class AutomaticScale {
  None,    ///< nothing: not all samples are seen at once
  Spacing, ///< where the samples lie: auto is spacing
  Field    ///< how fast a field changes
};

/** \brief Both options. */
class ScaleOption {
public:
  /** \param purpose of distances, as in "distances" or "spacings"
   * \param automatic None leaves out -rotate as well */
  void
  declare(Options& options, const std::string& purpose, AutomaticScale automatic);

  /** \brief Check what was given, before any file is read.
   * \throws UsageError */
  void
  finish(const Options& options);

  bool
  isGiven() const
  {
    return is_given_;
  }

  /** \brief Whether the scale is found from a field, or from the samples alone. @{ */
  bool
  isFromField() const
  {
    return is_from_field_;
  }
  bool
  isFromSpacing() const
  {
    return is_from_spacing_;
  }
  /** @} */

  /** \brief What was given: factors of 1 where they have to be found. */
  const pcl_uvol::detail::Stretch&
  getStretch() const
  {
    return stretch_;
  }

  /** \brief The stretch that does not depend on a field: as it was given, or by the
   * spacing of samples. */
  pcl_uvol::detail::Stretch
  findStretch(const pcl_uvol::CloudView& cloud) const;

  /** \brief The stretch for some samples.
   * \param field of them; none is asked for unless isFromField()
   * \param facts tell of a scale that is given, and how it was found */
  pcl_uvol::detail::Stretch
  resolve(const pcl_uvol::CloudView& cloud,
          const std::string& field,
          unsigned threads,
          pcl_uvol::Report& report,
          Facts& facts) const;

  /** \brief For a report: nothing unless a scale was given.
   * \param taken has the scale and the rotation
   * \param choice how factors were found from a field */
  template <typename Parameters>
  Facts
  describe(const Parameters& taken,
           const std::optional<pcl_uvol::ScaleChoice>& choice) const;

private:
  AutomaticScale automatic_ = AutomaticScale::None;
  std::string scale_;
  std::vector<double> angles_;
  bool is_given_ = false, is_from_field_ = false, is_from_spacing_ = false;
  pcl_uvol::detail::Stretch stretch_;
};

/** \brief The factors along the axes, these where they are turned, and how factors were
 * found from a field, if they were. */
Facts
describe(const pcl_uvol::detail::Stretch& stretch,
         const std::optional<pcl_uvol::ScaleChoice>& choice = std::nullopt);

template <typename Parameters>
Facts
ScaleOption::describe(const Parameters& taken,
                      const std::optional<pcl_uvol::ScaleChoice>& choice) const
{
  return is_given_ ? uvol_tools::describe({taken.scale, taken.rotation}, choice)
                   : Facts();
}

} // namespace uvol_tools
