// SPDX-License-Identifier: BSD-3-Clause
// How a stage of the library runs for Python: on all points of a data set, with
// parameters in JSON.
#pragma once

#include "common/records.h"
#include "shared/convert.h"
#include "shared/interruptible.h"

#include <pybind11/pybind11.h>
#include <string>

namespace pcl_uvol::python {

using Cloud = pcl::PCLPointCloud2;

/** \brief The same data set around another cloud. */
inline DatasetPtr
withCloud(const Dataset& dataset, Cloud&& cloud)
{
  auto result = std::make_shared<Dataset>(withoutCloud(dataset));
  result->cloud = std::move(cloud);
  result->cloud.header = dataset.cloud.header;
  return result;
}

/** \brief Set a stage up and run it.
 * \param work runs the stage and takes its result, without the lock of the interpreter
 * \return the stage's report, and in it "parameters": those that it took, as JSON */
template <typename StageT, typename WorkT>
pybind11::dict
runStage(StageT& stage,
         const DatasetPtr& dataset,
         const std::string& parameters,
         unsigned threads,
         const pybind11::object& progress,
         const WorkT& work)
{
  stage.setParameters(StageT::Parameters::fromJson(parameters));
  const std::string taken = stage.getParameters().toJson();
  stage.setNumberOfThreads(threads);
  runInterruptibly(progress, [&](const ProgressCallback& callback) {
    stage.setInputCloud(Cloud::ConstPtr(dataset, &dataset->cloud));
    stage.setProgressCallback(callback);
    work();
  });
  pybind11::dict report = toDict(stage.getReport());
  report["parameters"] = toText(taken);
  return report;
}

} // namespace pcl_uvol::python
