// SPDX-License-Identifier: BSD-3-Clause
// Triangles that share an edge and lie in one direction of it.
#pragma once

#include <pcl_uvol/common/dataset.h>

#include <Eigen/Core>

#include <cstdint>
#include <utility>
#include <vector>

namespace pcl_uvol::detail {

/** \brief All edges of a mesh, and around each its triangles in order of their angles:
 * in a broken mesh these may be many, and to look at all pairs would take hours. */
class EdgeFans {
public:
  /** \param triangles with areas; they and the places must outlive this */
  EdgeFans(const std::vector<Eigen::Vector3d>& places,
           const std::vector<Triangle>& triangles);

  /** \brief The triangles with a number above the given one that share an edge with it
   * and may lie on it: all that do, and of two at an edge the other one.
   * \param found gets them behind what it holds */
  void
  findFolded(std::uint32_t triangle, std::vector<std::uint32_t>& found) const;

private:
  /** A triangle at an edge. */
  struct Side {
    std::pair<std::uint32_t, std::uint32_t> edge; ///< vertices, the lower one first
    std::uint32_t half_edge;
  };

  const Eigen::Vector3d&
  tipOf(const Side& side) const;

  /** Find those in one direction among the sides of one edge. */
  void
  findRuns(std::size_t begin, std::size_t end);

  const std::vector<Eigen::Vector3d>& places_;
  const std::vector<Triangle>& triangles_;
  std::vector<Side> sides_;
  std::vector<std::pair<std::size_t, std::size_t>> run_of_; // of sides, by half edge
};

} // namespace pcl_uvol::detail
