// SPDX-License-Identifier: BSD-3-Clause
#include "charts/data_box.h"

#include <algorithm>
#include <cmath>

namespace uvol_tools {

using Eigen::Vector3d;
using pcl_uvol::Image;

namespace {

/** Move letters into a frame, if most of them are in it with what they are about.
 * \return false if they are not */
bool
moveInto(const Eigen::AlignedBox2d& frame, AxisLetters& letters)
{
  const Eigen::AlignedBox2d box = boxAround(letters.line);
  if (!frame.contains(Eigen::Vector2d(letters.place.data())) ||
      !frame.contains(box.center()))
    return false;
  const Eigen::Vector2d before = (frame.min() - box.min()).cwiseMax(0.0),
                        beyond = (box.max() - frame.max()).cwiseMax(0.0);
  letters.line.column += rounded(before.x() - beyond.x());
  letters.line.row += rounded(before.y() - beyond.y());
  return true;
}

/** Draws what belongs to a box. */
class BoxPen {
public:
  BoxPen(Image& image,
         const Perspective& perspective,
         const DataBox& data,
         const MarkStyle& style)
      : image_(image)
      , box_(perspective, data)
      , style_(style)
  {
  }

  void
  drawEdges(int facing, double opacity)
  {
    for (const BoxEdge& edge : box_.edges(facing))
      draw(box_.placeOn(edge, box_.endOf(edge.axis, false)),
           box_.placeOn(edge, box_.endOf(edge.axis, true)),
           style_.font / 14.0,
           opacity);
  }

  /** Lines across the faces that look away. */
  void
  drawGrid(int axis)
  {
    constexpr double opacity = 0.16;
    const DataBox& data = box_.getData();
    for (const double value : data.listRoundValues(axis)) {
      // The line runs along one of the other axes, on a face across the third one.
      for (int k = 1; k < 3; ++k) {
        const int along = (axis + k) % 3, across = 3 - axis - along;
        for (const bool high : {false, true}) {
          if (box_.facesEye(across, high) || !data.hasLength(along))
            continue;
          Vector3d from, to;
          from[axis] = to[axis] = data.coordinateOf(axis, value);
          from[across] = to[across] = box_.endOf(across, high);
          from[along] = box_.endOf(along, false);
          to[along] = box_.endOf(along, true);
          draw(from, to, style_.font / 14.0, opacity);
        }
      }
    }
  }

  void
  drawTicks(int axis)
  {
    AxisMarks marks = layOutAxis(box_, axis, style_);
    for (const auto& [from, to] : marks.ticks)
      drawLine(from, to, style_.font / 14.0, 1.0);
    for (AxisLetters& letters : marks.letters)
      if (moveInto(perspective().getFrame(), letters))
        writeLine(image_, letters.line);
  }

private:
  const Perspective&
  perspective() const
  {
    return box_.getPerspective();
  }

  /** The part of a line that is in front of the eye. */
  void
  draw(const Vector3d& from, const Vector3d& to, double width, double opacity)
  {
    Vector3d a = perspective().seenFromEye(from), b = perspective().seenFromEye(to);
    if (a.z() > b.z())
      std::swap(a, b);
    if (b.z() <= box_.nearest())
      return;
    if (a.z() < box_.nearest())
      a += (box_.nearest() - a.z()) / (b.z() - a.z()) * (b - a);
    const Pixel start = perspective().pixelOf(a), end = perspective().pixelOf(b);
    drawLine(start, end, width, opacity);
  }

  /** The part of a line that is in the picture, or near to it: a place beside the eye
   * lies millions of pixels away. */
  void
  drawLine(const Pixel& start, const Pixel& end, double width, double opacity)
  {
    double first = 0.0, last = 1.0;
    const std::array<double, 2> size{static_cast<double>(image_.width),
                                     static_cast<double>(image_.height)};
    for (std::size_t k = 0; k < 2; ++k) {
      const double step = end[k] - start[k], margin = width + 1.0;
      const double low = -margin - start[k], high = size[k] + margin - start[k];
      if (step == 0.0 && (low > 0.0 || high < 0.0))
        return;
      if (step != 0.0) {
        first = std::max(first, std::min(low / step, high / step));
        last = std::min(last, std::max(low / step, high / step));
      }
    }
    if (first >= last)
      return;
    const auto at = [&](std::size_t k, double part) {
      return start[k] + part * (end[k] - start[k]);
    };
    forLinePixels(at(0, first),
                  at(1, first),
                  at(0, last),
                  at(1, last),
                  width,
                  [&](int column, int row, double part) {
                    blend(image_, column, row, style_.ink, opacity * part);
                  });
  }

  Image& image_;
  SeenBox box_;
  const MarkStyle& style_;
};

} // namespace

void
drawBoxBehind(Image& image,
              const Perspective& perspective,
              const DataBox& box,
              const MarkStyle& style,
              bool has_ticks)
{
  BoxPen pen(image, perspective, box, style);
  for (int axis = 0; has_ticks && axis < 3; ++axis)
    if (box.hasLength(axis)) {
      pen.drawGrid(axis);
      pen.drawTicks(axis);
    }
  pen.drawEdges(0, 1.0);
  pen.drawEdges(1, 1.0);
}

void
drawBoxBefore(Image& image,
              const Perspective& perspective,
              const DataBox& box,
              const MarkStyle& style)
{
  constexpr double opacity = 0.4;
  BoxPen(image, perspective, box, style).drawEdges(2, opacity);
}

} // namespace uvol_tools
