// SPDX-License-Identifier: BSD-3-Clause
#include "charts/scatter_plot.h"

#include "charts/drawing.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/render/renderer.h>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>

namespace uvol_tools {

using pcl_uvol::BoundingSphere;
using pcl_uvol::Camera;
using pcl_uvol::Image;
using pcl_uvol::InvalidArgument;

namespace {

constexpr double field_of_view = 30.0; // degrees
constexpr int largest_size = 16384;
constexpr std::size_t most_names = 12; // of the legend

constexpr Ink gray{190, 190, 190}, noise{175, 175, 175};
constexpr Ink inks[] = {{31, 119, 180},
                        {255, 127, 14},
                        {44, 160, 44},
                        {214, 39, 40},
                        {148, 103, 189},
                        {140, 86, 75},
                        {227, 119, 194},
                        {188, 189, 34},
                        {23, 190, 207}};

const Ink&
inkOfLabel(std::int32_t label)
{
  return label < 0 ? noise : inks[static_cast<std::size_t>(label) % std::size(inks)];
}

bool
isFinite(const std::array<float, 3>& point)
{
  return std::isfinite(point[0]) && std::isfinite(point[1]) && std::isfinite(point[2]);
}

double
findQuantile(std::vector<double>& values, double part)
{
  // The outermost ones count where there are few values.
  const double place = part * static_cast<double>(values.size() - 1);
  const auto at =
      values.begin() +
      static_cast<std::ptrdiff_t>(part < 0.5 ? std::floor(place) : std::ceil(place));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

/** A ball about most points: a few far ones shall not make the others a dot. */
BoundingSphere
findMiddle(const std::vector<std::array<float, 3>>& points)
{
  constexpr double most = 0.99;
  std::vector<Eigen::Vector3d> finite;
  for (const auto& point : points)
    if (isFinite(point))
      finite.emplace_back(point[0], point[1], point[2]);
  if (finite.empty())
    return {Eigen::Vector3d::Zero(), 1.0};
  BoundingSphere ball{Eigen::Vector3d::Zero(), 1.0};
  std::vector<double> values(finite.size());
  for (int axis = 0; axis < 3; ++axis) {
    std::transform(finite.begin(),
                   finite.end(),
                   values.begin(),
                   [&](const auto& point) { return point[axis]; });
    ball.center[axis] =
        0.5 * (findQuantile(values, 1.0 - most) + findQuantile(values, most));
  }
  std::transform(finite.begin(), finite.end(), values.begin(), [&](const auto& point) {
    return (point - ball.center).norm();
  });
  const double radius = findQuantile(values, most);
  if (radius > 0.0)
    ball.radius = radius;
  return ball;
}

/** From places to pixels. */
class Screen {
public:
  Screen(const Camera& camera, int width, int height)
      : eye_(camera.eye)
      , axes_(camera.rotation())
      , center_(0.5 * width, 0.5 * height)
      , scale_(0.5 * height / std::tan(camera.vertical_fov * M_PI / 360.0))
  {
  }

  /** Column, row and distance. */
  Eigen::Vector3d
  operator()(const Eigen::Vector3d& place) const
  {
    const Eigen::Vector3d seen = axes_ * (place - eye_);
    return {center_.x() + scale_ * seen.x() / seen.z(),
            center_.y() + scale_ * seen.y() / seen.z(),
            seen.z()};
  }

private:
  Eigen::Vector3d eye_;
  Eigen::Matrix3d axes_;
  Eigen::Vector2d center_;
  double scale_;
};

void
drawDots(const std::vector<std::array<float, 3>>& points,
         const std::vector<std::int32_t>& labels,
         const Screen& screen,
         int dot_radius,
         Image& image)
{
  struct Dot {
    double distance;
    int column, row;
    std::size_t point;
  };
  std::vector<Dot> dots;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (isFinite(points[i])) {
      const Eigen::Vector3d seen =
          screen(Eigen::Map<const Eigen::Vector3f>(points[i].data()).cast<double>());
      constexpr double far_off = 1e6; // pixels
      if (!(seen.z() > 0.0 && std::abs(seen.x()) < far_off &&
            std::abs(seen.y()) < far_off))
        continue;
      dots.push_back({seen.z(),
                      static_cast<int>(std::lround(seen.x())),
                      static_cast<int>(std::lround(seen.y())),
                      i});
    }
  std::sort(dots.begin(), dots.end(), [](const Dot& a, const Dot& b) {
    return a.distance != b.distance ? a.distance > b.distance : a.point < b.point;
  });
  for (const Dot& dot : dots) {
    const Ink& ink = labels.empty() ? inks[0] : inkOfLabel(labels[dot.point]);
    for (int dy = -dot_radius; dy <= dot_radius; ++dy)
      for (int dx = -dot_radius; dx <= dot_radius; ++dx) {
        const double beyond = std::hypot(dx, dy) - dot_radius;
        if (beyond < 0.5)
          blend(image, dot.column + dx, dot.row + dy, ink, beyond <= 0.0 ? 1.0 : 0.4);
      }
  }
}

void
drawAxes(const std::vector<ScatterAxis>& axes,
         double radius,
         const Screen& screen,
         int font,
         Image& image)
{
  const double line_width = 3 * font / 28.0;
  double longest = 0.0;
  for (const ScatterAxis& axis : axes)
    longest = std::max(longest,
                       Eigen::Map<const Eigen::Vector3d>(axis.direction.data()).norm());
  if (longest == 0.0)
    return;
  const Eigen::Vector3d start = screen(Eigen::Vector3d::Zero());
  for (const ScatterAxis& axis : axes) {
    const Eigen::Vector3d tip =
        radius / longest * Eigen::Map<const Eigen::Vector3d>(axis.direction.data());
    const Eigen::Vector3d end = screen(tip);
    drawLine(image, start.x(), start.y(), end.x(), end.y(), line_width, black);
    const bool is_left = end.x() < start.x();
    writeText(image,
              axis.name,
              font,
              static_cast<int>(std::lround(end.x())) + (is_left ? -2 : 2) * font / 7,
              static_cast<int>(std::lround(end.y())),
              is_left ? TextAnchor::Right : TextAnchor::Left,
              black);
  }
}

/** Colours of the clusters, the first ones. */
void
drawLegend(const std::vector<std::int32_t>& labels, int font, Image& image)
{
  std::vector<std::int32_t> known = labels;
  std::sort(known.begin(), known.end());
  known.erase(std::unique(known.begin(), known.end()), known.end());
  for (std::size_t i = 0; i < std::min(known.size(), most_names); ++i)
    writeText(image,
              known[i] < 0 ? "noise" : "cluster " + std::to_string(known[i]),
              font,
              font,
              font + static_cast<int>(i) * (9 * font / 7),
              TextAnchor::Left,
              known[i] < 0 ? gray : inkOfLabel(known[i]));
}

} // namespace

Image
drawScatterPlot(const std::vector<std::array<float, 3>>& points,
                const std::vector<std::int32_t>& labels,
                const std::vector<ScatterAxis>& axes,
                const std::string& view,
                const Paper& asked)
{
  constexpr Paper usual{640, 512};
  const Paper paper = asked.orUsual(usual);
  const int width = paper.width, height = paper.height;
  if (width < 1 || height < 1 || width > largest_size || height > largest_size)
    throw InvalidArgument("bad_chart_size", {{"most", largest_size}});
  if (!labels.empty() && labels.size() != points.size())
    throw InvalidArgument("labels_unlike_points",
                          {{"labels", labels.size()}, {"points", points.size()}});
  BoundingSphere ball = findMiddle(points);
  const double radius = ball.radius;
  ball.radius *= 1.1; // room for names
  const Camera camera =
      Camera::fit(ball, view, field_of_view, static_cast<double>(width) / height);
  Image image;
  image.width = static_cast<std::uint32_t>(width);
  image.height = static_cast<std::uint32_t>(height);
  image.color.assign(4 * image.pixels(), 255);
  const Screen screen(camera, width, height);
  const int font = paper.chartLetters(usual);
  drawDots(points, labels, screen, std::max(1, font / 14), image);
  drawAxes(axes, radius, screen, font, image);
  drawLegend(labels, font, image);
  return image;
}

} // namespace uvol_tools
