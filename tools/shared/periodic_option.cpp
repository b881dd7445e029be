// SPDX-License-Identifier: BSD-3-Clause
#include "shared/periodic_option.h"

#include "shared/isosurface_options.h"
#include <pcl_uvol/common/exceptions.h>

#include <algorithm>

namespace uvol_tools {

void
PeriodicOption::declare(Options& options)
{
  options
      .text("periodic",
            "x,y,z|header",
            text_,
            "sides of the periodic box, in units of length (0: axis not periodic), or "
            "header: those that the file names")
      .rare();
}

std::array<double, 3>
PeriodicOption::check(bool is_turned) const
{
  if (isAskedFor() && is_turned)
    throw UsageError("-periodic cannot be combined with -rotate or a -scale of nine "
                     "numbers: the sides of the box are along x, y and z.");
  if (text_.empty() || text_ == "header")
    return {};
  const std::vector<double> sides = parseNumbers("periodic", text_, 3);
  if (*std::min_element(sides.begin(), sides.end()) < 0.0 ||
      *std::max_element(sides.begin(), sides.end()) <= 0.0)
    throw UsageError(
        "-periodic takes three non-negative sides, at least one of them above 0, or "
        "the word header.");
  return {{sides[0], sides[1], sides[2]}};
}

std::array<double, 3>
PeriodicOption::findSides(const pcl_uvol::Dataset& samples) const
{
  if (text_ != "header")
    return check();
  if (samples.box == std::array<double, 3>{})
    throw pcl_uvol::InvalidArgument("no_box_in_file", {});
  return samples.box;
}

Fact
describeBox(const pcl_uvol::SampleBox& box)
{
  return {"periodic box",
          "sides " + joined(box.sides) + " from " + joined(box.low),
          Fact::Members{{"sides", {box.sides.begin(), box.sides.end()}},
                        {"low", {box.low.begin(), box.low.end()}}}};
}

} // namespace uvol_tools
