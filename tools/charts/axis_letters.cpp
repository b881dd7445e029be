// SPDX-License-Identifier: BSD-3-Clause
#include "charts/axis_letters.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace uvol_tools {

namespace {

/** Between values and their edge, in sizes of letters. */
constexpr double values_apart = 1.2;

/** A box whose data have a unit and an offset. */
std::vector<std::string>
nameAxis(const DataBox& data, int axis, const std::string& offset)
{
  std::vector<std::string> lines = {std::string(1, static_cast<char>('x' + axis))};
  if (!data.unit.empty())
    lines[0] += " (" + data.unit + ")";
  if (!offset.empty())
    lines.push_back(offset);
  return lines;
}

/** Lays out what stands beside an edge. */
class EdgeWriter {
public:
  EdgeWriter(const SeenBox& box, const BoxEdge& edge, const MarkStyle& style)
      : box_(box)
      , edge_(edge)
      , style_(style)
      , ends_(box.endsOf(edge))
      , out_(box.outwards(ends_))
  {
  }

  AxisMarks
  write()
  {
    const std::vector<double> values =
        thinned(box_.getData().listRoundValues(edge_.axis));
    marks_.letters = letter(values);
    for (const double value : values) {
      const Pixel at = pixelOf(value);
      marks_.ticks.push_back({at, beyond(at, 0.5 * style_.font)});
    }
    for (const AxisLetters& value : marks_.letters)
      widest_ = std::max(widest_, measureText(value.line.text, style_.font));
    writeName(nameAxis(box_.getData(), edge_.axis, labelValues(values).offset));
    return marks_;
  }

private:
  Pixel
  pixelOf(double value) const
  {
    return box_.pixelAt(
        box_.placeOn(edge_, box_.getData().coordinateOf(edge_.axis, value)));
  }

  Pixel
  beyond(const Pixel& at, double distance) const
  {
    return {at[0] + distance * out_[0], at[1] + distance * out_[1]};
  }

  TextLine
  line(const std::string& text, const Pixel& at) const
  {
    constexpr double aslant = 0.35;
    const TextAnchor anchor = out_[0] > aslant    ? TextAnchor::Left
                              : out_[0] < -aslant ? TextAnchor::Right
                                                  : TextAnchor::Center;
    return {
        text, style_.font, rounded(at[0]), rounded(at[1]), anchor, false, style_.ink};
  }

  std::vector<AxisLetters>
  letter(const std::vector<double>& values) const
  {
    const AxisLabels labels = labelValues(values);
    std::vector<AxisLetters> letters;
    for (std::size_t i = 0; i < values.size(); ++i) {
      const Pixel at = pixelOf(values[i]);
      letters.push_back(
          {line(labels.texts[i], beyond(at, values_apart * style_.font)), at});
    }
    if (letters.size() == 2)
      moveApart(letters[0], letters[1]);
    return letters;
  }

  /** Letters of two values that meet, along the edge: ticks say where they belong. */
  void
  moveApart(AxisLetters& low, AxisLetters& high) const
  {
    const Eigen::Vector2d narrow(0.2, -0.35); // digits are not as high as their font
    const Eigen::Vector2d along(high.place[0] - low.place[0],
                                high.place[1] - low.place[1]);
    const AxisLetters first = low, second = high;
    for (double way = 0.0; hasExtent(along) && meet(low, high, narrow); way += 0.5) {
      const Eigen::Vector2d move = way * along.normalized();
      low.line.column = first.line.column - rounded(move.x());
      low.line.row = first.line.row - rounded(move.y());
      high.line.column = second.line.column + rounded(move.x());
      high.line.row = second.line.row + rounded(move.y());
    }
  }

  /** False along the line of sight. */
  static bool
  hasExtent(const Eigen::Vector2d& along)
  {
    constexpr double least = 1.0; // pixels
    return along.norm() >= least;
  }

  /** \param apart least distance of the pixels around letters, in their sizes: columns
   * and rows */
  bool
  meet(const AxisLetters& a, const AxisLetters& b, const Eigen::Vector2d& apart) const
  {
    Eigen::AlignedBox2d wide = boxAround(a.line);
    wide.min() -= style_.font * apart;
    wide.max() += style_.font * apart;
    return wide.intersects(boxAround(b.line));
  }

