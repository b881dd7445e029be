// SPDX-License-Identifier: BSD-3-Clause
// What the filters of VTK pipelines have in common. Files of these classes are called
// as the classes, which VTK's and ParaView's wrappers ask for.
#pragma once

#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/common/export.h>

#include <vtkPolyDataAlgorithm.h>

#include <string>

class vtkDataSet;

namespace pcl_uvol {
struct FilterRun;
struct PointArrays;
} // namespace pcl_uvol

/** \brief Base of filters from points to points: any vtkPointSet, image or rectilinear
 * grid in, vtkPolyData with a vertex per point out.
 *
 * Points that vtkGhostType marks as duplicate or hidden are left out, connectivity does
 * not matter. All point arrays are in the output: floating-point numbers interpolated,
 * integers, strings and variants from the nearest sample, under their own names, types
 * and names of components; active normals are called Normals. Coordinates in double
 * stay in double. Input without points gives output without points.
 *
 * Bad input gives an ErrorEvent in one sentence and an empty output. Each warning of a
 * report gives a WarningEvent. Progress is reported from the thread that updates the
 * pipeline; SetAbortExecute in an observer of it ends the run with an empty output. The
 * same input gives the same bytes on any number of threads. */
class PCL_UVOL_EXPORTS vtkUvolFilter : public vtkPolyDataAlgorithm {
public:
  vtkAbstractTypeMacro(vtkUvolFilter, vtkPolyDataAlgorithm);
  /** \brief Write the settings, as VTK's classes do.
   * \param out where to
   * \param indent in front of each line */
  void
  PrintSelf(std::ostream& out, vtkIndent indent) override;

  /** \brief 0 (default) = all cores. @{ */
  vtkSetClampMacro(NumberOfThreads, int, 0, VTK_INT_MAX);
  vtkGetMacro(NumberOfThreads, int);
  /** @} */

protected:
  vtkUvolFilter() = default;
  ~vtkUvolFilter() override = default;

  /** \brief Tell VTK which data the inputs take.
   * \param port of the input
   * \param info gets the type
   * \return 1 */
  int
  FillInputPortInformation(int port, vtkInformation* info) override;

  /** \brief Execute, as VTK's pipeline asks for.
   * \param request what the pipeline asks for
   * \param inputs of the ports
   * \param outputs gets the result
   * \return 1, and 0 after an error */
  int
  RequestData(vtkInformation* request,
              vtkInformationVector** inputs,
              vtkInformationVector* outputs) override;

  /** \brief Fill the output. Exceptions of pcl_uvol become errors.
   * \param run input, output, progress and report of this execution */
  virtual void
  Execute(pcl_uvol::FilterRun& run) = 0;

  /** \brief The field expression of an array chosen by SetInputArrayToProcess.
   * \param component -1 for the length of all of them
   * \param index of the array, the first argument of SetInputArrayToProcess
   * \param input the data set that has the array
   * \param points arrays of the input that became fields
   * \throws InvalidArgument unless it is an array of numbers at points */
  std::string
  FieldToProcess(int index,
                 int component,
                 vtkDataSet& input,
                 const pcl_uvol::PointArrays& points);

  int NumberOfThreads = 0;

private:
  vtkUvolFilter(const vtkUvolFilter&) = delete;
  void
  operator=(const vtkUvolFilter&) = delete;
};
