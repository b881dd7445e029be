// SPDX-License-Identifier: BSD-3-Clause
// The field between scattered samples, at the points of any data set.
#pragma once

#include <pcl_uvol/common/export.h>

#include <vtkDataSetAlgorithm.h>

#include <memory>
#include <string>

class vtkDataSet;

namespace pcl_uvol {
struct InterpolationParameters;
struct Report;
} // namespace pcl_uvol

/** \brief Fields of samples at the points of other data, as vtkProbeFilter and
 * vtkPointInterpolator, but straight from samples, with or without cells: what
 * pcl_uvol::FieldInterpolation and the tool uvol_probe find.
 *
 * \code
 * vtkNew<vtkUvolProbe> probe;
 * probe->SetInputConnection(plane->GetOutputPort());
 * probe->SetSourceConnection(samples->GetOutputPort());
 * probe->SetField("density");
 * \endcode
 * The output is the input with further arrays of points in double precision: the field,
 * its standard error (density_error), its gradient if asked for (density_gradient), and
 * support (unsigned char, a pcl_uvol::FieldSupport: 1 samples all around, 2 a gap, 3 a
 * rim, 5 samples that do not determine the model, 6 no place, 7 outside). Outside of
 * the samples, or of their cells where they have any, values are NaN. Where the input
 * has an array of such a name, the name gets _2.
 *
 * Points of the source that vtkGhostType marks as duplicate or hidden are left out. The
 * model is kept until source or parameters change. Errors, warnings, progress and abort
 * are those of vtkUvolFilter. */
class PCL_UVOL_EXPORTS vtkUvolProbe : public vtkDataSetAlgorithm {
public:
  vtkTypeMacro(vtkUvolProbe, vtkDataSetAlgorithm);
  /** \return A new object, to be held by a vtkNew or vtkSmartPointer. */
  static vtkUvolProbe*
  New();

  /** \brief Write the settings, as VTK's classes do.
   * \param out where to
   * \param indent in front of each line */
  void
  PrintSelf(std::ostream& out, vtkIndent indent) override;

  /** \brief The samples: any vtkPointSet, image or rectilinear grid.
   * \param output of the filter or reader that gives the samples */
  void
  SetSourceConnection(vtkAlgorithmOutput* output)
  {
    this->SetInputConnection(1, output);
  }

  /** \brief The samples, without a pipeline in front of them.
   * \param source any vtkPointSet, image or rectilinear grid */
  void
  SetSourceData(vtkDataObject* source)
  {
    this->SetInputDataObject(1, source);
  }

  /** \brief A field of the samples: an array of one component, or as tools write it,
   * `vel[1]`, `|vel|`. Empty (default): every number of every array. @{ */
  void
  SetField(const std::string& field);
  const std::string&
  GetField() const
  {
    return this->Field;
  }
  /** @} */

  enum ModelKind {
    MODEL_FIT,
    MODEL_NEAREST,
    MODEL_SHEPARD,
    MODEL_NATURAL,
    MODEL_LAPLACE,
    MODEL_KRIGING,
    MODEL_SPH,
    MODEL_AUTO
  };
  /** \brief See pcl_uvol::InterpolationModel. Default: blended local fits. @{ */
  vtkSetClampMacro(Model, int, MODEL_FIT, MODEL_AUTO);
  vtkGetMacro(Model, int);
  /** @} */

  /** \brief Give values outside of the samples as well. Default off. @{ */
  vtkSetMacro(Extrapolate, vtkTypeBool);
  vtkGetMacro(Extrapolate, vtkTypeBool);
  vtkBooleanMacro(Extrapolate, vtkTypeBool);
  /** @} */

  /** \brief If the source has cells of three dimensions, they decide where the data
   * are: positions inside of a cell have a value, positions outside of all cells have
   * no value. Default on. @{ */
  vtkSetMacro(CellMask, vtkTypeBool);
  vtkGetMacro(CellMask, vtkTypeBool);
  vtkBooleanMacro(CellMask, vtkTypeBool);
  /** @} */

  /** \brief Default off. @{ */
  vtkSetMacro(ComputeGradients, vtkTypeBool);
  vtkGetMacro(ComputeGradients, vtkTypeBool);
  vtkBooleanMacro(ComputeGradients, vtkTypeBool);
  /** @} */

  /** \brief Factors per axis of the space that distances are measured in: finite and
   * positive. Default 1, 1, 1. @{ */
  vtkSetVector3Macro(Scale, double);
  vtkGetVector3Macro(Scale, double);
  /** @} */

  /** \brief 0 (default) = all cores. The result does not depend on it. @{ */
  vtkSetClampMacro(NumberOfThreads, int, 0, VTK_INT_MAX);
  vtkGetMacro(NumberOfThreads, int);
  /** @} */

protected:
  vtkUvolProbe();
  ~vtkUvolProbe() override;

  /** \brief Tell VTK which data the inputs take.
   * \param port of the input
   * \param info gets the type
   * \return 1 */
  int
  FillInputPortInformation(int port, vtkInformation* info) override;

  /** \brief Ask for the whole of the samples, and for the piece of the input that the
   * output is asked for.
   * \param request what the pipeline asks for
   * \param inputs of the ports
   * \param outputs of the port
   * \return 1 */
  int
  RequestUpdateExtent(vtkInformation* request,
                      vtkInformationVector** inputs,
                      vtkInformationVector* outputs) override;

  /** \brief Execute, as VTK's pipeline asks for.
   * \param request what the pipeline asks for
   * \param inputs of the ports
   * \param outputs gets the result
   * \return 1, and 0 after an error */
  int
  RequestData(vtkInformation* request,
              vtkInformationVector** inputs,
              vtkInformationVector* outputs) override;

private:
  vtkUvolProbe(const vtkUvolProbe&) = delete;
  void
  operator=(const vtkUvolProbe&) = delete;

  pcl_uvol::InterpolationParameters
  Parameters() const;

  /** Reads the source and makes the model, unless both are those of the last run. */
  void
  ReadSource(vtkDataSet& source, pcl_uvol::Report& report);

  std::string Field;
  int Model = MODEL_FIT;
  vtkTypeBool Extrapolate = 0;
  vtkTypeBool CellMask = 1;
  vtkTypeBool ComputeGradients = 0;
  double Scale[3] = {1.0, 1.0, 1.0};
  int NumberOfThreads = 0;

  struct Samples;
  std::unique_ptr<Samples> Read; ///< with the model
};
