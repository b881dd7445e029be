// SPDX-License-Identifier: BSD-3-Clause
// The first levels of the kd-tree over samples that no process holds all of: they part
// the samples into pieces, each of which becomes a subtree of its own.
#pragma once

#include "neighbors/ball.h"
#include "neighbors/kd_tree.h"
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/distributed/communicator.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace pcl_uvol {

/** \brief Axis of the splits at a depth. */
inline std::size_t
axisAt(const AxisCycle& axes, int depth)
{
  return static_cast<unsigned char>(axes[static_cast<std::size_t>(depth)]);
}

/** \brief A splitting plane that names its sample by position; of all positions those
 * up to that one lie below it. */
struct PlaneKey {
  float coordinate;
  Position below;
};

/** \brief A cell between such planes; infinite coordinates at the border of the domain.
 */
struct PCL_UVOL_EXPORTS CellKey {
  std::array<PlaneKey, 3> low, high;

  /** \brief The whole space. */
  static CellKey
  unbounded();

  /** \brief True if the closed cells share a point, see KdTree::touch. */
  bool
  touches(const CellKey& other) const;

  /** \brief True if the cell and a ball share a point; in a metric it may be true where
   * they only come near each other. */
  bool
  meets(const Ball& ball) const;

  /** \brief The balls that it meets. */
  std::vector<Ball>
  selectMeeting(const std::vector<Ball>& balls) const;

  /** \brief True if a ball lies in the inside of the cell. */
  bool
  contains(const Ball& ball) const;
};

/** \brief The positions of a process's samples. Threads read them at the same time. */
struct PositionSource {
  std::uint64_t count = 0;
  /** \brief Positions from begin on, at most 2^14 of them.
   * \param buffer of as many, where they may be put
   * \return where they are */
  std::function<const Position*(
      std::uint64_t begin, std::size_t count, Position* buffer)>
      read;
};

class MedianSearch;

/** \brief The top of the kd-tree of thesis 2.2.1, exactly as over all samples at once,
 * if these are distinct. */
class PCL_UVOL_EXPORTS Decomposition {
public:
  static constexpr int most_levels = 20;

  /** \brief Find the medians of all nodes of the first levels, level by level, by
   * sampled selection (Floyd and Rivest 1975): one pass over the samples and one more
   * for each level, or two where a median lies elsewhere than expected; one in all for
   * up to 512 samples. Each process gets up to 32 MB of positions per pass, or 4 KiB
   * per piece where that is more.
   * \param positions finite, none of them -0
   * \param levels 0 to 20: 2^levels pieces
   * \throws InvalidArgument unless there are as many samples as pieces */
  Decomposition(const PositionSource& positions,
                int levels,
                Communicator& communicator,
                unsigned threads);

  /** \brief The tree below a piece of another decomposition, as a whole of its own: by
   * the processes that together have all samples of that piece, in whatever parts.
   * \param positions of this process
   * \param levels below the piece */
  Decomposition(const Decomposition& top,
                std::size_t piece,
                const PositionSource& positions,
                int levels,
                Communicator& communicator,
                unsigned threads);

  /** \brief The whole tree, which all processes get from those that found a part.
   * \param top that all have
   * \param subtree below one of its pieces
   * \param reports for one process of each piece's, in the order of the pieces */
  Decomposition(const Decomposition& top,
                const Decomposition& subtree,
                bool reports,
                Communicator& communicator);

  /** \brief The same with more levels, which trees over the pieces have found.
   * \param levels at least those of the top; they may be more than most_levels
   * \param plane_of a node of a piece's tree; no two samples coincide */
  Decomposition(
      const Decomposition& top,
      int levels,
      const std::function<PlaneKey(std::size_t piece, std::size_t node)>& plane_of);

  /** \brief Pieces: they are numbered from left to right. */
  std::size_t
  size() const
  {
    return std::size_t(1) << levels_;
  }

  int
  getLevels() const
  {
    return levels_;
  }

  const AxisCycle&
  getAxes() const
  {
    return axes_;
  }

  /** \brief Samples of all processes. */
  std::uint64_t
  getSampleCount() const
  {
    return begins_.back();
  }

  /** \brief The first sample of a piece in leaf order, and how many it has; equal
   * samples are counted each, and all of them lie in one piece. @{ */
  std::uint64_t
  getBegin(std::size_t piece) const
  {
    return begins_[piece];
  }
  std::uint64_t
  getCount(std::size_t piece) const
  {
    return getBegin(piece + 1) - getBegin(piece);
  }
  /** @} */

  CellKey
  getCell(std::size_t piece) const;

  /** \brief The piece that a sample belongs to, or in whose cell another point lies. */
  std::size_t
  findPiece(const Position& position) const;

  /** \brief Call found for each piece whose cell meets some balls, with these,
   * ascending. */
  void
  findPieces(const std::vector<Ball>& balls,
             const std::function<void(std::size_t piece, const std::vector<Ball>&)>&
                 found) const;

private:
  /** Check the number of levels, and make room for their planes. */
  explicit Decomposition(int levels);

  void
  findPlanes(MedianSearch& search);

  int levels_;
  AxisCycle axes_{};                  // from the root on
  std::vector<std::uint64_t> begins_; // by piece, and the end
  std::vector<PlaneKey> planes_;      // by node number
};

} // namespace pcl_uvol
