// SPDX-License-Identifier: BSD-3-Clause
// Smooth level-set functions of scattered points in a VTK pipeline.
#pragma once

#include <pcl_uvol/filters/vtkUvolFilter.h>

namespace pcl_uvol {
struct LevelSetParameters;
}

/** \brief A smooth level-set function of noisy or uneven samples: what
 * pcl_uvol::LevelSetEvolution and the tool uvol_levelset compute.
 *
 * \code
 * levelset->SetInputConnection(reader->GetOutputPort());
 * levelset->SetIsovalue(0.5);
 * isosurface->SetInputConnection(levelset->GetOutputPort()); // of phi, at 0
 * \endcode
 * Array 0 of SetInputArrayToProcess is the scalar (default: the active scalars of
 * points), array 1 one to start from instead (in units of length; default: none).
 * The output is the input's points and arrays with phi, the active scalars: about the
 * distance to the surface, positive where values are above the isovalue, NaN where a
 * point has no value. Initial shapes and snapshots are in the library only. */
class PCL_UVOL_EXPORTS vtkUvolLevelSet : public vtkUvolFilter {
public:
  vtkTypeMacro(vtkUvolLevelSet, vtkUvolFilter);
  /** \return A new object, to be held by a vtkNew or vtkSmartPointer. */
  static vtkUvolLevelSet*
  New();

  /** \brief Write the settings, as VTK's classes do.
   * \param out where to
   * \param indent in front of each line */
  void
  PrintSelf(std::ostream& out, vtkIndent indent) override;

  /** \brief In units of the array. Default 0. @{ */
  vtkSetMacro(Isovalue, double);
  vtkGetMacro(Isovalue, double);
  /** @} */

  /** \brief The zero-based component of an array of several components; -1: their
   * length. Default 0. @{ */
  vtkSetClampMacro(ArrayComponent, int, -1, VTK_INT_MAX);
  vtkGetMacro(ArrayComponent, int);
  /** @} */

  /** \brief Weight of the data against smoothness, 1 follows the data, 0 only smooths;
   * automatic (default): by the noise of the data. @{ */
  vtkSetMacro(AutomaticMu, bool);
  vtkGetMacro(AutomaticMu, bool);
  vtkBooleanMacro(AutomaticMu, bool);
  vtkSetClampMacro(Mu, double, 0.0, 1.0);
  vtkGetMacro(Mu, double);
  /** @} */

  enum SchemeKind { SCHEME_LINEAR, SCHEME_QUADRATIC };
  /** \brief Local fits. Default quadratic; linear is the thesis's. @{ */
  vtkSetClampMacro(Scheme, int, SCHEME_LINEAR, SCHEME_QUADRATIC);
  vtkGetMacro(Scheme, int);
  /** @} */

  enum CurvatureFlowKind { FLOW_MEAN, FLOW_RELATIVE };
  /** \brief The smoothing term. Default relative; mean is the thesis's. @{ */
  vtkSetClampMacro(CurvatureFlow, int, FLOW_MEAN, FLOW_RELATIVE);
  vtkGetMacro(CurvatureFlow, int);
  /** @} */

  enum StepBoundKind { BOUND_CFL, BOUND_STENCIL };
  /** \brief What bounds time steps. Default stencil; CFL is the thesis's. @{ */
  vtkSetClampMacro(StepBound, int, BOUND_CFL, BOUND_STENCIL);
  vtkGetMacro(StepBound, int);
  /** @} */

  enum IntegrationKind { INTEGRATION_SYNCHRONOUS, INTEGRATION_ASYNCHRONOUS };
  /** \brief One time step for all samples or one for each (default). @{ */
  vtkSetClampMacro(Integration, int, INTEGRATION_SYNCHRONOUS, INTEGRATION_ASYNCHRONOUS);
  vtkGetMacro(Integration, int);
  /** @} */

  enum ReinitializationKind {
    REINITIALIZATION_NONE,
    REINITIALIZATION_DISTANCE,
    REINITIALIZATION_EIKONAL,
    REINITIALIZATION_DIFFUSION
  };
  /** \brief What keeps the slope at 1. Default distance. @{ */
  vtkSetClampMacro(Reinitialization,
                   int,
                   REINITIALIZATION_NONE,
                   REINITIALIZATION_DIFFUSION);
  vtkGetMacro(Reinitialization, int);
  /** @} */

  /** \brief Nearest neighbours of a stencil: at least 3, quadratic 9. Default 26. @{ */
  vtkSetClampMacro(NumberOfNeighbors, int, 3, VTK_INT_MAX);
  vtkGetMacro(NumberOfNeighbors, int);
  /** @} */

  /** \brief Default 400. A run that ends there warns of it. @{ */
  vtkSetClampMacro(MaximumNumberOfSteps, int, 1, VTK_INT_MAX);
  vtkGetMacro(MaximumNumberOfSteps, int);
  /** @} */

  /** \brief The evolution ends when the surface moves by less, in spacings per unit of
   * time, > 0. Default 0.002. @{ */
  vtkSetMacro(Tolerance, double);
  vtkGetMacro(Tolerance, double);
  /** @} */

  /** \brief Only samples so near to the surface, in spacings, are advanced: at least 3;
   * 0: all are. Default 5. @{ */
  vtkSetMacro(BandWidth, double);
  vtkGetMacro(BandWidth, double);
  /** @} */

  /** \brief Factors per axis of the space that distances are measured in: finite and
   * positive. Default 1, 1, 1. @{ */
  vtkSetVector3Macro(Scale, double);
  vtkGetVector3Macro(Scale, double);
  /** @} */

protected:
  vtkUvolLevelSet();
  ~vtkUvolLevelSet() override = default;

  void
  Execute(pcl_uvol::FilterRun& run) override;

private:
  vtkUvolLevelSet(const vtkUvolLevelSet&) = delete;
  void
  operator=(const vtkUvolLevelSet&) = delete;

  pcl_uvol::LevelSetParameters
  Parameters() const;

  double Isovalue = 0.0;
  int ArrayComponent = 0;
  bool AutomaticMu = true;
  double Mu = 0.5;
  int Scheme = SCHEME_QUADRATIC;
  int CurvatureFlow = FLOW_RELATIVE;
  int StepBound = BOUND_STENCIL;
  int Integration = INTEGRATION_ASYNCHRONOUS;
  int Reinitialization = REINITIALIZATION_DISTANCE;
  int NumberOfNeighbors = 26;
  int MaximumNumberOfSteps = 400;
  double Tolerance = 0.002;
  double BandWidth = 5.0;
  double Scale[3] = {1.0, 1.0, 1.0};
};
