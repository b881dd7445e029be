// SPDX-License-Identifier: BSD-3-Clause
#include "shared/color_options.h"

#include <pcl_uvol/common/exceptions.h>

namespace uvol_tools {

void
ColorOptions::declareMapping(Options& options)
{
  std::string names;
  for (const std::string& name : pcl_uvol::ColorMap::names())
    names += (names.empty() ? "" : "|") + name;
  options.text("colormap",
               names,
               map_,
               "colours of values, reversed with _r after the name (default viridis, "
               "OkabeIto for up to eight isovalues or integers, tab10 for ten)");
  options.numbers("range", "low,high", 2, range_, "values at the ends of the colours");
  options.flag("log", is_logarithmic_, "colour by the logarithm of the values");
}

void
ColorOptions::declare(Options& options)
{
  declareMapping(options);
  options
      .text("label",
            "text",
            label_,
            "title of the colour bar, such as 'T (K)' (default: the field)")
      .rare();
}

void
ColorOptions::check() const
{
  try {
    const pcl_uvol::ColorMap map = getMap();
    if (is_logarithmic_ && map.isCategorical())
      throw UsageError("-log needs a map of shades, and " + map_ +
                       " is one of categories.");
  }
  catch (const pcl_uvol::InvalidArgument& error) {
    throw UsageError(error.asMessage().text(pcl_uvol::ParameterNames::Options));
  }
  if (!range_.empty() && !(range_[0] < range_[1]))
    throw UsageError("-range takes two numbers, the lower one first.");
  if (!range_.empty() && is_logarithmic_ && !(range_[0] > 0.0))
    throw UsageError("With -log the numbers of -range are above 0.");
}

pcl_uvol::ColorMap
ColorOptions::getMap() const
{
  return map_ == "auto" ? pcl_uvol::ColorMap() : pcl_uvol::ColorMap(map_);
}

pcl_uvol::ColorMapping
ColorOptions::mapFor(const pcl_uvol::CloudView& cloud, const std::string& field) const
{
  if (isAutomatic())
    return pcl_uvol::usualColorMapping(cloud, field);
  return {getMap(), getRange(), is_logarithmic_};
}

std::optional<std::array<double, 2>>
ColorOptions::getRange() const
{
  if (range_.empty())
    return std::nullopt;
  return std::array<double, 2>{range_[0], range_[1]};
}

} // namespace uvol_tools
