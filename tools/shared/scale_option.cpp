// SPDX-License-Identifier: BSD-3-Clause
#include "shared/scale_option.h"

#include "neighbors/anisotropy.h"
#include <pcl_uvol/common/exceptions.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace uvol_tools {

using pcl_uvol::detail::Stretch;

void
ScaleOption::declare(Options& options,
                     const std::string& purpose,
                     AutomaticScale automatic)
{
  automatic_ = automatic;
  const bool is_found = automatic != AutomaticScale::None;
  std::string help = "measure " + purpose + " in a stretched space: factors per axis";
  if (is_found)
    help += ", or a matrix row by row";
  if (automatic == AutomaticScale::Field)
    help += "; auto: from the change of the field along each axis";
  if (is_found)
    help += std::string("; spacing") +
            (automatic == AutomaticScale::Spacing ? " or auto" : "") +
            ": from the sample spacing";
  help += " (default 1,1,1)";
  options.text("scale",
               is_found ? "sx,sy,sz|a11,a12,...,a33|auto|spacing" : "sx,sy,sz",
               scale_,
               help);
  if (is_found)
    options
        .numbers("rotate",
                 "strike,dip,plunge",
                 3,
                 angles_,
                 "strike, dip and plunge of the axes of -scale, in degrees: the "
                 "second axis plunges in a plane that dips, the third is its normal")
        .rare();
}

namespace {

Eigen::Array3f
parseFactors(const std::string& text)
{
  const Eigen::Array3f factors =
      Eigen::Array3d(parseNumbers("scale", text, 3).data()).cast<float>();
  if (!(factors > 0.0f).all() || !factors.isFinite().all())
    throw UsageError("-scale takes three positive factors, not " + text + ".");
  return factors;
}

} // namespace

void
ScaleOption::finish(const Options& options)
{
  is_given_ = options.given("scale") || !angles_.empty();
  const bool is_found = automatic_ != AutomaticScale::None;
  const bool is_automatic = scale_ == "auto";
  is_from_field_ = is_automatic && automatic_ != AutomaticScale::Spacing;
  is_from_spacing_ =
      is_found && (scale_ == "spacing" || (is_automatic && !is_from_field_));
  try {
    if (is_found && std::count(scale_.begin(), scale_.end(), ',') == 8) {
      const auto numbers = parseNumbers("scale", scale_, 9);
      if (!angles_.empty())
        throw UsageError(
            "-rotate requires a -scale of three factors, auto or spacing: one "
            "of nine numbers has its own axes.");
      using Rows = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
      stretch_ = Stretch::ofMap(Eigen::Map<const Rows>(numbers.data()));
    }
    else if (!scale_.empty() && !is_automatic && !is_from_spacing_)
      stretch_.scale = parseFactors(scale_);
    if (!angles_.empty())
      stretch_.rotation = Eigen::Array3d(angles_.data());
    pcl_uvol::detail::StretchAxes checked(stretch_.rotation);
  }
  catch (const pcl_uvol::InvalidArgument& error) {
    throw UsageError(error.asMessage().text(pcl_uvol::ParameterNames::Options));
  }
}

Stretch
ScaleOption::findStretch(const pcl_uvol::CloudView& cloud) const
{
  Stretch stretch = stretch_;
  if (isFromSpacing())
    stretch.scale = pcl_uvol::equalizingScale(
        pcl_uvol::detail::StretchAxes(stretch.rotation).turn(cloud));
  return stretch;
}

Stretch
ScaleOption::resolve(const pcl_uvol::CloudView& cloud,
                     const std::string& field,
                     unsigned threads,
                     pcl_uvol::Report& report,
                     Facts& facts) const
{
  Stretch stretch = findStretch(cloud);
  std::optional<pcl_uvol::ScaleChoice> choice;
  if (isFromField()) {
    pcl::Indices all(cloud.count);
    std::iota(all.begin(), all.end(), 0);
    choice =
        pcl_uvol::chooseScale(cloud, all, field, stretch.rotation, threads, report);
    stretch.scale = choice->scale;
  }
  if (isGiven())
    facts = describe(stretch, choice);
  return stretch;
}

namespace {

Fact
describeChoice(const pcl_uvol::ScaleChoice& choice)
{
  FactText text;
  text.precision(2);
  if ((choice.scale == 1.0f).all())
    text << "1: no other scale predicts the " << choice.tested
         << " held-out samples clearly better";
  else
    text << "from the field: the error at " << choice.tested << " held-out samples is "
         << choice.error_ratio << " times that of scale 1; distance explains "
         << std::round(100.0 * choice.explained) << " % of the differences, before "
         << std::round(100.0 * choice.explained_before) << " %";
  return {"scale choice",
          text.str(),
          Fact::Members{{"error_ratio", {choice.error_ratio}},
                        {"tested", {static_cast<double>(choice.tested)}},
                        {"explained", {choice.explained}},
                        {"explained_before", {choice.explained_before}}}};
}

} // namespace

Facts
describe(const Stretch& stretch, const std::optional<pcl_uvol::ScaleChoice>& choice)
{
  Facts facts = {{"scale", toNumbers(stretch.scale)}};
  if ((stretch.rotation != 0.0).any())
    facts.emplace_back("rotation", toNumbers(stretch.rotation));
  if (choice)
    facts.push_back(describeChoice(*choice));
  return facts;
}

} // namespace uvol_tools
