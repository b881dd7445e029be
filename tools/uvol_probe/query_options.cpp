// SPDX-License-Identifier: BSD-3-Clause
#include "uvol_probe/query_options.h"

#include "common/printable.h"

#include <algorithm>
#include <map>
#include <string>

namespace uvol_tools {

using pcl_uvol::detail::Bounds;
using pcl_uvol::detail::Slice;

namespace {

constexpr std::size_t largest_side = 65536;

/** Whole numbers joined by x. */
std::vector<std::size_t>
parseCounts(const std::string& option, const std::string& text, const char* example)
{
  std::vector<std::size_t> counts;
  for (std::size_t start = 0; start <= text.size();) {
    const std::size_t end = std::min(text.find('x', start), text.size());
    const std::string word = text.substr(start, end - start);
    const bool is_number = !word.empty() && word.size() <= 5 &&
                           word.find_first_not_of("0123456789") == std::string::npos;
    const std::size_t number = is_number ? std::stoul(word) : 0;
    if (number < 1 || number > largest_side)
      throw UsageError("-" + option + " takes numbers from 1 to " +
                       std::to_string(largest_side) + ", as in " + example + ", not " +
                       pcl_uvol::quoteText(text) + ".");
    counts.push_back(number);
    start = end + 1;
  }
  return counts;
}

pcl_uvol::detail::Place
placeOf(const std::vector<double>& numbers, std::size_t first)
{
  return {numbers[first], numbers[first + 1], numbers[first + 2]};
}

} // namespace

void
QueryOptions::declare(Options& options)
{
  options.input(
      "points",
      "file",
      points_,
      "interpolate at the points of a file, or the vertices of a mesh, and add the "
      "values to their fields");
  options.numbers(
      "line", "x,y,z,x,y,z", 6, line_, "interpolate along a line, from end to end");
  options.integer("n", line_points_, 2, 100000000, "with -line: number of points");
  options.text(
      "plane",
      "z=v|x,y,z,nx,ny,nz",
      plane_text_,
      "interpolate in a plane perpendicular to an axis, or through a point with a "
      "normal");
  options.text(
      "size",
      "n|WxH",
      size_text_,
      "with -plane: number of points along the longer side, or the most along each "
      "(default 512)");
  options.text(
      "grid",
      "n|NxNxN",
      grid_text_,
      "interpolate in a grid of cubes: number of points along the longest side of "
      "the data, or along x, y and z");
  options.numbers("box",
                  "x0,y0,z0,x1,y1,z1",
                  6,
                  box_,
                  "box of -plane and -grid (default: that of the data)");
  options
      .flag(
          "no-cell-mask",
          has_cell_mask_,
          "let the samples decide where the data are; default: if the input has cells, "
          "values are inside of cells only, except with -where and -periodic",
          false)
      .rare();
}

void
QueryOptions::finish(const Options& options)
{
  const std::map<std::string, Kind> kinds = {{"points", Kind::Points},
                                             {"line", Kind::Line},
                                             {"plane", Kind::Plane},
                                             {"grid", Kind::Grid},
                                             {"", Kind::None}};
  kind_ = kinds.at(options.oneOf({"points", "line", "plane", "grid"}));
  const std::array<const char*, 2> needs[] = {{"n", "line"}, {"size", "plane"}};
  for (const auto& [option, other] : needs)
    if (options.given(option) && !options.given(other))
      throw UsageError(std::string("-") + option + " needs -" + other + ".");
  if (!box_.empty() && kind_ != Kind::Plane && kind_ != Kind::Grid)
    throw UsageError("-box needs -plane or -grid.");
  if (kind_ == Kind::Plane) {
    parsePlane();
    parseSize();
  }
  if (kind_ == Kind::Grid)
    parseGrid();
}

void
QueryOptions::parsePlane()
{
  const bool is_along_axis = plane_text_.size() > 2 && plane_text_[1] == '=' &&
                             plane_text_[0] >= 'x' && plane_text_[0] <= 'z';
  if (is_along_axis) {
    const auto axis = static_cast<std::size_t>(plane_text_[0] - 'x');
    plane_.normal[axis] = 1.0;
    plane_.point[axis] = parseNumbers("plane", plane_text_.substr(2), 1)[0];
    return;
  }
  if (plane_text_.find('=') != std::string::npos)
    throw UsageError("-plane is x=, y= or z= and a number, or x,y,z,nx,ny,nz, not " +
                     pcl_uvol::quoteText(plane_text_) + ".");
  const auto numbers = parseNumbers("plane", plane_text_, 6);
  plane_.point = placeOf(numbers, 0);
  plane_.normal = placeOf(numbers, 3);
  if (plane_.normal == pcl_uvol::detail::Place{})
    throw UsageError("The normal of -plane has no direction.");
}

void
QueryOptions::parseSize()
{
  const auto counts = parseCounts("size", size_text_, "512 or 640x480");
  if (counts.size() > 2 || *std::min_element(counts.begin(), counts.end()) < 2)
    throw UsageError("-size is one number of points from 2, or two, as in 512 or "
                     "640x480, not " +
                     size_text_ + ".");
  size_ = {counts.front(), counts.back()};
}

void
QueryOptions::parseGrid()
{
  grid_ = parseCounts("grid", grid_text_, "256 or 256x256x64");
  if ((grid_.size() != 1 && grid_.size() != 3) || (grid_.size() == 1 && grid_[0] < 2))
    throw UsageError(
        "-grid is one number of points from 2, or three numbers, as in 256 "
        "or 256x256x64, not " +
        grid_text_ + ".");
}

Slice
QueryOptions::makeLattice(const Bounds& data) const
{
  const Bounds box = box_.empty() ? data : Bounds{placeOf(box_, 0), placeOf(box_, 3)};
  switch (kind_) {
  case Kind::Line:
    return {
        pcl_uvol::detail::makeLine(placeOf(line_, 0), placeOf(line_, 3), line_points_),
        0,
        1};
  case Kind::Plane:
    return pcl_uvol::detail::makeSlice(plane_, box, size_);
  default:
    return {grid_.size() == 1
                ? pcl_uvol::detail::makeCubicGrid(box, grid_[0])
                : pcl_uvol::detail::makeGrid(box, {grid_[0], grid_[1], grid_[2]}),
            0,
            1};
  }
}

} // namespace uvol_tools
