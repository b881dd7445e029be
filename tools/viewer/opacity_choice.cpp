// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/opacity_choice.h"

#include "common/scalar_field.h"
#include <pcl_uvol/common/cloud_view.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace uvol_tools {

namespace {

/** Around the innermost isovalue, after what the options say. */
constexpr double steps[] = {1.0, 0.6, 0.3};

using Boxes = std::map<double, Eigen::AlignedBox3f>;

/** The isovalues of a surface, and boxes around their points. */
Boxes
findBoxes(const pcl::PCLPointCloud2& surface)
{
  constexpr const char* field = "isovalue";
  Boxes boxes;
  const pcl_uvol::CloudView cloud = pcl_uvol::viewOf(surface);
  if (std::none_of(cloud.fields.begin(), cloud.fields.end(), [&](const auto& known) {
        return known.name == field;
      }))
    return boxes;
  const pcl_uvol::ScalarField isovalue(cloud.fields, field);
  for (std::size_t i = 0; i < cloud.count; ++i) {
    const double value = isovalue.read(cloud.point(i));
    const Eigen::Map<const Eigen::Vector3f> place(cloud.xyz(i));
    if (std::isfinite(value) && place.allFinite())
      boxes[value].extend(place);
  }
  return boxes;
}

/** The index of the number next to a value: surfaces may hold isovalues in single
 * precision. */
std::size_t
findNearest(const std::vector<double>& values, double value)
{
  const auto nearest =
      std::min_element(values.begin(), values.end(), [value](double a, double b) {
        return std::abs(a - value) < std::abs(b - value);
      });
  return static_cast<std::size_t>(nearest - values.begin());
}

} // namespace

OpacityChoice::OpacityChoice(std::vector<double> opacities)
    : given_(std::move(opacities))
    , step_(given_.empty() ? 1 : 0)
{
}

double
OpacityChoice::next()
{
  step_ = (step_ + 1) % (std::size(steps) + 1);
  if (step_ == 0 && given_.empty())
    step_ = 1;
  return step_ == 0 ? -1.0 : steps[step_ - 1];
}

std::vector<double>
OpacityChoice::find(const pcl::PCLPointCloud2& surface,
                    std::vector<double> isovalues) const
{
  const Boxes boxes = findBoxes(surface);
  std::vector<double> opacities;
  if (step_ == 0) {
    if (isovalues.empty())
      for (const auto& [value, box] : boxes)
        isovalues.push_back(value);
    std::sort(isovalues.begin(), isovalues.end());
    isovalues.erase(std::unique(isovalues.begin(), isovalues.end()), isovalues.end());
    for (const auto& [value, box] : boxes)
      opacities.push_back(
          given_[std::min(findNearest(isovalues, value), given_.size() - 1)]);
    if (boxes.empty()) // points of no isovalue are one surface
      opacities = {given_[0]};
  }
  else {
    const auto innermost =
        std::min_element(boxes.begin(), boxes.end(), [](const auto& a, const auto& b) {
          return a.second.diagonal().norm() < b.second.diagonal().norm();
        });
    for (auto box = boxes.begin(); box != boxes.end(); ++box)
      opacities.push_back(box == innermost ? 1.0 : steps[step_ - 1]);
  }
  const bool is_opaque = std::all_of(opacities.begin(),
                                     opacities.end(),
                                     [](double opacity) { return opacity == 1.0; });
  return is_opaque ? std::vector<double>() : opacities;
}

} // namespace uvol_tools
