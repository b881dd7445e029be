// SPDX-License-Identifier: BSD-3-Clause
// Pictures of a surface, from views, legend and marks.
#include "charts/color_bar.h"
#include "charts/picture_file.h"
#include "shared/view_options.h"

#include <algorithm>
#include <filesystem>
#include <iomanip>
#include <sstream>

namespace uvol_tools {

void
addIsovalues(const std::vector<double>& isovalues,
             std::vector<pcl_uvol::ImageText>& texts)
{
  std::ostringstream text;
  text << std::setprecision(7); // isovalues of a cloud are floats
  for (const double value : isovalues)
    text << (text.tellp() > 0 ? ", " : "") << value;
  if (!isovalues.empty())
    texts.emplace_back("Isovalue", text.str());
}

std::string
describeCamera(const pcl_uvol::Camera& camera, const DataBox& data)
{
  std::ostringstream text;
  text << std::setprecision(9);
  const auto write = [&text](const char* option, const Eigen::Vector3d& v) {
    text << option << v.x() << ',' << v.y() << ',' << v.z();
  };
  const auto inData = [&data](const Eigen::Vector3d& place) -> Eigen::Vector3d {
    return (place + data.origin).cwiseQuotient(data.factors);
  };
  write("-eye ", inData(camera.eye));
  write(" -at ", inData(camera.at));
  write(" -up ", camera.up);
  text << " -fov " << camera.vertical_fov;
  return text.str();
}

std::string
ViewOptions::frameName(const std::string& output, std::uint64_t frame) const
{
  if (frames_ == 1)
    return output;
  return numberedPath(output, frame, std::to_string(frames_ - 1).size());
}

bool
ViewOptions::drawsBar(const pcl_uvol::CloudView& cloud) const
{
  return has_bar_ && hasLegend(cloud, labels_, colorField(cloud));
}

int
ViewOptions::viewsWidth(const pcl_uvol::CloudView& cloud) const
{
  return drawsBar(cloud)
             ? getWidth() - uvol_tools::colorBarWidth(
                                getWidth(), getHeight(), figure_.get().least_letters)
             : getWidth();
}

void
SharedView::extendRange(const pcl_uvol::ColorScale& scale)
{
  if (!range)
    range = {scale.low, scale.high};
  range = {std::min((*range)[0], scale.low), std::max((*range)[1], scale.high)};
}

void
ViewOptions::addTo(SharedView& shared, const pcl_uvol::Dataset& surface) const
{
  const pcl_uvol::CloudView cloud = pcl_uvol::viewOf(surface.cloud);
  shared.box.extend(boxAround(cloud).translate(Eigen::Vector3d(surface.origin.data())));
  const std::string field = colorField(cloud);
  if (field.empty() || field == "rgb" || field == "rgba")
    return;
  const pcl_uvol::ColorMapping mapping = mapColors(cloud, field);
  shared.extendRange(findColorScale(cloud, field, mapping));
  shared.are_categories = shared.are_categories && mapping.map.isCategorical();
}

Subject
ViewOptions::withSharedBox(Subject surface) const
{
  if (shared_) {
    surface.box = shared_->box;
    surface.box->translate(-Eigen::Vector3d(surface.origin.data()));
  }
  return surface;
}

pcl_uvol::Image
ViewOptions::drawFrame(const Subject& surface,
                       std::uint64_t frame,
                       const Figure::DrawView& draw,
                       std::vector<pcl_uvol::ImageText>& texts) const
{
  const Ground ground{background_,
                      getWidth(),
                      getHeight(),
                      viewsWidth(surface.cloud),
                      getFactors(),
                      frames_ > 1,
                      zoom_};
  const DataBox data{{}, Eigen::Vector3d(surface.origin.data()), ground.factors, ""};
  const auto findCamera = [&](const pcl_uvol::SeenSurface& seen,
                              const PictureCell& cell) {
    return makeCamera(seen, surface.origin, cell, frame);
  };
  const auto drawAndDescribe = [&](const pcl_uvol::Camera& camera,
                                   const PictureCell& cell,
                                   pcl_uvol::Image& image) {
    texts.emplace_back("Camera", describeCamera(camera, data));
    draw(camera, cell, image);
  };
  return figure_.get().drawViews(
      withSharedBox(surface), ground, findCamera, drawAndDescribe);
}

void
ViewOptions::drawFrames(const Options& options,
                        const Subject& surface,
                        const Figure::DrawView& draw,
                        const FindRange& range,
                        const std::string& output,
                        pcl_uvol::Report& report) const
{
  for (std::uint64_t frame = 0; frame < countFrames(); ++frame) {
    std::vector<pcl_uvol::ImageText> texts = describeOrigin(options);
    addIsovalues(pcl_uvol::listIsovalues(surface.cloud), texts);
    const PictureFile file(frameName(output, frame), getDotsPerInch());
    pcl_uvol::Image picture = drawFrame(surface, frame, draw, texts);
    if (drawsBar(surface.cloud))
      drawLegend(picture,
                 surface.cloud,
                 labels_,
                 colorField(surface.cloud),
                 colorMapping(surface.cloud),
                 range(),
                 colors_.getLabel(colorField(surface.cloud)),
                 figure_.get().least_letters);
    figure_.get().drawTitle(picture);
    const pcl_uvol::StepTimer timer(report, "write");
    file.save(picture, texts);
  }
}

} // namespace uvol_tools
