// SPDX-License-Identifier: BSD-3-Clause
#include "uvol_isosurface/surface_picture.h"

#include "charts/picture_file.h"

#include <string>

namespace uvol_tools {

namespace {

/** \throws UsageError for what rays do not have */
void
refuseImageSpace(const Options& options)
{
  if (options.given("opacity"))
    throw UsageError("-opacity is for pictures in image space; -raytrace has "
                     "-transparent.");
  if (options.given("occlusion"))
    throw UsageError("-occlusion is for pictures in image space; -raytrace has "
                     "-occlusion-rays.");
  for (const std::string& name : RenderOptions::passNames())
    if (options.given(name))
      throw UsageError("-" + name + " is for pictures in image space, not for rays.");
}

} // namespace

void
SurfacePicture::declare(Options& options)
{
  options.group("Picture");
  options.output("png", "out.png|.svg|.pdf", path_, "draw the isosurface as well")
      .check(checkPicturePath);
  options.flag("raytrace", is_ray_traced_, "draw by ray tracing of splats").rare();
  look_.declareView(options);
  look_.declareExaggeration(options);
  look_.declareFigure(options);
  look_.declareOpacity(options);
  look_.declarePasses(options);
  options.group("Ray tracing", true);
  rays_.declareRays(options);
  rays_.declareSurface(options);
}

void
SurfacePicture::check(const Options& options)
{
  if (is_ray_traced_ && path_.empty())
    throw UsageError("-raytrace needs -png.");
  if (is_ray_traced_)
    refuseImageSpace(options);
  look_.check(options);
  rays_.check(options);
}

void
SurfacePicture::addColorOfSamples(const Options& options,
                                  pcl_uvol::Dataset& samples,
                                  pcl_uvol::Report& report,
                                  const std::array<double, 3>& periodic)
{
  if (isAskedFor())
    look_.addColorOfSamples(options, samples, report, periodic);
}

void
SurfacePicture::addColor(const Options& options,
                         pcl_uvol::Dataset& surface,
                         pcl_uvol::Report& report)
{
  if (isAskedFor() && surface.cloud.width > 0)
    look_.addColor(options, surface, report);
}

bool
SurfacePicture::hasColorOfSamples() const
{
  return isAskedFor() && look_.hasColorOfSamples();
}

std::string
SurfacePicture::draw(const Options& options,
                     const pcl_uvol::Dataset& surface,
                     pcl_uvol::Report& report) const
{
  if (surface.cloud.width == 0) {
    report.warn("nothing_to_draw", {{"path", path_}});
    return "";
  }
  const pcl_uvol::StepTimer timer(report, "picture");
  pcl_uvol::Report drawing;
  drawing.progress = report.progress;
  std::string backend = "ray tracing";
  if (is_ray_traced_)
    report.count("splats", rays_.traceCloud(options, look_, surface, path_, drawing));
  else
    backend = look_.drawCloud(options, surface, path_, drawing);
  for (const auto& [pass, milliseconds] : drawing.milliseconds)
    report.time("picture_" + pass, milliseconds);
  return backend;
}

} // namespace uvol_tools
