// SPDX-License-Identifier: BSD-3-Clause
// How samples lie around each other: all around, in sheets, along lines, or alone; and
// how far apart they are along these and across.
#pragma once

#include "neighbors/local_metric.h"
#include "neighbors/nearest_finder.h"
#include "neighbors/sample_set.h"
#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/common/stage.h>
#include <pcl_uvol/neighbors/neighbor_graph.h>

#include <Eigen/Core>
#include <pcl/types.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace pcl_uvol {

/** \brief The sampling around a sample. Lengths are those of the stretched input. */
struct LocalSampling {
  LocalDimension dimension;
  float along;  ///< spacing in the line, the sheet or the volume
  float across; ///< to the next line or sheet; in a volume the widest spacing; infinite
                ///< where nothing lies beside
};

/** \brief The sampling of one sample after another; one object per thread. */
class SamplingFinder {
public:
  /** \param samples must outlive the finder */
  explicit SamplingFinder(const SampleSet& samples);

  LocalSampling
  find(std::uint32_t sample);

private:
  bool
  isAlone(std::uint32_t sample, double& nearest);

  const SampleSet& samples_;
  LocalMetricFinder metrics_;
  NearestFinder nearest_, around_;
};

/** \brief Describes the sampling around all samples, in leaf order.
 * \param progress told of "sampling"; empty: nobody is told */
PCL_UVOL_EXPORTS std::vector<LocalSampling>
diagnoseSampling(const SampleSet& samples,
                 unsigned threads,
                 const ProgressCallback& progress = nullptr);

/** \brief Look at some samples in all parts of the cloud: at 1024 of more.
 * Deterministic, and good to 3 %. */
PCL_UVOL_EXPORTS SamplingSummary
summarizeSampling(const SampleSet& samples, unsigned threads);

/** \brief What summarizeSampling() looks at, for samples that are a part of a cloud,
 * consecutive in its leaf order: the same samples of all parts together, but each sees
 * no neighbours beyond its part.
 * \param begin samples of the cloud before this part
 * \param total samples of the cloud */
std::vector<LocalSampling>
lookAtSome(const SampleSet& samples,
           std::uint64_t begin,
           std::uint64_t total,
           unsigned threads);

/** \brief What they say together.
 * \param found at least one */
SamplingSummary
summarizeSampling(const std::vector<LocalSampling>& found);

/** \brief A summary of samples whose unit they did not know, with lengths of the
 * stretched input. */
inline SamplingSummary
toInput(SamplingSummary summary, const LengthUnit& unit)
{
  summary.along = static_cast<float>(unit.toInput(summary.along));
  summary.across = static_cast<float>(unit.toInput(summary.across));
  return summary;
}

/** \brief The same where there is no tree over the samples: it is built, and given
 * back.
 * \param field that samples have a finite value of
 * \param scale,rotation as those of InterpolationParameters
 * \throws InvalidArgument if no sample has one */
PCL_UVOL_EXPORTS SamplingSummary
summarizeSampling(const CloudView& cloud,
                  const pcl::Indices& indices,
                  const std::string& field,
                  const Eigen::Array3f& scale,
                  const Eigen::Array3d& rotation,
                  unsigned threads);

} // namespace pcl_uvol
