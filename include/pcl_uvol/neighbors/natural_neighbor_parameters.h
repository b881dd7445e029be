// SPDX-License-Identifier: BSD-3-Clause
// How natural neighbours are approximated.
#pragma once

#include <pcl_uvol/common/export.h>
#include <pcl_uvol/common/parameters.h>

#include <array>
#include <cstdint>
#include <string>
#include <tuple>

namespace pcl_uvol {

/** \brief Where candidates for neighbours come from. */
enum class NeighborSource {
  KdTree,  ///< touching cells of the kd-tree (thesis 2.2), about 11 of them (default)
  Voronoi, ///< adjacent regions of a discrete Voronoi diagram (2.1)
  Exact    ///< faces of the exact Voronoi cells, which both approximate: about 15.5 of
           ///< random samples; some 25 microseconds each
};

/** \return The words for its values in JSON and options. */
constexpr std::array<EnumWord<NeighborSource>, 3>
listWords(NeighborSource)
{
  return {{{NeighborSource::KdTree, "kdtree"},
           {NeighborSource::Voronoi, "voronoi"},
           {NeighborSource::Exact, "exact"}}};
}

/** \brief Which closer candidates can remove a farther one; Table 2.4 leaves it open.
 */
enum class AngleCriterion {
  Kept, ///< only those kept so far: about 5.1 neighbours, more isopoints (default)
  All,  ///< also those that were removed: about 4.7 neighbours, shorter edges
  None  ///< none can: all candidates are neighbours
};

/** \return The words for its values in JSON and options. */
constexpr std::array<EnumWord<AngleCriterion>, 3>
listWords(AngleCriterion)
{
  return {{{AngleCriterion::Kept, "kept"},
           {AngleCriterion::All, "all"},
           {AngleCriterion::None, "none"}}};
}

/** \brief Parameters of NaturalNeighbors. */
struct PCL_UVOL_EXPORTS NaturalNeighborParameters {
  NeighborSource source = NeighborSource::KdTree;
  /** Cells of the diagram along the longest side; 0: 4 samples to a cell. */
  std::uint32_t voronoi_cells = 0;
  AngleCriterion criterion = AngleCriterion::Kept;

  /** \return The members under the names that JSON has for them. */
  static auto
  listMembers()
  {
    using Own = NaturalNeighborParameters;
    return std::make_tuple(Member{"source", &Own::source},
                           Member{"voronoi_cells", &Own::voronoi_cells},
                           Member{"criterion", &Own::criterion});
  }

  /** \return All parameters as an object of JSON. */
  std::string
  toJson() const;

  /** \brief Parameters that the text does not name have their defaults.
   * \param text an object of JSON, as toJson() writes it
   * \throws InvalidArgument for an unknown name or a value of another type */
  static NaturalNeighborParameters
  fromJson(const std::string& text);
};

} // namespace pcl_uvol
