// SPDX-License-Identifier: BSD-3-Clause
#include "charts/data_box.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace uvol_tools {

using Eigen::Vector3d;
using pcl_uvol::Image;

namespace {

/** An edge of a box: along an axis, at ends of the two others. */
struct Edge {
  int axis;
  std::array<bool, 2> at_high; ///< of the axes that follow, in cyclic order
};

int
following(const Edge& edge, int k)
{
  return (edge.axis + 1 + k) % 3;
}

/** Draws what belongs to a box. */
class BoxPen {
public:
  BoxPen(Image& image,
         const Perspective& perspective,
         const DataBox& data,
         const MarkStyle& style)
      : image_(image)
      , perspective_(perspective)
      , data_(data)
      , box_(data.box)
      , style_(style)
  {
  }

  /** Edges that so many faces share which look towards the eye. */
  std::vector<Edge>
  edges(int facing) const
  {
    std::vector<Edge> found;
    for (int axis = 0; axis < 3; ++axis)
      for (const bool first : {false, true})
        for (const bool second : {false, true}) {
          const Edge edge{axis, {first, second}};
          const int count = facesEye(following(edge, 0), first) +
                            facesEye(following(edge, 1), second);
          if (count == facing && hasLength(axis))
            found.push_back(edge);
        }
    return found;
  }

  bool
  hasLength(int axis) const
  {
    return box_.max()[axis] > box_.min()[axis];
  }

  void
  drawEdges(int facing, double opacity)
  {
    for (const Edge& edge : edges(facing))
      draw(placeOn(edge, box_.min()[edge.axis]),
           placeOn(edge, box_.max()[edge.axis]),
           style_.font / 14.0,
           opacity);
  }

  /** Lines across the faces that look away. */
  void
  drawGrid(int axis)
  {
    constexpr double opacity = 0.16;
    for (const double value : roundValues(valueAt(axis, box_.min()[axis]),
                                          valueAt(axis, box_.max()[axis]))) {
      // The line runs along one of the other axes, on a face across the third one.
      for (int k = 1; k < 3; ++k) {
        const int along = (axis + k) % 3, across = 3 - axis - along;
        for (const bool high : {false, true}) {
          if (facesEye(across, high) || !hasLength(along))
            continue;
          Vector3d from, to;
          from[axis] = to[axis] = coordinateOf(axis, value);
          from[across] = to[across] = endOf(across, high);
          from[along] = box_.min()[along];
          to[along] = box_.max()[along];
          draw(from, to, style_.font / 14.0, opacity);
        }
      }
    }
  }

  /** Values beside the edge at the outline that is lowest in the picture, or farthest
   * to the left for an axis that stands upright. */
  void
  drawTicks(int axis)
  {
    std::optional<Edge> best;
    double most = 0.0;
    for (const Edge& edge : edges(1)) {
      if (edge.axis != axis || !isInFront(edge))
        continue;
      const Pixel from = pixelAt(placeOn(edge, box_.min()[axis])),
                  to = pixelAt(placeOn(edge, box_.max()[axis]));
      const bool is_upright = std::abs(to[1] - from[1]) > std::abs(to[0] - from[0]);
      const double merit = is_upright ? -from[0] - to[0] : from[1] + to[1];
      if (!best || merit > most) {
        best = edge;
        most = merit;
      }
    }
    if (best)
      writeValues(*best);
  }

private:
  /** Whether a face is seen from outside. */
  bool
  facesEye(int axis, bool high) const
  {
    const double eye = perspective_.getEye()[axis];
    return high ? eye > box_.max()[axis] : eye < box_.min()[axis];
  }

  double
  endOf(int axis, bool high) const
  {
    return high ? box_.max()[axis] : box_.min()[axis];
  }

  Vector3d
  placeOn(const Edge& edge, double coordinate) const
  {
    Vector3d place;
    place[edge.axis] = coordinate;
    for (int k = 0; k < 2; ++k)
      place[following(edge, k)] =
          endOf(following(edge, k), edge.at_high[static_cast<std::size_t>(k)]);
    return place;
  }

  double
  valueAt(int axis, double coordinate) const
  {
    return (coordinate + data_.origin[axis]) / data_.factors[axis];
  }

  double
  coordinateOf(int axis, double value) const
  {
    return std::clamp(value * data_.factors[axis] - data_.origin[axis],
                      box_.min()[axis],
                      box_.max()[axis]);
  }

  Pixel
  pixelAt(const Vector3d& place) const
  {
    return perspective_.pixelOf(perspective_.seenFromEye(place));
  }

  double
  nearest() const
  {
    constexpr double part = 1e-3;
    return part * box_.diagonal().norm();
  }

  bool
  isInFront(const Edge& edge) const
  {
    return std::min(
               perspective_.seenFromEye(placeOn(edge, box_.min()[edge.axis])).z(),
               perspective_.seenFromEye(placeOn(edge, box_.max()[edge.axis])).z()) >
           nearest();
  }

