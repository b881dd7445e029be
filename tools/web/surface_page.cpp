// SPDX-License-Identifier: BSD-3-Clause
#include "web/surface_page.h"

#include "charts/color_bar.h"
#include "charts/drawing.h"
#include "charts/picture_file.h"
#include "io/files.h"
#include "surface/packed_normal.h"
#include "web/surface_page_template.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/io/dataset.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

namespace uvol_tools {

namespace {

using nlohmann::json;

/** As the shader reads it. */
struct PagePoint {
  std::int16_t position[3]; ///< in parts of the radius of the cloud
  std::uint16_t radius;     ///< in parts of the largest one
  std::int8_t normal[4];
  std::uint8_t color[4];
};
static_assert(sizeof(PagePoint) == 16);

template <typename Number>
Number
quantize(float part)
{
  constexpr auto largest = static_cast<float>(std::numeric_limits<Number>::max());
  return static_cast<Number>(std::lround(std::clamp(part, -1.0f, 1.0f) * largest));
}

float
findLargest(const std::vector<float>& radii)
{
  return radii.empty() ? 0.0f : *std::max_element(radii.begin(), radii.end());
}

/** \param radius of the cloud, as its coordinates are */
std::vector<PagePoint>
packPoints(const pcl_uvol::SurfaceCloud& surface, float radius)
{
  const float largest = findLargest(surface.getFootprints());
  std::vector<PagePoint> points(surface.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    PagePoint& point = points[i];
    float normal[3];
    pcl_uvol::unpackNormal(surface.getNormals()[i], normal);
    for (int axis = 0; axis < 3; ++axis) {
      point.position[axis] =
          quantize<std::int16_t>(surface.getCoordinates(axis)[i] / radius);
      point.normal[axis] = quantize<std::int8_t>(normal[axis]);
      point.color[axis] =
          static_cast<std::uint8_t>(surface.getLooks()[i].color >> (8 * axis));
    }
    point.normal[3] = 0;
    point.color[3] = 255;
    point.radius = largest > 0.0f
                       ? quantize<std::uint16_t>(surface.getFootprints()[i] / largest)
                       : std::uint16_t{0};
  }
  return points;
}

json
describeLegend(const SurfacePage& page)
{
  json legend{{"title", page.field}};
  if (!page.categories.empty()) {
    // The highest one above, as on a bar.
    for (auto it = page.categories.rbegin(); it != page.categories.rend(); ++it)
      legend["categories"].push_back({{"text", describeCategory(*it)},
                                      {"color", describeColor(inkOf(it->color))}});
    return legend;
  }
  if (page.field.empty())
    return legend;
  constexpr int steps = 32;
  for (int i = 0; i <= steps; ++i)
    legend["colors"].push_back(describeColor(
        inkOf(colorOnBar(page.map, page.scale, static_cast<double>(i) / steps))));
  constexpr double nearest = 0.05; // two lines of text on a bar of usual height
  const BarLabels labels = labelBar(page.scale, nearest);
  if (!labels.offset.empty())
    legend["title"] = page.field + " (" + labels.offset + ")";
  for (const BarLabel& label : labels.values)
    legend["labels"].push_back({{"text", label.text}, {"place", label.place}});
  return legend;
}

std::array<double, 3>
toArray(const Eigen::Vector3d& vector)
{
  return {vector.x(), vector.y(), vector.z()};
}

std::array<float, 3>
toArray(const pcl_uvol::Color& color)
{
  return {color.r, color.g, color.b};
}

json
describePage(const pcl_uvol::SurfaceCloud& surface,
             const SurfacePage& page,
             float radius)
{
  const pcl_uvol::BoundingSphere& bounds = surface.getBounds();
  const double unit = bounds.radius > 0.0 ? bounds.radius : 1.0;
  const auto place = [&](const Eigen::Vector3d& point) {
    return toArray(Eigen::Vector3d((point - bounds.center) / unit));
  };
  json lights = json::array();
  for (const pcl_uvol::Light& light : page.lights)
    lights.push_back(
        {{"direction", toArray(light.position)}, {"color", toArray(light.color)}});
  const pcl_uvol::Material& material = page.material;
  const pcl_uvol::Color& ground = page.background;
  const bool is_dark = ground.r + ground.g + ground.b < 1.5f;
  return {{"title", page.title},
          {"count", surface.size()},
          {"largest", findLargest(surface.getFootprints()) / radius},
          {"camera",
           {{"eye", place(page.camera.eye)},
            {"at", place(page.camera.at)},
            {"up", toArray(page.camera.up)},
            {"fov", page.camera.vertical_fov}}},
          {"material",
           {material.ambient, material.diffuse, material.specular, material.shininess}},
          {"lights", lights},
          {"background", toArray(ground)},
          {"ink", is_dark ? "white" : "black"},
          {"legend", describeLegend(page)}};
}

} // namespace

void
writeSurfacePage(const std::string& path,
                 const pcl_uvol::SurfaceCloud& surface,
                 const SurfacePage& page)
{
  const double radius = surface.getBounds().radius;
  const auto drawn_radius =
      radius > 0.0
          ? static_cast<float>(radius * pcl_uvol::chooseLengthUnit(surface.getBounds()))
          : 1.0f;
  // "</script>" in a name would end the facts.
  std::string facts = describePage(surface, page, drawn_radius)
                          .dump(-1, ' ', false, json::error_handler_t::replace);
  for (std::size_t at = 0; (at = facts.find("</", at)) != std::string::npos; at += 3)
    facts.replace(at, 2, "<\\/");
  const std::string text = surface_page_template;
  const auto split = [&text](const std::string& mark) { return text.find(mark); };
  const std::string facts_mark = "@FACTS@", points_mark = "@POINTS@";
  const std::size_t first = split(facts_mark), second = split(points_mark);
  pcl_uvol::writeAtomically(path, [&](const std::string& file) {
    const std::vector<PagePoint> points = packPoints(surface, drawn_radius);
    std::ofstream stream(file, std::ios::binary);
    stream << text.substr(0, first) << facts
           << text.substr(first + facts_mark.size(), second - first - facts_mark.size())
           << encodeBase64(points.data(), points.size() * sizeof(PagePoint))
           << text.substr(second + points_mark.size());
    stream.close();
    if (!stream)
      pcl_uvol::io::throwUnwritable(path, pcl_uvol::io::systemError());
  });
}

} // namespace uvol_tools
