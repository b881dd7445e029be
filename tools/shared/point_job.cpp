// SPDX-License-Identifier: BSD-3-Clause
#include "shared/point_job.h"

#include <functional>

namespace uvol_tools {

PointJob::PointJob(Options& options)
    : options_(options)
{
  report.progress = std::ref(bar_);
  options.file("in", input_);
  options.file("out", output_);
}

void
PointJob::declareInput(std::string* field)
{
  options_.group("Input");
  if (field)
    declareField(options_, *field);
  reading_.emplace().declare(options_);
}

void
PointJob::declareOutput()
{
  options_.group("Output");
  options_.flag("ascii", ascii_, "write PCD and PLY as text");
}

pcl_uvol::Dataset
PointJob::read()
{
  const auto load = reading_ ? reading_->makeLoadOptions() : pcl_uvol::LoadOptions();
  const std::string where = reading_ ? reading_->getWhere() : "";
  pcl_uvol::checkSavePath(output_);
  facts = {{"input", input_}, {"output", output_}};
  total_.emplace(report, "total");
  pcl_uvol::Dataset points =
      loadPoints(input_, report, load, where, options_.threads(), &points_);
  pcl_uvol::checkSavePath(output_, points.cloud.fields);
  return points;
}

int
PointJob::finish(const pcl_uvol::Dataset& result)
{
  pcl_uvol::SaveOptions save;
  save.ascii = ascii_;
  savePoints(output_, result, save, report);
  report.setCount("points", points_); // of stages that count them as well
  total_.reset();
  facts.push_back(describeMemory());
  printReport(options_, report, facts);
  return 0;
}

} // namespace uvol_tools
