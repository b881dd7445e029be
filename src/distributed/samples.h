// SPDX-License-Identifier: BSD-3-Clause
// Samples as plain arrays: what processes send to each other and what waits on disk.
#pragma once

#include "common/scalar_field.h"
#include "common/value_frame.h"
#include "neighbors/length_unit.h"
#include "neighbors/sample_set.h"
#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/common/stage.h>
#include <pcl_uvol/distributed/communicator.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl_uvol {

/** \brief Samples that belong to others. */
struct SampleSpan {
  const Position* positions;
  const float* values;
  const std::uint64_t* sources;
  std::size_t size;
};

/** \brief Samples as plain arrays, in leaf order once they are part of a piece. */
struct PCL_UVOL_EXPORTS Samples {
  std::vector<Position> positions; ///< finite; once normalised, none of them -0
  std::vector<float> values;       ///< finite
  std::vector<std::uint64_t>
      sources; ///< where each comes from: an index of the caller's

  std::size_t
  size() const
  {
    return positions.size();
  }

  void
  push(const Position& position, float value, std::uint64_t source)
  {
    positions.push_back(position);
    values.push_back(value);
    sources.push_back(source);
  }

  void
  reserve(std::size_t count);

  void
  resize(std::size_t count);

  /** \brief Consecutive samples. */
  SampleSpan
  span(std::size_t begin, std::size_t count) const
  {
    return {
        positions.data() + begin, values.data() + begin, sources.data() + begin, count};
  }

  void
  append(const SampleSpan& others);

  /** \brief Bring positions as they were read into a unit.
   * \return what is left out */
  FarPoints
  normalize(const LengthUnit& unit);
};

/** \brief Where float holds the values of the clouds of all processes well: what
 * samples and an extraction from them need. */
PCL_UVOL_EXPORTS ValueFrame
findValueFrame(const CloudView& cloud,
               const ScalarField& field,
               Communicator& communicator,
               unsigned threads);

/** \brief The samples of a cloud that have a value and a position, as it is in the
 * cloud.
 * \param frame of the values
 * \param first_source source of point 0; point i has i more
 * \param report gets the counts "no_value" and "non_finite" and the time of "scalar" */
PCL_UVOL_EXPORTS Samples
readSamples(const CloudView& cloud,
            const ScalarField& field,
            const ValueFrame& frame,
            std::uint64_t first_source,
            unsigned threads,
            Report& report);

/** \brief Bring the samples of all processes into one unit.
 * \param scale factors by which positions are stretched
 * \param report gets the count "far_points" of this process and one warning of all */
PCL_UVOL_EXPORTS LengthUnit
normalizeTogether(Samples& samples,
                  const Position& scale,
                  Communicator& communicator,
                  unsigned threads,
                  Report& report);

/** \brief Samples that coincided. */
struct MergedSamples {
  std::uint64_t duplicates = 0;  ///< that were left out
  std::uint64_t conflicting = 0; ///< of places where values differed
};

/** \brief Leave one of samples that coincide, with the median of their values; see
 * findRepresentative, for which members are in order of their sources.
 * \param samples come out sorted */
PCL_UVOL_EXPORTS MergedSamples
mergeDuplicates(Samples& samples, unsigned threads);

} // namespace pcl_uvol
