// SPDX-License-Identifier: BSD-3-Clause
// -scale sx,sy,sz|auto: factors per axis of the space that distances are measured in.
#pragma once

#include <pcl_uvol/common/cloud_view.h>

#include <Eigen/Core>

#include <string>
#include <vector>

namespace uvol_tools {

/** \brief The value of the option, checked before any file is read. */
class ScaleOption {
public:
  /** \param text empty for factors of 1
   * \throws UsageError */
  explicit ScaleOption(const std::string& text);

  bool
  isAutomatic() const
  {
    return is_automatic_;
  }

  /** \brief The factors that were given, 1 if none were. */
  Eigen::Array3f
  getFactors() const
  {
    return Eigen::Array3d(factors_.data()).cast<float>();
  }

  /** \brief The factors for a cloud: with auto the one that makes the spacing equal
   * along all axes.
   */
  Eigen::Array3f
  resolveScale(const pcl_uvol::CloudView& cloud) const;

private:
  bool is_automatic_;
  std::vector<double> factors_;
};

} // namespace uvol_tools
