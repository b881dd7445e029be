// SPDX-License-Identifier: BSD-3-Clause
// The box that a pipeline's samples repeat in.
#pragma once

#include "neighbors/periodic_box.h"
#include "pipeline/pipeline_input.h"
#include <pcl_uvol/pipeline/isosurface_result.h>

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace pcl_uvol {

/** \brief The sides of the box that repeats. */
inline std::array<double, 3>
sidesOf(const IsosurfacePipelineParameters& parameters)
{
  const Eigen::Array3d& sides = parameters.periodic;
  return {{sides[0], sides[1], sides[2]}};
}

/** \brief A box as it is told.
 *
 * \param origin of the coordinates that it has */
PCL_UVOL_EXPORTS SampleBox
toSampleBox(const PeriodicBox& box, const std::array<double, 3>& origin);

/** \brief The points that have a finite value: those that images are of.
 *
 * \param use null: all points */
std::vector<std::uint32_t>
listWithValue(const Dataset& samples,
              const pcl::IndicesPtr& use,
              const std::string& field);

/** \brief How far images reach for what parameters ask for. */
PeriodicReach
reachFor(const IsosurfacePipelineParameters& parameters);

/** \brief Bring the points of a surface back from the box that its samples had with
 * their images to the box that they came in.
 *
 * \param cut that box, from whose corner the coordinates count
 *
 * \param origin of the samples as they came */
void
returnPoints(const PeriodicBox& cut,
             const PeriodicBox& box,
             const std::array<double, 3>& origin,
             IsosurfaceResult& result);

/** \brief Where an image lies. */
using ImagePlace = std::array<float, 3>;

/** \brief The places of images.
 *
 * \param first image among the points */
std::vector<ImagePlace>
listPlaces(const Dataset& points, std::size_t first);

/** \brief How many of them differ: images coincide where their samples do. */
std::uint64_t
countPlaces(std::vector<ImagePlace> places);

/** \brief Adds images of samples to a pipeline whose box repeats, and brings its
 * surface back into the box. */
class RepeatedBox {
public:
  /** \param input with the field and the scale that are taken; gets samples with
   * images, if its box repeats
   * \param report gets what findPeriodicBox() and addPeriodicImages() tell */
  RepeatedBox(PipelineInput& input, unsigned threads, Report& report);

  /** \brief Bring the surface back into the box, and leave images out of the counts.
   * \param parameters that it was made by */
  void
  leave(const IsosurfacePipelineParameters& parameters, IsosurfaceResult& result) const;

private:
  std::shared_ptr<const Dataset> samples_; ///< as they came
  PeriodicBox box_;
  std::shared_ptr<PeriodicSamples> images_; ///< null: no box repeats
};

} // namespace pcl_uvol
