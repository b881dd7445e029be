// SPDX-License-Identifier: BSD-3-Clause
#include "charts/figure.h"

#include "charts/view_marks.h"
#include "render/lighting.h"
#include <pcl_uvol/render/color_map.h>

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace uvol_tools {

namespace {

/** Titles have larger letters than values. */
int
titleSize(int letters)
{
  return letters * 4 / 3;
}

int
titleRows(int letters)
{
  return titleSize(letters) * 5 / 2;
}

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

/** Places of a mark in the corners of a view. */
struct Corners {
  Pixel lower_left, lower_right, upper_left, upper_right;

  /** \param margin between the mark and the view's borders, pixels */
  Corners(const PictureCell& cell, const MarkBox& mark, int margin)
  {
    const double left = cell.left + margin - mark.left,
                 right = cell.left + cell.width - 1 - margin - mark.right,
                 top = cell.top + margin - mark.top,
                 bottom = cell.top + cell.height - 1 - margin - mark.bottom;
    lower_left = {left, bottom};
    lower_right = {right, bottom};
    upper_left = {left, top};
    upper_right = {right, top};
  }
};

/** The first of several places where a mark covers least of what is drawn already.
 * \param ground what is behind all */
Pixel
findFreePlace(const pcl_uvol::Image& image,
              const pcl_uvol::Image& ground,
              const MarkBox& mark,
              const std::array<Pixel, 4>& places)
{
  const auto isDrawn = [&](int column, int row) {
    if (column < 0 || row < 0 || column >= static_cast<int>(image.width) ||
        row >= static_cast<int>(image.height))
      return false;
    const auto at = 4 * (std::ptrdiff_t{row} * image.width + column);
    const auto pixel = image.color.begin() + at;
    return !std::equal(pixel, pixel + 4, ground.color.begin() + at);
  };
  Pixel best{};
  int least = std::numeric_limits<int>::max();
  for (const Pixel& place : places) {
    const int column = rounded(place[0]), row = rounded(place[1]);
    int covered = 0;
    for (int y = row + mark.top; y <= row + mark.bottom; ++y)
      for (int x = column + mark.left; x <= column + mark.right; ++x)
        covered += isDrawn(x, y) ? 1 : 0;
    if (covered < least) {
      least = covered;
      best = place;
    }
  }
  return best;
}

pcl::PointCloud<pcl::PointXYZ>
listCorners(const Eigen::AlignedBox3d& box)
{
  pcl::PointCloud<pcl::PointXYZ> corners;
  for (int i = 0; i < 8; ++i) {
    const Eigen::Vector3f corner =
        box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(i)).cast<float>();
    corners.push_back({corner.x(), corner.y(), corner.z()});
  }
  return corners;
}

/** The discs of a subject as a camera sees them that sees all of it. */
std::vector<pcl_uvol::FittedDisc>
findDiscs(const Subject& subject, const PictureCell& cell)
{
  if (!subject.find_discs)
    return {};
  pcl_uvol::CameraChoice choice;
  const double aspect = static_cast<double>(cell.width) / cell.height;
  return subject.find_discs(
      chooseCamera(choice, {subject.bounds, &subject.cloud}, {}, aspect), cell);
}

/** What marks show: the box around the points that cameras are fitted to. */
Eigen::AlignedBox3d
findBox(const Subject& subject, const PictureCell& cell)
{
  if (subject.box)
    return *subject.box;
  const std::vector<pcl_uvol::FittedDisc> discs = findDiscs(subject, cell);
  const Eigen::AlignedBox3d box = boxAround(subject.cloud, [&discs](std::size_t i) {
    return discs.empty() || !std::isnan(discs[i].radius);
  });
  return box.isEmpty() ? boxAround(subject.cloud) : box;
}

} // namespace

Eigen::AlignedBox3d
boxAround(const pcl_uvol::CloudView& cloud,
          const std::function<bool(std::size_t point)>& counts)
{
  Eigen::AlignedBox3d box;
  for (std::size_t i = 0; i < cloud.count; ++i) {
    const Eigen::Vector3f point = Eigen::Map<const Eigen::Vector3f>(cloud.xyz(i));
    if (point.allFinite() && (!counts || counts(i)))
      box.extend(point.cast<double>());
  }
  return box;
}

pcl_uvol::Camera
findCameraOf(const Subject& subject,
             const PictureCell& cell,
             const FindCamera& find_camera)
{
  if (!subject.box) {
    pcl_uvol::SeenSurface seen{subject.bounds, &subject.cloud};
    if (subject.find_discs)
      seen.find_discs = [&](const pcl_uvol::Camera& camera) {
        return subject.find_discs(camera, cell);
      };
    return find_camera(seen, cell);
  }
  const auto corners = listCorners(*subject.box);
  const pcl_uvol::CloudView box = pcl_uvol::viewOf(corners);
  return find_camera(
      {{subject.box->center(), 0.5 * subject.box->diagonal().norm()}, &box}, cell);
}

bool
Figure::fits(int width, int height) const
{
  constexpr int least = 16;
  const PictureCell first = layOut(width, height)[0];
  return std::min(first.width, first.height) >= least ||
         (views.empty() && title.empty());
}

