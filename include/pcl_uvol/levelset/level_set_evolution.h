// SPDX-License-Identifier: BSD-3-Clause
// Level sets on scattered samples (thesis chapter 3): a smooth function whose zero
// level is the isosurface, computed at the samples themselves, no grid.
#pragma once

#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/common/stage.h>
#include <pcl_uvol/levelset/level_set_parameters.h>
#include <pcl_uvol/neighbors/neighbor_graph.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace pcl_uvol {

/** \brief The values do not enclose the isovalue: there is no surface to evolve. */
class PCL_UVOL_EXPORTS NoLevelSet : public InvalidArgument {
public:
  using InvalidArgument::InvalidArgument;
};

namespace detail {

/** \brief The kernel of LevelSetEvolution for any cloud.
 * \param snapshot called after every snapshot_steps steps; 0: never
 * \param is_examined whether the surface is examined, see
 * LevelSetEvolution::setExamined
 * \throws InvalidArgument, Diverged as LevelSetEvolution::evolve */
PCL_UVOL_EXPORTS LevelSet
evolveLevelSet(const CloudView& cloud,
               const pcl::Indices& indices,
               const LevelSetParameters& parameters,
               std::size_t snapshot_steps,
               const SnapshotCallback& snapshot,
               bool is_examined,
               unsigned threads,
               Report& report);

/** \brief The points of a cloud with phi and all other fields. */
PCL_UVOL_EXPORTS pcl::PCLPointCloud2
addPhi(const CloudView& cloud,
       const pcl::Indices& indices,
       const std::vector<float>& phi,
       unsigned threads,
       Report& report);

} // namespace detail

/** \brief A smooth level-set function of a scalar field at scattered points.
 *
 * Evolves thesis (3.7), d phi / dt = (mu (f - f_iso - phi) + (1 - mu) kappa) |grad
 * phi|. Here f - f_iso is divided by its slope. So phi approximates the distance to the
 * surface, positive where f is above the isovalue, and mu has the same meaning for
 * every data set. The logarithm replaces f for densities that vary by orders of
 * magnitude (see LevelSetSummary::logarithmic). Extract its zero level with
 * IsosurfaceExtraction.
 *
 * \code
 * pcl_uvol::LevelSetEvolution<pcl::PointXYZI> evolution;
 * evolution.setInputCloud(cloud);
 * evolution.setIsoValue(0.5);
 * std::vector<float> phi;
 * evolution.evolve(phi);
 * \endcode
 * Memory: 44 bytes per sample and, per sample of the band, 616 for the stencil with the
 * quadratic scheme (288 linear) and 60.
 * \tparam PointT any registered point type with x, y, z, or pcl::PCLPointCloud2 */
