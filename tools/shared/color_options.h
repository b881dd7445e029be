// SPDX-License-Identifier: BSD-3-Clause
// How pictures colour values: map, range and logarithm.
#pragma once

#include "render/color_scale.h"
#include "render/point_colors.h"
#include "shared/options.h"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace uvol_tools {

/** \brief -colormap, -range, -log and -label. */
class ColorOptions {
public:
  void
  declare(Options& options);

  /** \brief All but -label, where nothing is written beside the colours. */
  void
  declareMapping(Options& options);

  /** \brief What must parse, and fit together.
   * \throws UsageError */
  void
  check() const;

  /** \brief The map that is asked for, else that of continuous values. */
  pcl_uvol::ColorMap
  getMap() const;

  /** \brief How the values of a field of a cloud are coloured: unasked, a few whole
   * numbers as categories. */
  pcl_uvol::ColorMapping
  mapFor(const pcl_uvol::CloudView& cloud, const std::string& field) const;

  /** \brief Values at the ends of the colours; none: those of the field. */
  std::optional<std::array<double, 2>>
  getRange() const;

  /** \brief True if nothing says how values become colours. */
  bool
  isAutomatic() const
  {
    return map_ == "auto" && !is_logarithmic_ && range_.empty();
  }

  bool
  isLogarithmic() const
  {
    return is_logarithmic_;
  }

  /** \brief What the values of a field are called. */
  const std::string&
  getLabel(const std::string& field) const
  {
    return label_.empty() ? field : label_;
  }

private:
  std::string map_ = "auto", label_;
  std::vector<double> range_;
  bool is_logarithmic_ = false;
};

} // namespace uvol_tools