double
Figure::getFill(const PictureCell& cell) const
{
  constexpr double usual = 0.9, least = 0.4, letters = 11.0; // of values on both sides
  if (!has_ticks)
    return usual;
  const double side = std::min(cell.width, cell.height);
  return std::clamp(
      1.0 - letters * letterSize(cell.height, least_letters) / side, least, usual);
}

pcl_uvol::Background
Figure::getBackgroundOfViews(pcl_uvol::Background background) const
{
  if (drawsMarks())
    background.kind = pcl_uvol::Background::Kind::Transparent;
  return background;
}

std::vector<PictureCell>
Figure::layOut(int width, int height) const
{
  const int top = title.empty() ? 0 : titleRows(letterSize(height, least_letters));
  const int count = std::max(1, static_cast<int>(views.size()));
  // As many columns as leave the largest square for each view.
  int columns = 1, largest = 0;
  for (int across = 1; across <= count; ++across) {
    const int down = (count + across - 1) / across;
    const int side = std::min(width / across, (height - top) / down);
    if (side > largest) {
      largest = side;
      columns = across;
    }
  }
  const int rows = (count + columns - 1) / columns;
  std::vector<PictureCell> cells;
  for (int i = 0; i < count; ++i) {
    const int column = i % columns, row = i / columns;
    const auto split = [](int length, int part, int parts) {
      return length * part / parts;
    };
    const int left = split(width, column, columns),
              above = top + split(height - top, row, rows);
    cells.push_back({left,
                     above,
                     split(width, column + 1, columns) - left,
                     top + split(height - top, row + 1, rows) - above,
                     views.empty() ? "" : views[static_cast<std::size_t>(i)]});
  }
  return cells;
}

void
Figure::drawBehind(pcl_uvol::Image& image,
                   const PictureCell& cell,
                   const pcl_uvol::Camera& camera,
                   const DataBox& box) const
{
  const Perspective perspective(camera, cell.width, cell.height, cell.left, cell.top);
  const int font = letterSize(cell.height, least_letters);
  const MarkStyle style{font, inkOn(image)};
  if (showsBox())
    drawBoxBehind(image, perspective, box, style, has_ticks);
  if (views.size() > 1)
    writeText(image,
              cell.view,
              font,
              cell.left + font,
              cell.top + 3 * font / 2,
              TextAnchor::Left,
              style.ink);
}

void
Figure::drawBefore(pcl_uvol::Image& image,
                   const pcl_uvol::Image& ground,
                   const PictureCell& cell,
                   const pcl_uvol::Camera& camera,
                   const DataBox& box) const
{
  const Perspective perspective(camera, cell.width, cell.height, cell.left, cell.top);
  const int font = letterSize(cell.height, least_letters);
  const MarkStyle style{font, inkOn(image)};
  if (has_box)
    drawBoxBefore(image, perspective, box, style);
  const double length = std::min(3.0 * font, 0.12 * std::min(cell.width, cell.height));
  if (has_scale_bar) {
    constexpr double longest = 0.25; // of the view's width
    const double distance = perspective.seenFromEye(box.box.center()).z();
    const ScaleBar bar(perspective.pixelsOf(box.factors.x(), distance),
                       longest * cell.width,
                       box.unit);
    const MarkBox mark = findScaleBarBox(bar, font);
    const Corners at(cell, mark, font);
    drawScaleBar(
        image,
        findFreePlace(image,
                      ground,
                      mark,
                      {at.lower_right, at.lower_left, at.upper_right, at.upper_left}),
        bar,
        style);
  }
  if (has_triad) {
    const MarkBox mark = findTriadBox(perspective, length, font);
    const Corners at(cell, mark, font / 2);
    drawTriad(
        image,
        perspective,
        findFreePlace(image,
                      ground,
                      mark,
                      {at.lower_left, at.upper_left, at.upper_right, at.lower_right}),
        length,
        style);
  }
}

pcl_uvol::Image
Figure::drawViews(const Subject& subject,
                  const Ground& ground,
                  const FindCamera& find_camera,
                  const DrawView& draw) const
{
  const pcl_uvol::Image empty =
      makeGround(ground.background, ground.width, ground.height);
  pcl_uvol::Image picture = empty, image;
  DataBox box{{}, Eigen::Vector3d(subject.origin.data()), ground.factors, unit};
  const std::vector<PictureCell> cells = layOut(ground.views_width, ground.height);
  if (drawsMarks())
    box.box = findBox(subject, cells[0]);
  Subject seen = subject;
  if (showsBox())
    seen.box = box.box;
  for (const PictureCell& cell : cells) {
    const pcl_uvol::Camera camera = findCameraOf(seen, cell, find_camera);
    draw(camera, cell, image);
    if (drawsMarks()) {
      drawBehind(picture, cell, camera, box);
      layOver(image, cell, picture);
      drawBefore(picture, empty, cell, camera, box);
    }
    else
      place(image, cell, picture);
  }
  return picture;
}

void
Figure::drawTitle(pcl_uvol::Image& image) const
{
  if (title.empty())
    return;
  const int letters = letterSize(static_cast<int>(image.height), least_letters);
  writeText(image,
            title,
            titleSize(letters),
            static_cast<int>(image.width) / 2,
            titleRows(letters) / 2,
            TextAnchor::Center,
            inkOn(image));
}

} // namespace uvol_tools
