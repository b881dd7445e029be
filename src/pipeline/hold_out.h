// SPDX-License-Identifier: BSD-3-Clause
// The hold-out test of an isosurface: samples are left out, the surface is extracted
// from the others, and asked on which side of it each of them lies.
#pragma once

#include "pipeline/pipeline_input.h"
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/interpolation/cross_validation.h>
#include <pcl_uvol/pipeline/isosurface_pipeline_parameters.h>
#include <pcl_uvol/pipeline/isosurface_result.h>

#include <pcl/types.h>

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace pcl_uvol {

/** \brief What is said of a sample that was left out. Above: at the isovalue or higher.
 */
struct HeldOutSample {
  std::uint32_t point;   ///< index in the input
  bool is_above;         ///< as it was measured
  bool is_nearest_above; ///< the nearest sample that remained
  bool is_field_above;   ///< the field interpolated from those that remained; where it
                         ///< has no value, the nearest sample
  bool is_side_above;    ///< the side of the nearest isopoint's normal; without
                         ///< isopoints, the nearest sample
  bool is_covered =
      false;             ///< no farther from the surface than 2 local spacings, which
                         ///< are mean distances of the 6 nearest samples that remained
  float distance = 0.0f; ///< from the plane of that isopoint, in units of length
  float error = 0.0f;    ///< of that isopoint
};

/** \brief Extracts the surface of some of the samples, as IsosurfacePipeline does. */
using ExtractPart = std::function<IsosurfaceResult(const IsosurfacePipelineParameters&,
                                                   const pcl::IndicesPtr& use,
                                                   const ProgressCallback&)>;

/** \brief Leave out the folds one after the other.
 * \param input points to take part, with those without a value left aside, and the
 * field and the scale that are meant
 * \return per isovalue the samples, fold by fold
 * \throws InvalidArgument for folds that leave no samples, and as IsosurfacePipeline */
PCL_UVOL_EXPORTS std::vector<std::vector<HeldOutSample>>
holdOut(const PipelineInput& input,
        const Folds& folds,
        const ExtractPart& extract,
        unsigned threads,
        Report& report);

/** \brief Shares of samples, see ValidationScore. */
PCL_UVOL_EXPORTS ValidationScore
scoreHeldOut(const std::vector<HeldOutSample>& samples);

/** \brief Say so where a surface tells the side of samples that were left out worse
 * than always saying the same does, or than the nearest sample does by more than the
 * standard error of the difference.
 * \param sampling where samples lie all around, no line of them is told of */
PCL_UVOL_EXPORTS void
warnOfScores(const std::vector<ValidationScore>& scores,
             const IsosurfacePipelineParameters& parameters,
             const std::optional<SamplingSummary>& sampling,
             Report& report);

/** \brief Divide points as the parameters say. */
PCL_UVOL_EXPORTS Folds
makeFolds(const CloudView& cloud,
          const ValidationParameters& parameters,
          unsigned threads);

/** \brief The hold-out test of a pipeline. */
class HoldOutTest {
public:
  /** \brief Divides the samples.
   * \param input with the field and the scale that are taken, before gaps are filled
   * \throws InvalidArgument for a field of folds that is none */
  HoldOutTest(const PipelineInput& input, unsigned threads);

  /** \brief Test the surface, and warn of what the scores say of it. */
  void
  leave(const ExtractPart& extract, IsosurfaceResult& result) const;

private:
  PipelineInput input_;
  Folds folds_;
  unsigned threads_;
};

} // namespace pcl_uvol
