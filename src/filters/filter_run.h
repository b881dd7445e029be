// SPDX-License-Identifier: BSD-3-Clause
// One execution of a filter: its input, its report, and what it leaves in the output.
#pragma once

#include "filters/point_arrays.h"
#include <pcl_uvol/common/stage.h>
#include <pcl_uvol/isosurface/isosurface_extraction.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <thread>
#include <vector>

class vtkAlgorithm;
class vtkDataObject;
class vtkDataSet;
class vtkInformation;
class vtkPolyData;

namespace pcl_uvol {

/** \brief Thrown through a stage to end it; no Exception, as nothing is wrong. */
struct Aborted {};

/** \brief From the steps of stages to the progress of a filter. Observers belong to the
 * thread that updates the pipeline: what other threads tell is dropped. */
class PipelineProgress {
public:
  explicit PipelineProgress(vtkAlgorithm& filter)
      : filter_(filter)
  {
  }

  /** \brief Steps that tell their progress, each an equal part of the whole. */
  void
  expect(std::size_t steps)
  {
    expected_ = steps;
  }

  /** \throws Aborted if the filter was told to */
  void
  advanceTo(double done);

private:
  vtkAlgorithm& filter_;
  const std::thread::id thread_ = std::this_thread::get_id();
  std::size_t expected_ = 1, started_ = 0;
};

/** \brief Empty the output of a filter and fill it by a function: exceptions become an
 * ErrorEvent and an empty output, warnings of the report WarningEvents, an abort an
 * empty output.
 * \param work gets the progress to tell, and a report that tells it
 * \return what RequestData returns */
int
runGuarded(vtkAlgorithm& filter,
           vtkDataObject& output,
           const std::function<void(PipelineProgress& progress, Report& report)>& work);

/** \brief Ask an input for its data as a whole. */
void
askForAll(vtkInformation& input);

/** \brief Indices of the points that are neither duplicates of another piece nor
 * hidden.
 * \throws InvalidArgument for more points than PCL can number */
std::vector<int>
visiblePoints(vtkDataSet& input);

/** \brief What Execute gets. */
struct FilterRun {
  vtkDataSet& input;
  const std::vector<int>& visible; ///< not empty
  vtkPolyData& output;
  PipelineProgress& progress;
  Report& report; ///< tells the progress; its warnings become the filter's
};

/** \brief Fill an output from a cloud that has the input's fields already, and add the
 * input's other arrays, names of components, and active arrays.
 * \param edges where each point lies between points of the input */
void
fillOutput(const Dataset& result,
           const PointArrays& input,
           const IsoEdges& edges,
           FilterRun& run);

/** \brief The edges of points that stand for one input point each. */
IsoEdges
edgesAt(const std::vector<std::uint32_t>& sources);

} // namespace pcl_uvol
