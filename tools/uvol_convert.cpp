// SPDX-License-Identifier: BSD-3-Clause
// Points from one format into another, as they are.
#include "shared/density_options.h"
#include "shared/options.h"
#include "shared/point_files.h"
#include "shared/series.h"
#include <pcl_uvol/io/dataset.h>

namespace {

int
run(int argc, char** argv, uvol_tools::SeriesStep* /*step*/)
{
  std::string input, output;
  bool ascii = false;
  uvol_tools::InputOptions reading;
  uvol_tools::DensityOptions density;
  uvol_tools::Options options(
      "uvol_convert",
      "in.hdf5 out.ply [options]",
      "Write the points of a file in another format, with the names and types of "
      "their fields.\n"
      "Input: pcd ply csv txt vtk vtp vtu vts vtkhdf las npy npz h5 nc bgeo, "
      "snapshots of Gadget and others\n"
      "(uvol --list-formats). Output: pcd ply vtp vtkhdf csv npz. - is standard "
      "input or output.");
  options.file("in", input);
  options.file("out", output);
  options.group("Input");
  reading.declare(options);
  options.group("Fields");
  density.declare(options);
  options.group("Output");
  options.flag("ascii", ascii, "write PCD and PLY as text");
  uvol_tools::declareSeries(options);
  if (!options.parse(argc, argv))
    return 0;
  const pcl_uvol::LoadOptions load = reading.makeLoadOptions();
  pcl_uvol::checkSavePath(output);
  pcl_uvol::Report report;
  pcl_uvol::Dataset dataset = uvol_tools::loadPoints(
      input, report, load, reading.getWhere(), options.threads());
  density.addField(dataset, options.threads(), report);
  pcl_uvol::SaveOptions save;
  save.ascii = ascii;
  uvol_tools::savePoints(output, dataset, save, report);
  report.count("points", dataset.cloud.width);
  uvol_tools::printReport(options, report, {{"input", input}, {"output", output}});
  return 0;
}

} // namespace

int
main(int argc, char** argv)
{
  return uvol_tools::runSeries("uvol_convert", argc, argv, run);
}