  /** The part of a line that is in front of the eye. */
  void
  draw(const Vector3d& from, const Vector3d& to, double width, double opacity)
  {
    Vector3d a = perspective_.seenFromEye(from), b = perspective_.seenFromEye(to);
    if (a.z() > b.z())
      std::swap(a, b);
    if (b.z() <= nearest())
      return;
    if (a.z() < nearest())
      a += (nearest() - a.z()) / (b.z() - a.z()) * (b - a);
    const Pixel start = perspective_.pixelOf(a), end = perspective_.pixelOf(b);
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

  /** Away from the box, across an edge. */
  Pixel
  outwards(const Pixel& from, const Pixel& to) const
  {
    const Pixel center = pixelAt(box_.center());
    const double dx = to[0] - from[0], dy = to[1] - from[1],
                 length = std::max(std::hypot(dx, dy), 1e-9);
    const Pixel normal{dy / length, -dx / length};
    const double side = normal[0] * (0.5 * (from[0] + to[0]) - center[0]) +
                        normal[1] * (0.5 * (from[1] + to[1]) - center[1]);
    return side >= 0.0 ? normal : Pixel{-normal[0], -normal[1]};
  }

  /** True if letters of neighbours along an edge do not meet. */
  bool
  haveRoom(const Edge& edge, const std::vector<double>& values) const
  {
    constexpr double letters = 2.6;
    const auto at = [&](double value) {
      return pixelAt(placeOn(edge, coordinateOf(edge.axis, value)));
    };
    return std::adjacent_find(values.begin(), values.end(), [&](double a, double b) {
             return std::hypot(at(b)[0] - at(a)[0], at(b)[1] - at(a)[1]) <
                    letters * style_.font;
           }) == values.end();
  }

  /** Of round values along an edge all, or every second one, third one and so on, such
   * as have room: from 0 on, if it is there, else from the first one on. */
  std::vector<double>
  thinned(const Edge& edge, const std::vector<double>& values) const
  {
    const bool has_zero = values.front() <= 0.0 && values.back() >= 0.0;
    std::vector<double> kept = values;
    for (long stride = 2; !haveRoom(edge, kept); ++stride) {
      const double step = values[1] - values[0];
      kept.clear();
      for (const double value : values)
        if (std::lround((has_zero ? value : value - values[0]) / step) % stride == 0)
          kept.push_back(value);
    }
    return kept;
  }

  void
  writeValues(const Edge& edge)
  {
    const int axis = edge.axis, font = style_.font;
    const double low = box_.min()[axis], high = box_.max()[axis];
    const Pixel from = pixelAt(placeOn(edge, low)), to = pixelAt(placeOn(edge, high)),
                out = outwards(from, to);
    const auto values =
        thinned(edge, roundValues(valueAt(axis, low), valueAt(axis, high)));
    const AxisLabels labels = labelValues(values);
    int widest = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
      const Pixel at = pixelAt(placeOn(edge, coordinateOf(axis, values[i])));
      drawLine(at,
               {at[0] + 0.5 * font * out[0], at[1] + 0.5 * font * out[1]},
               font / 14.0,
               1.0);
      widest = std::max(widest, write(labels.texts[i], at, out, 1.2 * font));
    }
    std::string name(1, static_cast<char>('x' + axis));
    if (!data_.unit.empty())
      name += " (" + data_.unit + ")";
    if (!labels.offset.empty())
      name += "  " + labels.offset;
    constexpr double upright = 0.8;
    if (std::abs(out[0]) > upright) {
      const double distance = 2.2 * font + widest;
      writeUpwards(image_,
                   name,
                   font,
                   rounded(0.5 * (from[0] + to[0]) + distance * out[0]),
                   rounded(0.5 * (from[1] + to[1]) + distance * out[1]),
                   style_.ink);
      return;
    }
    const double beyond =
        2.0 * font + widest * std::abs(out[0]) + font * std::abs(out[1]);
    write(name, {0.5 * (from[0] + to[0]), 0.5 * (from[1] + to[1])}, out, beyond);
  }

  /** \return its width */
  int
  write(const std::string& text, const Pixel& at, const Pixel& out, double distance)
  {
    constexpr double aslant = 0.35;
    const TextAnchor anchor = out[0] > aslant    ? TextAnchor::Left
                              : out[0] < -aslant ? TextAnchor::Right
                                                 : TextAnchor::Center;
    return writeText(image_,
                     text,
                     style_.font,
                     rounded(at[0] + distance * out[0]),
                     rounded(at[1] + distance * out[1]),
                     anchor,
                     style_.ink);
  }

  Image& image_;
  const Perspective& perspective_;
  const DataBox& data_;
  const Eigen::AlignedBox3d& box_;
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
    if (pen.hasLength(axis)) {
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
