// SPDX-License-Identifier: BSD-3-Clause
// Pictures of a surface, from views, legend and marks.
#include "charts/color_bar.h"
#include "common/records.h"
#include "render/lighting.h"
#include "shared/view_options.h"
#include <pcl_uvol/io/image_file.h>

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <algorithm>
#include <filesystem>
#include <iomanip>
#include <sstream>

namespace uvol_tools {

namespace {

/** A picture of nothing. */
pcl_uvol::Image
makeGround(const pcl_uvol::Background& background, int width, int height)
{
  pcl_uvol::Image image;
  image.width = static_cast<std::uint32_t>(width);
  image.height = static_cast<std::uint32_t>(height);
  image.color.resize(4 * image.pixels());
  for (std::uint32_t row = 0; row < image.height; ++row) {
    const float below =
        (static_cast<float>(row) + 0.5f) / static_cast<float>(image.height);
    const pcl_uvol::Rgba color =
        background.kind == pcl_uvol::Background::Kind::Transparent
            ? 0
            : pcl_uvol::toRgba(pcl_uvol::backgroundAt(background, below));
    for (std::uint32_t k = 0; k < 4 * image.width; ++k)
      image.color[4 * std::size_t{image.width} * row + k] =
          static_cast<std::uint8_t>(color >> (8 * (k % 4)));
  }
  return image;
}

/** Put a view into its place. */
void
place(const pcl_uvol::Image& view, const PictureCell& cell, pcl_uvol::Image& picture)
{
  for (std::uint32_t row = 0; row < view.height; ++row)
    std::copy_n(view.color.begin() + std::ptrdiff_t{4} * row * view.width,
                4 * view.width,
                picture.color.begin() +
                    std::ptrdiff_t{4} *
                        ((row + cell.top) * std::ptrdiff_t{picture.width} + cell.left));
}

/** Lay a view over what is in its place. */
void
layOver(const pcl_uvol::Image& view, const PictureCell& cell, pcl_uvol::Image& picture)
{
  for (std::uint32_t row = 0; row < view.height; ++row)
    for (std::uint32_t column = 0; column < view.width; ++column) {
      const std::uint8_t* const pixel =
          &view.color[4 * (std::size_t{row} * view.width + column)];
      if (pixel[3] > 0)
        blend(picture,
              cell.left + static_cast<int>(column),
              cell.top + static_cast<int>(row),
              {pixel[0], pixel[1], pixel[2]},
              pixel[3] / 255.0);
    }
}

Eigen::AlignedBox3d
boxAround(const pcl_uvol::CloudView& cloud)
{
  Eigen::AlignedBox3d box;
  for (std::size_t i = 0; i < cloud.count; ++i) {
    const Eigen::Vector3f point = Eigen::Map<const Eigen::Vector3f>(cloud.xyz(i));
    if (point.allFinite())
      box.extend(point.cast<double>());
  }
  return box;
}

pcl::PointCloud<pcl::PointXYZ>
cornersOf(const Eigen::AlignedBox3d& box)
{
  pcl::PointCloud<pcl::PointXYZ> corners;
  for (int i = 0; i < 8; ++i) {
    const Eigen::Vector3f corner =
        box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(i)).cast<float>();
    corners.push_back({corner.x(), corner.y(), corner.z()});
  }
  return corners;
}

/** The isovalues of a surface that has some, but not so many that they are a field. */
void
addIsovalues(const pcl_uvol::CloudView& cloud, std::vector<pcl_uvol::ImageText>& texts)
{
  constexpr const char* field = "isovalue";
  if (std::none_of(cloud.fields.begin(), cloud.fields.end(), [&](const auto& known) {
        return known.name == field;
      }))
    return;
  std::ostringstream text;
  text << std::setprecision(7); // isovalues of a cloud are floats
  for (const double value : pcl_uvol::listCategories(cloud, field, most_categories))
    text << (text.tellp() > 0 ? ", " : "") << value;
  if (text.tellp() > 0)
    texts.emplace_back("Isovalue", text.str());
}

} // namespace

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
  const std::filesystem::path path(output);
  std::ostringstream name;
  name << path.stem().string() << '_'
       << std::setw(static_cast<int>(std::to_string(frames_ - 1).size()))
       << std::setfill('0') << frame << path.extension().string();
  return (path.parent_path() / name.str()).string();
}

