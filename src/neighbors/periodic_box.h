// SPDX-License-Identifier: BSD-3-Clause
// Boxes that repeat in space: samples in them, and images of those near their faces, so
// that whoever looks for neighbours finds them across the faces.
#pragma once

#include "neighbors/kd_tree.h"
#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/common/dataset.h>
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/common/stage.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace pcl_uvol {

/** \brief A box that repeats along some axes, in coordinates relative to a dataset's
 * origin. */
struct PCL_UVOL_EXPORTS PeriodicBox {
  std::array<double, 3> low{};
  std::array<double, 3> sides{}; ///< 0: it does not repeat along that axis

  /** \brief The coordinate of the image that lies in the box, counted from low; that
   * on the high face is the one on the low face. Not periodic, or not finite: the
   * coordinate itself, counted from low. */
  double
  toBox(double coordinate, std::size_t axis) const;

  /** \brief The same of a place. */
  std::array<double, 3>
  toBox(const std::array<double, 3>& place) const;

  /** \brief True for a place, counted from low, within the box. */
  bool
  holds(const float* place) const;
};

/** \brief Whether a box repeats along an axis at all. */
inline bool
isPeriodic(const std::array<double, 3>& sides)
{
  return sides[0] > 0.0 || sides[1] > 0.0 || sides[2] > 0.0;
}

/** \throws InvalidArgument for sides that are negative or not finite */
PCL_UVOL_EXPORTS void
checkPeriodic(const std::array<double, 3>& sides);

/** \brief Warn where the file of samples names a box, and nobody asks for one. */
PCL_UVOL_EXPORTS void
warnOfUnusedBox(const Dataset& samples,
                const std::array<double, 3>& sides,
                Report& report);

/** \brief The smallest box around samples, by those coordinates that are finite. */
struct PCL_UVOL_EXPORTS SampleExtents {
  std::array<double, 3> low{{infinity, infinity, infinity}};
  std::array<double, 3> high{{-infinity, -infinity, -infinity}};

  /** \param xyz three coordinates */
  void
  add(const float* xyz);

  void
  add(const SampleExtents& other);

  /** \brief Their length along an axis; 0 where there are none. */
  double
  getLength(std::size_t axis) const
  {
    return high[axis] > low[axis] ? high[axis] - low[axis] : 0.0;
  }

private:
  static constexpr double infinity = std::numeric_limits<double>::infinity();
};

PCL_UVOL_EXPORTS SampleExtents
findExtents(const CloudView& cloud);

/** \brief Where the box lies that samples come in: its low corner at 0, or at minus
 * half of its sides, or at the lowest sample, the first of these that holds them all;
 * else at 0, for samples that have left it.
 *
 * \param report gets the count "moved_into_box" of samples outside, and a warning where
 * samples fill much less than the box
 *
 * \throws InvalidArgument as checkPeriodic() */
PCL_UVOL_EXPORTS PeriodicBox
findPeriodicBox(const Dataset& samples,
                const std::array<double, 3>& sides,
                Report& report);

/** \brief The same for samples of which these are a part.
 *
 * \param extents of all of them
 *
 * \param report gets the count of this part, and the warning of all */
PCL_UVOL_EXPORTS PeriodicBox
findPeriodicBox(const Dataset& part,
                const SampleExtents& extents,
                const std::array<double, 3>& sides,
                Report& report);

/** \brief The same box with its faces in the widest gaps between the coordinates of
 * samples: where that is depends on the samples alone, not on where a box was put
 * around them, see findWidestGap(). */
PCL_UVOL_EXPORTS PeriodicBox
cutAtWidestGap(const Dataset& samples, const PeriodicBox& box, unsigned threads);

/** \brief How far beyond the faces images reach. */
struct PeriodicReach {
  /** Spacings of samples that fill the box evenly: the 64 nearest, which fits look at,
   * fill a ball of 2.5; a mesh ends in caps where the images end, and a level set knows
   * less of the field there. @{ */
  static constexpr double of_fits = 3.0;
  static constexpr double of_meshes = 5.0;
  static constexpr double of_level_sets = 8.0;
  /** @} */

  /** Factors per axis of the space that distances are measured in. */
  Position scale{{1.0f, 1.0f, 1.0f}};
  /** The number of nearest samples that every sample in the box has. */
  std::size_t neighbors = 64;
  /** At least so many of these spacings. */
  double spacings = of_fits;
  /** At least so far, in units of length of the stretched space. */
  double least = 0.0;
};

/** \brief Samples with images. */
struct PCL_UVOL_EXPORTS PeriodicSamples {
  /** Coordinates count from the low corner of the box; the samples come first, moved
   * into the box, in their order, the images follow. */
  Dataset samples;
  std::vector<std::uint32_t> image_of; ///< the sample of each image
  PeriodicBox box;
  double reach = 0.0; ///< of images beyond the faces, in the stretched space

  /** \brief The number of samples that are no images. */
  std::size_t
  countOwn() const
  {
    return samples.cloud.width - image_of.size();
  }

  /** \brief The sample that a point is or is an image of. */
  std::uint32_t
  sourceOf(std::uint32_t point) const
  {
    return point < countOwn() ? point : image_of[point - countOwn()];
  }
};

/** \brief Add images of samples.
 *
 * The reach begins with some spacings and grows until all neighbours that are asked for
 * are there, to a whole box at most.
 *
 * \param use samples that get images, and whose neighbours count
 *
 * \param report gets the time and progress of "images"
 *
 * \throws InvalidArgument as SampleSet::build */
PCL_UVOL_EXPORTS PeriodicSamples
addPeriodicImages(const Dataset& samples,
                  const std::vector<std::uint32_t>& use,
                  const PeriodicBox& box,
                  const PeriodicReach& reach,
                  unsigned threads,
                  Report& report);

/** \brief The same for all samples. */
PCL_UVOL_EXPORTS PeriodicSamples
addPeriodicImages(const Dataset& samples,
                  const PeriodicBox& box,
                  const PeriodicReach& reach,
                  unsigned threads,
                  Report& report);

/** \brief The samples that came in, at their own places, with the fields that have been
 * added since. */
PCL_UVOL_EXPORTS Dataset
dropPeriodicImages(PeriodicSamples&& images, const Dataset& samples);

} // namespace pcl_uvol
