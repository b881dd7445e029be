// SPDX-License-Identifier: BSD-3-Clause
// How much light the viewer's isovalues let through.
#pragma once

#include <pcl/PCLPointCloud2.h>

#include <cstddef>
#include <vector>

namespace uvol_tools {

/** \brief Opacities in [0, 1] of isovalues that come and go: those of the options, and
 * in steps those of all isovalues but the innermost. */
class OpacityChoice {
public:
  /** \param opacities of the isovalues, the lowest first; isovalues beyond them have
   * the last one. None: all are opaque */
  explicit OpacityChoice(std::vector<double> opacities);

  /** \brief Take the next step, and start over at the end.
   * \return the opacity around the innermost isovalue; negative: those of the options
   */
  double
  next();

  /** \brief The opacities of the isovalues that a surface has, as
   * ImageSpaceRendererBase::setOpacities() takes them; none: all are opaque.
   * \param isovalues that were asked for, of which some may have no points; none: those
   * of the surface */
  std::vector<double>
  find(const pcl::PCLPointCloud2& surface, std::vector<double> isovalues) const;

private:
  std::vector<double> given_;
  std::size_t step_ = 0;
};

} // namespace uvol_tools
