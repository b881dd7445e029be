// SPDX-License-Identifier: BSD-3-Clause
// Which figures of surfaces are hardly known, and what is said of them.
#pragma once

#include "mesh/curved_triangle.h"
#include <pcl_uvol/common/stage.h>
#include <pcl_uvol/mesh/surface_measures.h>

#include <cstddef>

namespace pcl_uvol::detail {

/** \brief Whether area and volume of a piece are known no better than to their own
 * size: vertices may be off by as much as the piece is large. */
bool
isUncertain(const PieceMeasures& piece);

/** \brief Whether a piece is in one plane, as far as float can hold. */
bool
isFlat(const SurfaceIntegrals& integrals, const PieceMeasures& piece);

/** \brief The uncertain pieces of a surface. */
struct UncertainPieces {
  std::size_t pieces = 0;    ///< of the surface
  std::size_t uncertain = 0; ///< that are, of isovalues with others
  std::size_t kept = 0;      ///< that are, where nothing else would be left
  Measure area{0.0, 0.0};    ///< of the uncertain ones together
  bool are_left_out = false;
};

/** \brief The vertices between lines of samples or next to gaps. Those on caps do not
 * count. */
struct WeakVertices {
  std::size_t weak = 0, all = 0;

  void
  add(bool is_weak)
  {
    weak += is_weak;
    ++all;
  }

  bool
  areMost() const
  {
    return 2 * weak > all;
  }
};

/** \brief Warn if most vertices are weak. */
void
warnOfWeak(const WeakVertices& vertices, Report& report);

/** \brief Warn of uncertain pieces. */
void
warnOfUncertain(const UncertainPieces& found, Report& report);

/** \brief Warn of surfaces that are open, flat or inverted, and of large errors. */
void
warnOfMeasures(const SurfaceFigures& figures, Report& report);

} // namespace pcl_uvol::detail