template <typename PointT>
class LevelSetEvolution : public CloudStage<PointT>,
                          public ParameterStage<LevelSetParameters> {
public:
  using Ptr = std::shared_ptr<LevelSetEvolution<PointT>>;
  using ConstPtr = std::shared_ptr<const LevelSetEvolution<PointT>>;

  /** \brief Any field of the cloud, see ScalarField. Default `intensity`. */
  void
  setScalarField(const std::string& field)
  {
    parameters_.field = field;
  }

  /** \return The field that is smoothed. */
  const std::string&
  getScalarField() const
  {
    return parameters_.field;
  }

  /** \brief In units of the field. */
  void
  setIsoValue(double isovalue)
  {
    parameters_.isovalue = isovalue;
  }

  /** \return The isovalue, in units of the field; NaN before it is set. */
  double
  getIsoValue() const
  {
    return parameters_.isovalue;
  }

  /** \brief Weight of the data against smoothness, in [0, 1]: 1 follows the data, 0
   * only smooths. Default: setAutomaticMu. */
  void
  setMu(double mu)
  {
    parameters_.mu = mu;
  }
  /** \brief None: automatic. */
  const std::optional<double>&
  getMu() const
  {
    return parameters_.mu;
  }

  /** \brief Smooth as far as the expected deviation from the true surface falls, and
   * not at all where it would not; see LevelSetParameters::mu. */
  void
  setAutomaticMu()
  {
    parameters_.mu.reset();
  }

  /** \brief Default FitScheme::Quadratic; FitScheme::Linear is the thesis's. */
  void
  setScheme(FitScheme scheme)
  {
    parameters_.scheme = scheme;
  }

  /** \return The degree of the fits. */
  FitScheme
  getScheme() const
  {
    return parameters_.scheme;
  }

  /** \brief Default CurvatureFlow::Relative; CurvatureFlow::Mean is the thesis's. */
  void
  setCurvatureFlow(CurvatureFlow flow)
  {
    parameters_.flow = flow;
  }

  /** \return The smoothing term. */
  CurvatureFlow
  getCurvatureFlow() const
  {
    return parameters_.flow;
  }

  /** \brief Default StepBound::Stencil; StepBound::Cfl is the thesis's. */
  void
  setStepBound(StepBound bound)
  {
    parameters_.bound = bound;
  }

  /** \return What bounds the time step. */
  StepBound
  getStepBound() const
  {
    return parameters_.bound;
  }

  /** \brief Default Integration::Asynchronous. */
  void
  setIntegration(Integration integration)
  {
    parameters_.integration = integration;
  }

  /** \return Whose time step is taken. */
  Integration
  getIntegration() const
  {
    return parameters_.integration;
  }

  /** \brief Default Reinitialization::Distance. */
  void
  setReinitialization(Reinitialization reinitialization)
  {
    parameters_.reinitialization = reinitialization;
  }

  /** \return What makes phi a distance again. */
  Reinitialization
  getReinitialization() const
  {
    return parameters_.reinitialization;
  }

  /** \brief Default: the field itself. */
  void
  setInitialFunction(const InitialFunction& initial)
  {
    parameters_.initial = initial;
  }

  /** \return The function that the evolution starts from. */
  const InitialFunction&
  getInitialFunction() const
  {
    return parameters_.initial;
  }

  /** \brief The outside of the shapes of InitialFunction. Default Outside::Lower. */
  void
  setOutside(Outside outside)
  {
    parameters_.outside = outside;
  }

  /** \return The outside of the shapes of the initial function. */
  Outside
  getOutside() const
  {
    return parameters_.outside;
  }

  /** \brief Factors per axis, finite and positive: neighbours, curvature and phi belong
   * to the stretched space. Default 1, 1, 1. */
  void
  setScale(const Eigen::Array3f& scale)
  {
    parameters_.scale = scale;
  }

  /** \return The factors of the stretched space. */
  const Eigen::Array3f&
  getScale() const
  {
    return parameters_.scale;
  }

  /** \brief Nearest neighbours of a stencil: at least 3, with the quadratic scheme 9.
   * Default 26. */
  void
  setKSearch(std::size_t k)
  {
    parameters_.k = k;
  }

  /** \return The number of nearest neighbours of a stencil. */
  std::size_t
  getKSearch() const
  {
    return parameters_.k;
  }

  /** \brief Default 400. A run that ends there has a warning in its report. */
  void
  setMaximumSteps(std::size_t steps)
  {
    parameters_.max_steps = steps;
  }

  /** \return The number of steps that a run ends at. */
  std::size_t
  getMaximumSteps() const
  {
    return parameters_.max_steps;
  }

  /** \brief The evolution ends when the zero level moves by less, in spacings per unit
   * of time. Default 0.002. */
  void
  setTolerance(double tolerance)
  {
    parameters_.tolerance = tolerance;
  }

  /** \return The motion, in spacings per unit of time, below which a run ends. */
  double
  getTolerance() const
  {
    return parameters_.tolerance;
  }

  /** \brief Only samples so near to the zero level, in spacings, are advanced; the band
   * follows it (Rosenthal, Molchanov, Linsen 2010). At least 3; 0: all samples are.
   * Default 5. */
  void
  setBandWidth(double spacings)
  {
    parameters_.band_width = spacings;
  }

  /** \return The width of the band, in spacings; 0: all samples are in it. */
  double
  getBandWidth() const
  {
    return parameters_.band_width;
  }

  /** \brief Whether evolve() examines the support of the surface if samples are not all
   * around. getTally() and the report then have three counts: examined (isopoints on
   * edges, at most 1024), and examined_bridged and examined_rim of these. Default:
   * false. */
  void
  setExamined(bool is_examined)
  {
    is_examined_ = is_examined;
  }

  /** \return Whether evolve() looks at what the surface rests on. */
  bool
  isExamined() const
  {
    return is_examined_;
  }

  /** \brief Set a function that is called after every so many steps of evolve(); 0
   * (default): no calls.
   * \param steps between two calls
   * \param snapshot the function, see SnapshotCallback */
  void
  setSnapshotCallback(std::size_t steps, const SnapshotCallback& snapshot)
  {
    snapshot_steps_ = steps;
    snapshot_ = snapshot;
  }

  /** \brief Evolve, and return phi for every point of the cloud.
   * \param phi in units of length; NaN for points that are not in the indices, or have
   * no finite coordinates or value
   * \throws InvalidArgument for a missing or empty cloud, an unknown field, an isovalue
   * that is not finite, a parameter out of range, or fewer samples than a stencil has
   * neighbours
   * \throws NoLevelSet for an isovalue that the values do not enclose
   * \throws Diverged if the function grows beyond
   * bounds; phi is then untouched
   *
   * Counts of the report: samples, no_value, non_finite, duplicates,
   * conflicting_duplicates, band_samples, isotropic_fits, steps, updates (times that a
   * sample was advanced), band_updates and reinitializations. Also outliers (values
   * unlike those of all neighbours, which are replaced) and lost_samples. These end on
   * the other side of the surface, farther from it than noise explains. */
  void
  evolve(std::vector<float>& phi);

  /** \brief The same as a cloud of the points in the indices: x, y, z, phi and all
   * other fields of the input, but not one called phi, with a warning.
   * \param cloud the result */
  void
  evolve(pcl::PCLPointCloud2& cloud);

  /** \brief The summary of the last evolve(). */
  const LevelSetSummary&
  getSummary() const
  {
    return summary_;
  }

  /** \brief The points whose values the last evolve() took, one per position,
   * as indices into the cloud. */
  const std::vector<std::uint32_t>&
  getSources() const
  {
    return sources_;
  }

  /** \brief The standard deviation, after the last evolve(), of the zero level of phi
   * from the true surface beside each point, in units of length, by index of the input
   * cloud: noise that is left and places that smoothing has moved. NaN far from the
   * surface; 0 where nearly nothing was smoothed; fits to phi include the noise there.
   */
  const std::vector<float>&
  getDeviations() const
  {
    return deviations_;
  }

  /** \brief How samples lie, after the last evolve(). */
  const std::optional<SamplingSummary>&
  getSampling() const
  {
    return sampling_;
  }

  /** \brief What was examined in the last evolve(), see setExamined(); the rest is 0.
   */
  const SurfaceTally&
  getTally() const
  {
    return tally_;
  }

private:
  /** Calls take(cloud, indices, level_set). */
  template <typename TakeT>
  void
  evolveInput(const TakeT& take);

  bool is_examined_ = false;
  std::optional<SamplingSummary> sampling_;
  SurfaceTally tally_;
  std::size_t snapshot_steps_ = 0;
  SnapshotCallback snapshot_;
  LevelSetSummary summary_;
  std::vector<std::uint32_t> sources_;
  std::vector<float> deviations_;
};