  /** True if letters of neighbours along the edge do not meet. */
  bool
  haveRoom(const std::vector<double>& values) const
  {
    const Eigen::Vector2d apart(0.6, 0.0);
    const std::vector<AxisLetters> letters = letter(values);
    return std::adjacent_find(
               letters.begin(), letters.end(), [&](const auto& a, const auto& b) {
                 return meet(a, b, apart);
               }) == letters.end();
  }

  /** Of round values every second one, third one and so on: from 0 on, if it is there,
   * else from the first one on. */
  static std::vector<double>
  everyNth(const std::vector<double>& values, long stride)
  {
    const bool has_zero = values.front() <= 0.0 && values.back() >= 0.0;
    const double step = values[1] - values[0];
    std::vector<double> kept;
    for (const double value : values)
      if (std::lround((has_zero ? value : value - values[0]) / step) % stride == 0)
        kept.push_back(value);
    return kept;
  }

  /** Round values in even steps such as have room, or at least the outermost ones: of
   * one value no scale can be read. */
  std::vector<double>
  thinned(const std::vector<double>& values) const
  {
    if (values.size() < 2)
      return values;
    const auto all = static_cast<long>(values.size());
    for (long stride = 1; stride < all; ++stride) {
      std::vector<double> kept = everyNth(values, stride);
      if (kept.size() >= 2 && haveRoom(kept))
        return kept;
    }
    const Pixel low = pixelOf(values.front()), high = pixelOf(values.back());
    return hasExtent({high[0] - low[0], high[1] - low[1]})
               ? std::vector<double>{values.front(), values.back()}
               : everyNth(values, all);
  }

  void
  writeName(const std::vector<std::string>& lines)
  {
    constexpr double upright = 0.8;
    const Pixel middle{0.5 * (ends_[0][0] + ends_[1][0]),
                       0.5 * (ends_[0][1] + ends_[1][1])};
    if (std::abs(out_[0]) > upright)
      writeNameUpwards(lines, middle);
    else
      writeNameBelow(lines, middle);
  }

  void
  writeNameUpwards(const std::vector<std::string>& lines, const Pixel& middle)
  {
    std::string name = lines[0];
    for (std::size_t i = 1; i < lines.size(); ++i)
      name += "  " + lines[i];
    TextLine text = line(name, beyond(middle, 2.2 * style_.font + widest_));
    text.anchor = TextAnchor::Center;
    text.is_upright = true;
    marks_.letters.push_back({text, middle});
  }

  /** One line below the other, whichever side of the edge they are on. */
  void
  writeNameBelow(const std::vector<std::string>& lines, const Pixel& middle)
  {
    constexpr double spacing = 1.3;
    const int font = style_.font;
    Pixel at = beyond(
        middle, 2.0 * font + widest_ * std::abs(out_[0]) + font * std::abs(out_[1]));
    if (out_[1] < 0.0)
      at[1] -= spacing * font * static_cast<double>(lines.size() - 1);
    for (const std::string& text : lines) {
      marks_.letters.push_back({line(text, at), middle});
      at[1] += spacing * font;
    }
  }

  const SeenBox& box_;
  const BoxEdge& edge_;
  const MarkStyle& style_;
  std::array<Pixel, 2> ends_;
  Pixel out_;
  AxisMarks marks_;
  int widest_ = 0; ///< of the values, pixels
};

} // namespace

AxisMarks
layOutAxis(const SeenBox& box, int axis, const MarkStyle& style)
{
  const std::optional<BoxEdge> edge = box.findTickEdge(axis);
  return edge ? EdgeWriter(box, *edge, style).write() : AxisMarks();
}

Eigen::AlignedBox2d
boxAroundLetters(const SeenBox& box, const MarkStyle& style)
{
  Eigen::AlignedBox2d around;
  for (int axis = 0; axis < 3; ++axis)
    for (const AxisLetters& letters : layOutAxis(box, axis, style).letters)
      around.extend(boxAround(letters.line));
  return around;
}

std::array<double, 2>
findRoomAround(const DataBox& box, const MarkStyle& style)
{
  constexpr double name_beside = 1.6, name_below = 2.4; // sizes of letters
  int widest = 0;
  for (int axis = 0; axis < 3; ++axis)
    if (box.hasLength(axis))
      for (const std::string& text : labelValues(box.listRoundValues(axis)).texts)
        widest = std::max(widest, measureText(text, style.font));
  return {(values_apart + name_beside) * style.font + widest,
          (values_apart + name_below) * style.font};
}

} // namespace uvol_tools