bool
ViewOptions::drawsBar(const pcl_uvol::CloudView& cloud) const
{
  const std::string field = colorField(cloud);
  if (!has_bar_ || field.empty() || field == "rgb" || field == "rgba")
    return false;
  return !pcl_uvol::findLabels(cloud.fields, labels_, field) ||
         !pcl_uvol::listCategories(cloud, field, most_categories).empty();
}

int
ViewOptions::viewsWidth(const pcl_uvol::CloudView& cloud) const
{
  return drawsBar(cloud) ? width_ - uvol_tools::colorBarWidth(width_, height_) : width_;
}

std::vector<pcl_uvol::CategoryColor>
ViewOptions::listCategories(const pcl_uvol::CloudView& cloud,
                            const std::string& field,
                            const pcl_uvol::ColorMapping& mapping) const
{
  return listNamedCategories(cloud, labels_, field, mapping.map);
}

void
ViewOptions::drawLegend(const pcl_uvol::CloudView& cloud,
                        const std::array<double, 2>& range,
                        pcl_uvol::Image& image) const
{
  if (!drawsBar(cloud))
    return;
  const std::string field = colorField(cloud);
  const pcl_uvol::ColorMapping mapping = colorMapping(cloud);
  const auto categories = listCategories(cloud, field, mapping);
  if (categories.empty())
    drawColorBar(
        image, mapping.map, {range[0], range[1], mapping.is_logarithmic}, field);
  else
    drawCategories(image, categories, field);
}

pcl_uvol::Background
ViewOptions::getBackgroundOfViews() const
{
  pcl_uvol::Background background = background_;
  if (figure_.drawsMarks())
    background.kind = pcl_uvol::Background::Kind::Transparent;
  return background;
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

Eigen::AlignedBox3d
ViewOptions::findBox(const Subject& surface) const
{
  if (!shared_)
    return boxAround(surface.cloud);
  Eigen::AlignedBox3d box = shared_->box;
  return box.translate(-Eigen::Vector3d(surface.origin.data()));
}

pcl_uvol::Camera
ViewOptions::cameraOfCell(const Subject& surface, const PictureCell& cell) const
{
  if (!figure_.hasBox() && !shared_)
    return makeCamera(surface.bounds, surface.origin, cell, &surface.cloud);
  const Eigen::AlignedBox3d box = findBox(surface);
  const auto corners = cornersOf(box);
  const pcl_uvol::CloudView view = pcl_uvol::viewOf(corners);
  return makeCamera(
      {box.center(), 0.5 * box.diagonal().norm()}, surface.origin, cell, &view);
}

pcl_uvol::Image
ViewOptions::drawFrame(const Subject& surface,
                       std::uint64_t frame,
                       const DrawView& draw,
                       std::vector<pcl_uvol::ImageText>& texts) const
{
  pcl_uvol::Image picture = makeGround(background_, width_, height_), image;
  const Eigen::Vector3d origin(surface.origin.data());
  DataBox box{{}, origin, Eigen::Vector3d::Ones(), figure_.getUnit()};
  if (figure_.drawsMarks())
    box.box = findBox(surface);
  if (isExaggerated())
    box.factors = Eigen::Vector3d(exaggeration_.data());
  for (const PictureCell& cell : figure_.layOut(viewsWidth(surface.cloud), height_)) {
    const pcl_uvol::Camera camera = turned(cameraOfCell(surface, cell), frame);
    texts.emplace_back("Camera", describeCamera(camera, box));
    draw(camera, cell, image);
    if (figure_.drawsMarks()) {
      figure_.drawBehind(picture, cell, camera, box);
      layOver(image, cell, picture);
      figure_.drawBefore(picture, cell, camera, box);
    }
    else
      place(image, cell, picture);
  }
  return picture;
}

void
ViewOptions::drawFrames(const Options& options,
                        const Subject& surface,
                        const DrawView& draw,
                        const FindRange& range,
                        const std::string& output,
                        pcl_uvol::Report& report) const
{
  for (std::uint64_t frame = 0; frame < countFrames(); ++frame) {
    std::vector<pcl_uvol::ImageText> texts = describeOrigin(options);
    addIsovalues(surface.cloud, texts);
    pcl_uvol::Image picture = drawFrame(surface, frame, draw, texts);
    drawLegend(surface.cloud, range(), picture);
    figure_.drawTitle(picture);
    const pcl_uvol::StepTimer timer(report, "write");
    pcl_uvol::savePng(frameName(output, frame), picture, texts);
  }
}

} // namespace uvol_tools
