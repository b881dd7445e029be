// SPDX-License-Identifier: BSD-3-Clause
// Where float holds the values of a field well: relative to a reference that is
// subtracted in double, and times a power of two.
#pragma once

#include "common/number_range.h"
#include "common/scalar_field.h"
#include "common/sketch.h"
#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/common/export.h>

#include <cmath>

namespace pcl_uvol {

/** \brief From values of a field to those that stages compute with. */
struct ValueFrame {
  double reference = 0.0; ///< 0 where float holds the values as they are
  double factor = 1.0; ///< a power of two; 1 where float holds the values as they are

  double
  apply(double value) const
  {
    return (value - reference) * factor;
  }

  double
  toInput(double value) const
  {
    return value / factor + reference;
  }

  bool
  operator==(const ValueFrame& other) const
  {
    return reference == other.reference && factor == other.factor;
  }
};

/** \brief Takes values one after another and tells the frame of them all: the same for
 * any order and division of them. */
class PCL_UVOL_EXPORTS ValueRange {
public:
  /** \brief Take a value; one that is not finite counts for nothing. */
  void
  add(double value)
  {
    if (!std::isfinite(value))
      return;
    range_.add(value);
    sketch_.add({value});
  }

  /** \brief Take what another range has taken. */
  void
  add(const ValueRange& other)
  {
    range_.add(other.range_);
    sketch_.add(other.sketch_);
  }

  /** \brief The reference is 0 where float holds every value to 1e-7 of their range;
   * the factor is 1 where values and their squares are in the range of float. A few
   * values far from the others, such as those that stand for none, have no say. */
  ValueFrame
  findFrame() const;

private:
  NumberRange range_;
  Sketch<1> sketch_;
};

/** \brief The range of a field of all points of a cloud. */
PCL_UVOL_EXPORTS ValueRange
findValueRange(const CloudView& cloud, const ScalarField& field, unsigned threads);

} // namespace pcl_uvol
