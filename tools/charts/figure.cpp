// SPDX-License-Identifier: BSD-3-Clause
#include "charts/figure.h"

#include "charts/ground.h"
#include "charts/text_wrap.h"
#include "charts/view_marks.h"
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
titleRows(int letters, std::size_t lines)
{
  return titleSize(letters) * 5 / 2 +
         rounded(line_distance * titleSize(letters) * static_cast<double>(lines - 1));
}

Perspective
look(const pcl_uvol::Camera& camera, const PictureCell& cell)
{
  return {camera, cell.width, cell.height, cell.left, cell.top};
}

/** Of an axis of a triad that lies across the line of sight, pixels. */
double
triadLength(const PictureCell& cell, int font)
{
  return std::min(3.0 * font, 0.12 * std::min(cell.width, cell.height));
}

/** Less of a cell so that what reaches beyond its borders has room. */
pcl_uvol::ImageFill
shrink(const pcl_uvol::ImageFill& fill,
       const PictureCell& cell,
       const Eigen::Vector2d& before,
       const Eigen::Vector2d& behind)
{
  constexpr double least = 0.3;
  const auto part = [&](double whole, double beyond, int side) {
    return std::max(whole - 2.0 * std::max(beyond, 0.0) / side, std::min(whole, least));
  };
  return {part(fill.left, before.x(), cell.width),
          part(fill.right, behind.x(), cell.width),
          part(fill.top, before.y(), cell.height),
          part(fill.bottom, behind.y(), cell.height)};
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

/** Calls with the pixels of an image that a mark at a place covers, at the number of
 * their first byte. */
template <typename Function>
void
forPixelsBelow(const pcl_uvol::Image& image,
               const MarkBox& mark,
               const Pixel& place,
               const Function& call)
{
  const int column = rounded(place[0]), row = rounded(place[1]);
  const int left = std::max(column + mark.left, 0), top = std::max(row + mark.top, 0);
  const int right = std::min(column + mark.right, static_cast<int>(image.width) - 1),
            bottom = std::min(row + mark.bottom, static_cast<int>(image.height) - 1);
  for (int y = top; y <= bottom; ++y)
    for (int x = left; x <= right; ++x)
      call(4 *
           (static_cast<std::size_t>(y) * image.width + static_cast<std::size_t>(x)));
}

/** Make what a mark would cover paler, so that it can be told from that. */
void
fadeBelow(pcl_uvol::Image& image,
          const pcl_uvol::Image& ground,
          const MarkBox& mark,
          const Pixel& place)
{
  constexpr double part = 0.75;
  forPixelsBelow(image, mark, place, [&](std::size_t at) {
    std::uint8_t* const pixel = &image.color[at];
    const std::uint8_t* const behind = &ground.color[at];
    const double own = (1.0 - part) * pixel[3], other = part * behind[3],
                 sum = own + other;
    for (std::size_t k = 0; k < 3 && sum > 0.0; ++k)
      pixel[k] = static_cast<std::uint8_t>(
          std::lround((own * pixel[k] + other * behind[k]) / sum));
    pixel[3] = static_cast<std::uint8_t>(std::lround(sum));
  });
}

/** The first of several places where a mark covers least of what is drawn already.
 * \param ground what is behind all */
Pixel
findFreePlace(const pcl_uvol::Image& image,
              const pcl_uvol::Image& ground,
              const MarkBox& mark,
              const std::array<Pixel, 4>& places)
{
  Pixel best{};
  int least = std::numeric_limits<int>::max();
  for (const Pixel& place : places) {
    int covered = 0;
    forPixelsBelow(image, mark, place, [&](std::size_t at) {
      covered +=
          std::equal(&image.color[at], &image.color[at] + 4, &ground.color[at]) ? 0 : 1;
    });
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
  const PictureCell first = layOut(width, height, width)[0];
  return std::min(first.width, first.height) >= least ||
         (views.empty() && title.empty());
}

MarkStyle
Figure::styleOf(const PictureCell& cell, const pcl_uvol::Image& ground) const
{
  return {letterSize(cell.height, least_letters), inkOn(ground)};
}

Eigen::AlignedBox2d
Figure::findFreePart(const PictureCell& cell, int font) const
{
  constexpr double margin = 0.5, view_name = 2.2, scale_bar = 3.4; // sizes of letters
  const double above = views.size() > 1 ? view_name * font : margin * font;
  const double triad = has_triad ? triadLength(cell, font) + 2.0 * font : 0.0,
               bar = has_scale_bar ? scale_bar * font : 0.0;
  return {Eigen::Vector2d(margin * font, above),
          Eigen::Vector2d(cell.width - margin * font,
                          cell.height - std::max({margin * font, triad, bar}))};
}

pcl_uvol::ImageFill
Figure::findFill(const Subject& seen,
                 const PictureCell& cell,
                 const FindCamera& find_camera,
                 const DataBox& box,
                 const Ground& ground) const
{
  if (!has_ticks)
    return cell.fill;
  const MarkStyle style{letterSize(cell.height, least_letters), {}};
  const Eigen::AlignedBox2d free = findFreePart(cell, style.font);
  if (ground.turns) {
    const auto [beside, below] = findRoomAround(box, style);
    const Eigen::Vector2d room(beside, below), size(cell.width, cell.height);
    return shrink({1.0}, cell, room + free.min(), room + size - free.max());
  }
  // The less of a cell is filled, the less reaches beyond it: after a few rounds
  // nothing.
  constexpr int rounds = 6;
  constexpr double slack = 0.5;
  const Eigen::Vector2d corner(cell.left, cell.top);
  PictureCell room = cell;
  for (int round = 0; round < rounds; ++round) {
    const Perspective perspective =
        look(zoomed(findCameraOf(seen, room, find_camera), 1.0 / ground.zoom), room);
    const Eigen::AlignedBox2d letters =
        boxAroundLetters(SeenBox(perspective, box), style);
    if (letters.isEmpty())
      break;
    const Eigen::Vector2d before = free.min() + corner - letters.min(),
                          behind = letters.max() - corner - free.max();
    if (before.cwiseMax(behind).maxCoeff() <= slack)
      break;
    room.fill = shrink(room.fill, cell, before, behind);
  }
  return room.fill;
}

pcl_uvol::Background
Figure::getBackgroundOfViews(pcl_uvol::Background background) const
{
  if (drawsMarks())
    background.kind = pcl_uvol::Background::Kind::Transparent;
  return background;
}

std::vector<PictureCell>
Figure::layOut(int width, int height, int views_width) const
{
  const int top = title.empty() ? 0
                                : titleRows(letterSize(height, least_letters),
                                            wrapTitle(width, height).size());
  const int count = std::max(1, static_cast<int>(views.size()));
  // As many columns as leave the largest square for each view, beside letters of axes.
  constexpr int beside = 9, below = 6; // sizes of letters
  int columns = 1, largest = std::numeric_limits<int>::min();
  for (int across = 1; across <= count; ++across) {
    const int down = (count + across - 1) / across;
    const int letters = has_ticks ? letterSize(height / down, least_letters) : 0;
    const int side = std::min(views_width / across - beside * letters,
                              (height - top) / down - below * letters);
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
    const int left = split(views_width, column, columns),
              above = top + split(height - top, row, rows);
    cells.push_back({left,
                     above,
                     split(views_width, column + 1, columns) - left,
                     top + split(height - top, row + 1, rows) - above,
                     views.empty() ? "" : views[static_cast<std::size_t>(i)]});
  }
  return cells;
}

void
Figure::nameView(pcl_uvol::Image& image,
                 const pcl_uvol::Image& ground,
                 const PictureCell& cell,
                 const MarkStyle& style)
{
  const int font = style.font;
  const TextLine name{cell.view,
                      font,
                      cell.left + font,
                      cell.top + 3 * font / 2,
                      TextAnchor::Left,
                      false,
                      style.ink};
  const int half_height = rounded(0.6 * font);
  fadeBelow(image,
            ground,
            {0, measureText(name.text, font), -half_height, half_height},
            {static_cast<double>(name.column), static_cast<double>(name.row)});
  writeLine(image, name);
}

void
Figure::drawBehind(pcl_uvol::Image& image,
                   const pcl_uvol::Image& ground,
                   const PictureCell& cell,
                   const pcl_uvol::Camera& camera,
                   const DataBox& box) const
{
  if (showsBox())
    drawBoxBehind(image, look(camera, cell), box, styleOf(cell, ground), has_ticks);
}

void
Figure::drawBefore(pcl_uvol::Image& image,
                   const pcl_uvol::Image& ground,
                   const PictureCell& cell,
                   const pcl_uvol::Camera& camera,
                   const DataBox& box) const
{
  const Perspective perspective = look(camera, cell);
  const MarkStyle style = styleOf(cell, ground);
  const int font = style.font;
  if (has_box)
    drawBoxBefore(image, perspective, box, style);
  if (views.size() > 1)
    nameView(image, ground, cell, style);
  const double length = triadLength(cell, font);
  if (has_scale_bar) {
    constexpr double longest = 0.25; // of the view's width
    const double distance = perspective.seenFromEye(box.box.center()).z();
    const ScaleBar bar(perspective.pixelsOf(box.factors.x(), distance),
                       longest * cell.width,
                       box.unit);
    const MarkBox mark = findScaleBarBox(bar, font);
    const Corners at(cell, mark, font);
    const Pixel place =
        findFreePlace(image,
                      ground,
                      mark,
                      {at.lower_right, at.lower_left, at.upper_right, at.upper_left});
    fadeBelow(image, ground, mark, place);
    drawScaleBar(image, place, bar, style);
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
  std::vector<PictureCell> cells =
      layOut(ground.width, ground.height, ground.views_width);
  if (drawsMarks())
    box.box = findBox(subject, cells[0]);
  Subject seen = subject;
  if (showsBox())
    seen.box = box.box;
  for (PictureCell& cell : cells) {
    cell.fill = findFill(seen, cell, find_camera, box, ground);
    const pcl_uvol::Camera camera = findCameraOf(seen, cell, find_camera);
    draw(camera, cell, image);
    if (drawsMarks()) {
      drawBehind(picture, empty, cell, camera, box);
      layOver(image, cell, picture);
      drawBefore(picture, empty, cell, camera, box);
    }
    else
      place(image, cell, picture);
  }
  return picture;
}

std::vector<std::string>
Figure::wrapTitle(int width, int height) const
{
  const int letters = letterSize(height, least_letters);
  return wrapText(title, titleSize(letters), width - letters);
}

void
Figure::drawTitle(pcl_uvol::Image& image) const
{
  if (title.empty())
    return;
  const int width = static_cast<int>(image.width),
            height = static_cast<int>(image.height);
  const int size = titleSize(letterSize(height, least_letters));
  double row = titleRows(letterSize(height, least_letters), 1) / 2;
  for (const std::string& line : wrapTitle(width, height)) {
    writeText(
        image, line, size, width / 2, rounded(row), TextAnchor::Center, inkOn(image));
    row += line_distance * size;
  }
}

} // namespace uvol_tools