template <typename PointT>
template <typename TakeT>
void
LevelSetEvolution<PointT>::evolveInput(const TakeT& take)
{
  this->withInput("LevelSetEvolution",
                  [&](const CloudView& cloud, const pcl::Indices& indices) {
                    startReport();
                    summary_ = LevelSetSummary();
                    sampling_.reset();
                    tally_ = {};
                    LevelSet evolved = detail::evolveLevelSet(cloud,
                                                              indices,
                                                              parameters_,
                                                              snapshot_steps_,
                                                              snapshot_,
                                                              is_examined_,
                                                              threads_,
                                                              report_);
                    summary_ = evolved.summary;
                    sampling_ = evolved.sampling;
                    tally_ = evolved.tally;
                    sources_ = evolved.sources;
                    deviations_ = std::move(evolved.deviations);
                    take(cloud, indices, evolved);
                  });
}

template <typename PointT>
void
LevelSetEvolution<PointT>::evolve(std::vector<float>& phi)
{
  evolveInput([&](const CloudView&, const pcl::Indices&, LevelSet& evolved) {
    phi = std::move(evolved.phi);
  });
}

template <typename PointT>
void
LevelSetEvolution<PointT>::evolve(pcl::PCLPointCloud2& cloud)
{
  evolveInput(
      [&](const CloudView& view, const pcl::Indices& indices, LevelSet& evolved) {
        cloud = detail::addPhi(view, indices, evolved.phi, threads_, report_);
        cloud.header = this->input_->header;
      });
}

} // namespace pcl_uvol
