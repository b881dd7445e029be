// SPDX-License-Identifier: BSD-3-Clause
// The edges that isopoints come from, with the places and values of their samples.
#pragma once

#include "common/scalar_field.h"
#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/isosurface/isosurface_extraction.h>

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <utility>

namespace pcl_uvol {

/** \brief The length of an edge in the stretched space. */
inline double
stretchedLength(const CloudView& samples,
                const IsoEdge& edge,
                const Eigen::Array3f& scale)
{
  const Eigen::Map<const Eigen::Array3f> a(samples.xyz(edge.first)),
      b(samples.xyz(edge.second));
  return ((b - a) * scale).matrix().cast<double>().norm();
}

/** \brief Edges of isopoints in the stretched space. */
class StretchedEdges {
public:
  StretchedEdges(const CloudView& samples,
                 const IsoEdges& edges,
                 const IsosurfaceParameters& parameters)
      : samples_(samples)
      , edges_(edges)
      , field_(samples.fields, parameters.field)
      , scale_(parameters.scale.cast<double>())
      , is_lower_outside_(parameters.outside == Outside::Lower)
  {
  }

  /** \brief The values at its ends, in the order of the edge. */
  std::pair<double, double>
  readValues(std::size_t i) const
  {
    return {field_.read(samples_.point(edges_[i].first)),
            field_.read(samples_.point(edges_[i].second))};
  }

  /** \brief The unit vector along an edge that points to the outside. */
  Eigen::Vector3d
  findOutside(std::size_t i) const
  {
    const auto [a, b, t] = edges_[i];
    const Eigen::Vector3d along =
        (placeOf(b) - placeOf(a)).cwiseProduct(scale_.matrix());
    return (isOuterEndSecond(i) ? along : Eigen::Vector3d(-along)).normalized();
  }

  /** \brief Its linear root, in the original space. */
  Eigen::Vector3d
  findRoot(std::size_t i) const
  {
    const auto [a, b, t] = edges_[i];
    return placeOf(a) + static_cast<double>(t) * (placeOf(b) - placeOf(a));
  }

  /** \brief The samples at its ends, the inner one first. */
  std::pair<Eigen::Vector3d, Eigen::Vector3d>
  findEnds(std::size_t i) const
  {
    const auto [a, b, t] = edges_[i];
    return isOuterEndSecond(i) ? std::pair(placeOf(a), placeOf(b))
                               : std::pair(placeOf(b), placeOf(a));
  }

  /** \brief A covector of the stretched space in the original one. */
  Eigen::Vector3f
  carryBack(const Eigen::Vector3d& covector) const
  {
    return covector.cwiseProduct(scale_.matrix()).normalized().cast<float>();
  }

private:
  bool
  isOuterEndSecond(std::size_t i) const
  {
    const auto [first, second] = readValues(i);
    return (second < first) == is_lower_outside_;
  }

  Eigen::Vector3d
  placeOf(std::uint32_t sample) const
  {
    return Eigen::Map<const Eigen::Vector3f>(samples_.xyz(sample)).cast<double>();
  }

  const CloudView& samples_;
  const IsoEdges& edges_;
  ScalarField field_;
  Eigen::Array3d scale_;
  bool is_lower_outside_;
};

} // namespace pcl_uvol
