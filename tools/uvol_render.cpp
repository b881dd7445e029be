// SPDX-License-Identifier: BSD-3-Clause
// A picture of a surface given as points (thesis 4.3).
#include "common/point_files.h"
#include "common/render_options.h"
#include <pcl_uvol/io/dataset.h>
#include <pcl_uvol/io/image_file.h>

namespace {

using pcl_uvol::Report;
using pcl_uvol::StepTimer;

int
run(int argc, char** argv)
{
  std::string input, output;
  uvol_tools::RenderOptions look;
  uvol_tools::Options options(
      "uvol_render",
      "in.ply out.png [options]",
      "Draws a surface given as points with normals: lit, smooth and without holes.");
  options.file("in", input);
  options.file("out", output);
  look.declareView(options);
  look.declareOrbit(options);
  look.declarePasses(options);
  if (!options.parse(argc, argv))
    return 0;
  look.check(options);
  pcl_uvol::checkPngPath(output);

  Report report;
  const pcl_uvol::Dataset dataset = uvol_tools::loadPoints(input, report);
  const pcl_uvol::CloudView cloud = pcl_uvol::viewOf(dataset.cloud);
  pcl_uvol::ImageSpaceRenderer<pcl::PCLPointCloud2> renderer;
  renderer.setInputCloud(
      pcl::PCLPointCloud2::ConstPtr(&dataset.cloud, [](const void*) {}));
  look.configure(options, cloud, renderer);
  const pcl_uvol::Camera camera = look.makeCamera(renderer.getBounds(), dataset.origin);
  pcl_uvol::Image image;
  Report drawing;
  for (std::uint64_t frame = 0; frame < look.countFrames(); ++frame) {
    renderer.setCamera(look.turned(camera, frame));
    renderer.render(image);
    drawing = renderer.getReport();
    look.decorate(cloud, renderer.getColorRange(), image);
    const StepTimer timer(report, "write");
    pcl_uvol::savePng(look.frameName(output, frame), image);
  }
  report.merge(drawing);
  uvol_tools::printReport(
      options,
      report,
      {{"input", input}, {"output", output}, {"backend", renderer.describeBackend()}});
  return 0;
}

} // namespace

int
main(int argc, char** argv)
{
  return uvol_tools::runTool("uvol_render", [&] { return run(argc, argv); });
}
