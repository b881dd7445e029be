// SPDX-License-Identifier: BSD-3-Clause
// Samples that kriging predicts where measured ones are missing, around the isosurfaces
// that run through there, and what isopoints between them are worth.
#pragma once

#include "interpolation/variogram.h"
#include "neighbors/sample_set.h"
#include "pipeline/isopoint_choice.h"
#include "pipeline/pipeline_input.h"
#include "pipeline/reliable_fits.h"
#include "pipeline/sample_hull.h"
#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/common/dataset.h>
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/common/stage.h>
#include <pcl_uvol/interpolation/field_interpolation.h>
#include <pcl_uvol/isosurface/isosurface_extraction.h>
#include <pcl_uvol/neighbors/neighbor_graph.h>
#include <pcl_uvol/pipeline/isosurface_pipeline_parameters.h>
#include <pcl_uvol/pipeline/isosurface_result.h>

#include <pcl/types.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

namespace pcl_uvol::detail {

/** \brief Nodes of the lattice that gaps are filled on, at most: a surface that needs
 * more gets a coarser one. */
constexpr std::size_t most_gap_nodes = std::size_t{1} << 20;

/** \brief Bytes of a node: in tables, as a sample of the surface, and in a tree. */
constexpr double gap_node_bytes = 300.0;

/** \brief Kriging as it bridges gaps: from 16 samples, an eighth of them from each
 * octant, since the nearest ones may all lie on one line. Without errors and gradients.
 */
InterpolationParameters
gapKriging(const IsosurfaceParameters& isosurface);

/** \brief Whether isopoints in gaps are those of the lattice that the kriged field was
 * followed on, and not those between predicted and measured samples: where isopoints
 * are chosen one by one. */
bool
takesLattice(const IsosurfacePipelineParameters& parameters);

/** \brief The samples with those that were predicted behind them.
 *
 * A surface is followed from the isopoints that lack support through the kriged field,
 * on a jittered lattice of a quarter of the spacing of the lines or sheets. The field
 * is kriged from the means of the samples in the lattice's cells, as drill cores are
 * composited (Chiles and Delfiner, Geostatistics, section 2.4, on regularization): what
 * is finer along a line cannot be followed across to the next one. Their variogram is a
 * robust one, see VariogramEstimator::MeanRoot. The lattice's nodes around the surface
 * become samples where measured ones lack, at most half a gap outside of the hull of
 * these, and no farther from the nearest one than the range of the variogram and than a
 * few of these spacings; none where local fits of the measured ones are more certain of
 * the surface, see ReliableFits. */
class PCL_UVOL_EXPORTS FilledGaps {
public:
  /** \param input with the field and the scale that are taken; gets the samples and
   * points to take with predicted ones behind them, whose other fields are those of the
   * nearest measured one
   * \throws InvalidArgument for a field that is not one of single numbers, and as
   * FieldInterpolation */
  FilledGaps(PipelineInput& input, unsigned threads, Report& report);

  const GapFilling&
  getSummary() const
  {
    return summary_;
  }

  /** \brief The sampling of the measured ones. */
  const SamplingSummary&
  getSampling() const
  {
    return sampling_;
  }

  /** \brief Mark isopoints that rest on predicted samples and tell their errors and the
   * confidence of all.
   *
   * With Interpolation::Auto, isopoints that lack support of measured samples are put
   * onto the kriged surface, or back to their edge where this is a short one between
   * measured samples, and have the normals of the kriged field; those that lie far from
   * its surface, or whose confidence is 0, are removed. Where takesLattice() says so,
   * those in gaps are added first, and measured samples have no others across gaps.
   * None of them lies more than half a gap outside of the samples' hull. */
  void
  judge(const IsosurfacePipelineParameters& parameters,
        unsigned threads,
        pcl::PointCloud<PointIso>& isopoints,
        IsoEdges& edges,
        IsopointChoice& choice,
        Report& report) const;

private:
  /** Predicted samples that are neighbours on the lattice. */
  using LatticeEdge = std::pair<std::uint32_t, std::uint32_t>;

  /** \return which roots lie in gaps */
  std::vector<std::uint8_t>
  findSpacing(const pcl::PointCloud<PointIso>& roots,
              const IsoEdges& edges,
              const IsosurfaceParameters& parameters,
              unsigned threads,
              const ProgressCallback& progress);

  /** Krige from now on from the means of samples in cells of the lattice. */
  void
  krigeComposites(const IsosurfaceParameters& parameters,
                  unsigned threads,
                  const ProgressCallback& progress);

  /** Find where fits are more certain of the surface across gaps than kriging, and what
   * their errors are elsewhere.
   * \param is_in_gap one per isopoint
   * \param extraction of the measured samples */
  void
  compareFits(const std::vector<std::uint8_t>& is_in_gap,
              const IsosurfaceParameters& parameters,
              IsosurfaceExtraction<pcl::PCLPointCloud2>& extraction,
              unsigned threads,
              const ProgressCallback& progress);

  /** Predict where roots that lie in gaps need it, and tell if they do not.
   * \param is_in_gap one per root */
  void
  predictBetween(const pcl::PointCloud<PointIso>& roots,
                 const std::vector<std::uint8_t>& is_in_gap,
                 const IsosurfaceParameters& parameters,
                 unsigned threads,
                 Report& report);

  void
  takeVariogram();

  void
  predict(const pcl::PointCloud<PointIso>& roots,
          const IsosurfaceParameters& parameters,
          unsigned threads,
          Report& report);

  /** Whether a place may lie in a gap: its nearest measured sample is one of a line or
   * a sheet, or alone. */
  std::vector<std::uint8_t>
  findThin(const std::vector<std::array<double, 3>>& places,
           unsigned threads,
           std::vector<double>* distances) const;

  /** Add the isopoints of the lattice behind the others of their isovalue. */
  void
  addLatticeIsopoints(const IsosurfaceParameters& parameters,
                      pcl::PointCloud<PointIso>& isopoints,
                      IsoEdges& edges,
                      IsopointChoice& choice) const;

  std::shared_ptr<const Dataset> samples_, filled_;
  pcl::IndicesPtr indices_;
  SampleSet::ConstPtr measured_;
  SamplingSummary sampling_;
  std::unique_ptr<FieldInterpolator> field_;
  std::unique_ptr<SampleHull> hull_;
  std::unique_ptr<ReliableFits> reliable_fits_;
  std::unique_ptr<FieldInterpolator> nearest_; ///< tells support of measured samples
  std::vector<LatticeEdge> lattice_edges_;
  double reach_ = 0.0; ///< from the nearest measured sample
  bool has_gaps_ = false;
  /** Median of the errors of fits to measured samples across gaps where they are not
   * the more certain ones; infinite of none. */
  float measured_error_ = std::numeric_limits<float>::infinity();
  GapFilling summary_;
};

} // namespace pcl_uvol::detail
