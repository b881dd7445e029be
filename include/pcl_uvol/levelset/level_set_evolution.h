// SPDX-License-Identifier: BSD-3-Clause
// Level sets on scattered samples (thesis chapter 3): a smooth function whose zero
// level is the isosurface, computed at the samples themselves, no grid.
#pragma once

#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/common/stage.h>
#include <pcl_uvol/levelset/level_set_parameters.h>

#include <pcl/pcl_base.h>

#include <cstddef>
#include <limits>
#include <string>
#include <vector>

namespace pcl_uvol {

/** \brief The kernel of LevelSetEvolution for any cloud.
 * \throws InvalidArgument, Diverged as LevelSetEvolution::evolve */
PCL_UVOL_EXPORTS LevelSet
evolveLevelSet(const CloudView& cloud,
               const std::vector<int>& indices,
               const std::string& field,
               double isovalue,
               const LevelSetParameters& parameters,
               Report& report);

/** \brief Bytes of a point of cloudOfPhi(). */
constexpr std::size_t phi_point_bytes = 4 * sizeof(float);

/** \brief A cloud of the points' coordinates and the field `phi`, of which
 * IsosurfaceExtraction makes the zero level. \param phi one per point
 * \throws InvalidArgument for another number */
PCL_UVOL_EXPORTS pcl::PCLPointCloud2
cloudOfPhi(const CloudView& cloud, const std::vector<float>& phi);

/** \brief A smooth level-set function of a scalar field at scattered points.
 *
 * Evolves thesis (3.7), d phi / dt = (mu (f - f_iso - phi) + (1 - mu) kappa) |grad
 * phi|, where f - f_iso is divided by its slope, so that phi is about the distance to
 * the surface, positive where f is above the isovalue, and mu means the same for every
 * data set. Extract its zero level with IsosurfaceExtraction.
 *
 * \code
 * pcl_uvol::LevelSetEvolution<pcl::PointXYZI> evolution;
 * evolution.setInputCloud(cloud);
 * evolution.setIsoValue(0.5);
 * std::vector<float> phi;
 * evolution.evolve(phi);
 * \endcode
 * Memory: 60 bytes per sample and, per sample of the band, 616 for the stencil with the
 * quadratic scheme (288 linear) and 60. \tparam PointT any registered point type with
 * x, y, z, or pcl::PCLPointCloud2 */
template <typename PointT>
class LevelSetEvolution : public pcl::PCLBase<PointT>, public Stage {
public:
  /** \brief Any field of the cloud, see ScalarField. Default `intensity`. */
  void
  setScalarField(const std::string& field)
  {
    field_ = field;
  }

  /** \brief In units of the field. */
  void
  setIsoValue(double isovalue)
  {
    isovalue_ = isovalue;
  }

  /** \brief Weight of the data against smoothness, in [0, 1]: 1 follows the data, 0
   * only smooths. Default: setAutomaticMu. */
  void
  setMu(double mu)
  {
    parameters_.mu = mu;
  }

  /** \brief Choose mu by the noise of the data, and raise it whenever the data pull
   * the surface in one direction over several spacings: smoothing has taken away what
   * is no noise. */
  void
  setAutomaticMu()
  {
    parameters_.mu = LevelSetParameters::automatic;
  }

  /** \brief Default FitScheme::Quadratic; FitScheme::Linear is the thesis's. */
  void
  setScheme(FitScheme scheme)
  {
    parameters_.scheme = scheme;
  }

  /** \brief Default CurvatureFlow::Relative; CurvatureFlow::Mean is the thesis's. */
  void
  setCurvatureFlow(CurvatureFlow flow)
  {
    parameters_.flow = flow;
  }

  /** \brief Default StepBound::Stencil; StepBound::Cfl is the thesis's. */
  void
  setStepBound(StepBound bound)
  {
    parameters_.bound = bound;
  }

  /** \brief Default Integration::Asynchronous. */
  void
  setIntegration(Integration integration)
  {
    parameters_.integration = integration;
  }

  /** \brief Default Reinitialization::Distance. */
  void
  setReinitialization(Reinitialization reinitialization)
  {
    parameters_.reinitialization = reinitialization;
  }

  /** \brief Default: the field itself. */
  void
  setInitialFunction(const InitialFunction& initial)
  {
    parameters_.initial = initial;
  }

  /** \brief The outside of the shapes of InitialFunction. Default Outside::Lower. */
  void
  setOutside(Outside outside)
  {
    parameters_.outside = outside;
  }

  /** \brief Factors per axis, finite and positive: neighbours, curvature and phi belong
   * to the stretched space. Default 1, 1, 1. */
  void
  setScale(const Eigen::Array3f& scale)
  {
    parameters_.scale = scale;
  }

  /** \brief Nearest neighbours of a stencil: at least 3, with the quadratic scheme 9.
   * Default 26. */
  void
  setKSearch(std::size_t k)
  {
    parameters_.k = k;
  }

  /** \brief Default 400. A run that ends there has a warning in its report. */
  void
  setMaximumSteps(std::size_t steps)
  {
    parameters_.max_steps = steps;
  }

  /** \brief The evolution ends when the zero level moves by less, in spacings per unit
   * of time. Default 0.002. */
  void
  setTolerance(double tolerance)
  {
    parameters_.tolerance = tolerance;
  }

  /** \brief Only samples so near to the zero level, in spacings, are advanced; the band
   * follows it (Rosenthal, Molchanov, Linsen 2010). At least 3; 0: all samples are.
   * Default 5. */
  void
  setBandWidth(double spacings)
  {
    parameters_.band_width = spacings;
  }

  /** \brief Told after every so many steps of evolve(); 0 (default): nobody is. */
  void
  setSnapshotCallback(std::size_t steps, const SnapshotCallback& snapshot)
  {
    parameters_.snapshot_steps = steps;
    parameters_.snapshot = snapshot;
  }

  /** \brief Evolve, and return phi for every point of the cloud.
   * \param phi in units of length; NaN for points that are not in the indices, or have
   * no finite coordinates or value \throws InvalidArgument for a missing or empty
   * cloud, an unknown field, an isovalue that is not finite or that the values do not
   * enclose, a parameter out of range, or fewer samples than a stencil has neighbours
   * \throws Diverged if the function grows beyond bounds; phi is then untouched
   *
   * Counts of the report: samples, no_value, non_finite, duplicates,
   * conflicting_duplicates, band_samples, isotropic_fits, steps, updates (times that a
   * sample was advanced), band_updates, reinitializations, mu_raised. */
  void
  evolve(std::vector<float>& phi);

  /** \brief Of the last evolve(). */
  const LevelSetSummary&
  getSummary() const
  {
    return summary_;
  }

private:
  std::string field_ = "intensity";
  double isovalue_ = std::numeric_limits<double>::quiet_NaN();
  LevelSetParameters parameters_;
  LevelSetSummary summary_;
};

} // namespace pcl_uvol
