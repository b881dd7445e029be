// SPDX-License-Identifier: BSD-3-Clause
#include "uvol_probe/variogram_output.h"

#include "charts/line_plot.h"
#include "charts/picture_file.h"
#include "io/table_file.h"
#include <pcl_uvol/common/exceptions.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <numeric>
#include <sstream>

namespace uvol_tools {

using pcl_uvol::detail::EmpiricalVariogram;
using pcl_uvol::detail::FittedVariogram;
using pcl_uvol::detail::Variogram;

namespace {

const char* const axis_names[] = {"x", "y", "z"};

std::string
writeTable(const FittedVariogram& variogram)
{
  std::ostringstream table;
  table.precision(9);
  table << "direction,distance,half_mean_square,pairs,model\n";
  const auto addRows = [&](const char* direction, const EmpiricalVariogram& empirical) {
    for (std::size_t i = 0; i < empirical.distance.size(); ++i)
      table << direction << ',' << empirical.distance[i] << ',' << empirical.value[i]
            << ',' << empirical.pairs[i] << ','
            << variogram.model.value(empirical.distance[i]) << '\n';
  };
  addRows("all", variogram.empirical.all);
  for (std::size_t axis = 0; axis < std::size(axis_names); ++axis)
    addRows(axis_names[axis], variogram.empirical.along[axis]);
  return table.str();
}

PlotDots
listDots(const std::string& name, const EmpiricalVariogram& empirical)
{
  // Means of fewer are too rough to be looked at (Journel and Huijbregts 1978, III.42).
  constexpr double fewest_pairs = 30.0;
  PlotDots dots;
  dots.name = name;
  for (std::size_t i = 0; i < empirical.distance.size(); ++i)
    if (empirical.pairs[i] >= fewest_pairs)
      dots.places.push_back({empirical.distance[i], empirical.value[i]});
  return dots;
}

Profile
makeProfile(const FittedVariogram& variogram,
            const std::string& field,
            bool is_stretched)
{
  constexpr int steps = 400;
  const EmpiricalVariogram& all = variogram.empirical.all;
  const double farthest =
      all.distance.empty() ? variogram.model.range : all.distance.back();
  Profile profile;
  profile.abscissa =
      is_stretched ? "distance of two samples, stretched" : "distance of two samples";
  profile.ordinate = "half mean square of differences: " + field;
  for (int i = 0; i <= steps; ++i) {
    // Just beyond 0 the model is the nugget already.
    const double h = farthest * std::max(i, 1) / steps;
    profile.abscissas.push_back(farthest * i / steps);
    profile.values.push_back(variogram.model.value(i == 0 ? 1e-9 * h : h));
  }
  profile.dots.push_back(listDots("all directions", all));
  for (std::size_t axis = 0; axis < std::size(axis_names); ++axis)
    profile.dots.push_back(listDots(std::string("along ") + axis_names[axis],
                                    variogram.empirical.along[axis]));
  return profile;
}

/** How many pairs of samples the model was fitted to. */
double
countPairs(const FittedVariogram& variogram)
{
  const std::vector<double>& pairs = variogram.empirical.all.pairs;
  return std::round(std::accumulate(pairs.begin(), pairs.end(), 0.0));
}

std::string
describe(const FittedVariogram& variogram)
{
  const Variogram& model = variogram.model;
  FactText text;
  text.precision(4);
  text << toWord(model.kind) << ", nugget " << model.nugget << ", partial sill "
       << model.psill << ", range " << model.range << ", from "
       << static_cast<std::uint64_t>(countPairs(variogram)) << " pairs of samples";
  return text.str();
}

} // namespace

void
VariogramOutput::declare(Options& options)
{
  options
      .output("variogram-csv",
              "out.csv",
              table_,
              "with kriging: write the variogram of the first field and its model, in "
              "all directions and along each axis")
      .check(pcl_uvol::checkTablePath)
      .rare();
  options
      .output("variogram-png",
              "out.png|.svg|.pdf",
              picture_,
              "with kriging: draw that variogram")
      .check(checkPicturePath)
      .rare();
}

void
VariogramOutput::finish(const Options& options,
                        pcl_uvol::InterpolationModel model,
                        const Paper& paper)
{
  paper_ = paper;
  for (const char* const option : {"variogram-csv", "variogram-png"})
    if (options.given(option) && model != pcl_uvol::InterpolationModel::Kriging)
      throw UsageError(std::string("-") + option + " needs -model kriging.");
}

Facts
VariogramOutput::write(const pcl_uvol::detail::FieldInterpolator& interpolator,
                       bool is_stretched) const
{
  Facts facts, of_fields;
  const auto& names = interpolator.getNames();
  for (std::size_t field = 0; field < names.size(); ++field) {
    const auto variogram = interpolator.findVariogram(field);
    if (!variogram)
      continue;
    const Variogram& model = variogram->model;
    if (!(model.nugget + model.psill > 0.0)) {
      if (field == 0 && isAskedFor())
        throw pcl_uvol::InvalidArgument("no_variogram_of_constant",
                                        {{"field", names[field]}});
      continue;
    }
    facts.push_back(
        Fact("variogram of " + names[field], describe(*variogram)).withoutJson());
    of_fields.emplace_back(names[field],
                           Facts{{"kind", toWord(model.kind)},
                                 {"nugget", model.nugget},
                                 {"psill", model.psill},
                                 {"range", model.range},
                                 {"pairs", countPairs(*variogram)}});
    if (field > 0)
      continue;
    if (!table_.empty())
      pcl_uvol::saveTable(table_, writeTable(*variogram));
    if (!picture_.empty()) {
      const PictureFile file(picture_, paper_.dots_per_inch);
      file.save(
          drawProfile(makeProfile(*variogram, names[field], is_stretched), paper_));
    }
  }
  if (!of_fields.empty())
    facts.emplace_back("variograms", of_fields);
  return facts;
}

} // namespace uvol_tools
