// SPDX-License-Identifier: BSD-3-Clause
// A box as a camera sees it: its edges, and the pixels of places on them.
#pragma once

#include "charts/perspective.h"

#include <Eigen/Geometry>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace uvol_tools {

/** \brief A box and what its axes say. */
struct DataBox {
  Eigen::AlignedBox3d box;                           ///< as the camera sees it
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< added to its coordinates, ...
  Eigen::Vector3d factors = Eigen::Vector3d::Ones(); ///< ... which are then divided
  std::string unit;                                  ///< of the data; "": none

  double
  valueAt(int axis, double coordinate) const
  {
    return (coordinate + origin[axis]) / factors[axis];
  }

  /** \brief The coordinate of a value, within the box. */
  double
  coordinateOf(int axis, double value) const;

  /** \brief Round values of an axis within the box. */
  std::vector<double>
  listRoundValues(int axis) const;

  bool
  hasLength(int axis) const
  {
    return box.max()[axis] > box.min()[axis];
  }
};

/** \brief An edge of a box: along an axis, at ends of the two others. */
struct BoxEdge {
  int axis;
  std::array<bool, 2> at_high; ///< of the axes that follow, in cyclic order
};

/** \brief A box before a camera; both are kept by the caller. */
class SeenBox {
public:
  SeenBox(const Perspective& perspective, const DataBox& data)
      : perspective_(perspective)
      , data_(data)
      , box_(data.box)
  {
  }

  /** \brief Edges that so many faces share which look towards the eye. */
  std::vector<BoxEdge>
  edges(int facing) const;

  /** \brief The edge that values of an axis stand at: of those at the outline the one
   * that is lowest in the picture, or farthest to the left for an axis that stands
   * upright; none if the outline has no edge before the eye. */
  std::optional<BoxEdge>
  findTickEdge(int axis) const;

  /** \brief True if a face is seen from outside. */
  bool
  facesEye(int axis, bool high) const;

  /** \brief The coordinate of a face. */
  double
  endOf(int axis, bool high) const
  {
    return high ? box_.max()[axis] : box_.min()[axis];
  }

  Eigen::Vector3d
  placeOn(const BoxEdge& edge, double coordinate) const;

  /** \brief The pixels of the lower end of an edge, and of the upper one. */
  std::array<Pixel, 2>
  endsOf(const BoxEdge& edge) const;

  Pixel
  pixelAt(const Eigen::Vector3d& place) const
  {
    return perspective_.pixelOf(perspective_.seenFromEye(place));
  }

  /** \brief What is nearer to the eye is not drawn. */
  double
  nearest() const;

  /** \brief Away from the box, across an edge with these ends. */
  Pixel
  outwards(const std::array<Pixel, 2>& ends) const;

  const DataBox&
  getData() const
  {
    return data_;
  }

  const Perspective&
  getPerspective() const
  {
    return perspective_;
  }

private:
  bool
  isInFront(const BoxEdge& edge) const;

  const Perspective& perspective_;
  const DataBox& data_;
  const Eigen::AlignedBox3d& box_;
};

} // namespace uvol_tools
