// SPDX-License-Identifier: BSD-3-Clause
#include "uvol_probe/interpolation_options.h"

#include "common/printable.h"
#include "common/records.h"
#include "common/sample_checks.h"
#include "common/scalar_field.h"
#include "common/scalar_names.h"
#include "shared/point_files.h"
#include <pcl_uvol/common/cloud_view.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace uvol_tools {

using pcl_uvol::Folds;
using pcl_uvol::InterpolationModel;
using pcl_uvol::InterpolationParameters;

void
InterpolationOptions::declare(Options& options)
{
  constexpr double most = std::numeric_limits<double>::max();
  options.text(
      "field",
      "a,b,...|all",
      fields_,
      "scalar fields: density, vel[1], |vel|, |vx,vy,vz|, or expressions: log10(rho), "
      "|grad(rho)|, Q(vel) (default: intensity, else the only candidate)");
  options.choice(
      "model",
      parameters_.model,
      "blended local polynomials; nearest sample; inverse distances; Sibson's or "
      "Laplace's natural neighbours; kriging; sums of SPH kernels; auto: the best in "
      "cross-validation");
  options.flag("extrapolate",
               parameters_.extrapolate,
               "also give values outside of the data (default: nan)");
  options.flag("gradients", parameters_.gradients, "write gradients as well");
  options
      .integer("k",
               k_,
               1,
               512,
               "number of nearest samples for kriging (default 32) and shepard (16); "
               "with sph, kernels end at this neighbour (48)")
      .rare();
  options
      .text("variogram",
            "kind[,nugget,psill,range]",
            variogram_,
            "variogram model of kriging: spherical, exponential, gaussian, matern32 or "
            "matern52; nugget, partial sill (sill less nugget) and range (default "
            "spherical, fitted to the samples)")
      .rare();
  options
      .integer("trend",
               parameters_.kriging.trend,
               0,
               2,
               "degree of the polynomial of the mean, with kriging")
      .rare();
  options
      .flag("octants",
            parameters_.kriging.octants,
            "with kriging: an eighth of the samples from each octant")
      .rare();
  options
      .numbers("block",
               "dx,dy,dz",
               3,
               block_,
               "with kriging: estimate the mean of a block with these sides around "
               "each position, with its standard error")
      .rare();
  options
      .number("power",
              parameters_.shepard.power,
              std::numeric_limits<double>::min(),
              most,
              "power of the inverse distance, with shepard")
      .rare();
  options.choice("kernel", parameters_.sph.kernel, "kernel of sph").rare();
  options
      .text("smoothing-length",
            "field",
            parameters_.sph.length_field,
            "with sph: the field h of the particles")
      .rare();
  options
      .text("mass",
            "field",
            parameters_.sph.mass_field,
            "with sph: masses (default: equal)")
      .rare();
  scale_.declare(options, "distances", AutomaticScale::Field);
  options.integer("validate",
                  folds_,
                  2,
                  1000,
                  "n-fold cross-validation: report the errors of values at held-out "
                  "samples");
  options
      .text("validate-by",
            "random|blocks|FIELD",
            validate_by_,
            "samples held out together: random ones, compact blocks, or those with the "
            "same value of a field, such as a drill hole (default random)")
      .rare();
}

void
InterpolationOptions::finish(const Options& options)
{
  parseNames("field", fields_);
  scale_.finish(options);
  checkModel(options);
  if (!options.given("gradients"))
    parameters_.gradients = false;
  if (options.given("validate-by") && folds_ == 0)
    throw UsageError("-validate-by needs -validate.");
  if (!variogram_.empty())
    parseVariogram();
  if (!block_.empty()) {
    if (folds_ > 0)
      throw UsageError("-validate compares values at samples, and -block estimates the "
                       "means of blocks.");
    parameters_.kriging.block =
        Eigen::Map<const Eigen::Array3d>(block_.data()).cast<float>();
  }
  if (k_ > 0)
    parameters_.kriging.k = parameters_.shepard.k = parameters_.sph.k = k_;
  checkParameters(parameters_);
}

void
InterpolationOptions::checkModel(const Options& options) const
{
  const auto check = [&](const char* option,
                         std::initializer_list<InterpolationModel> models,
                         const char* words) {
    const bool fits =
        parameters_.model == InterpolationModel::Auto ||
        std::find(models.begin(), models.end(), parameters_.model) != models.end();
    if (options.given(option) && !fits)
      throw UsageError(std::string("-") + option + " needs -model " + words + ".");
  };
  check("k",
        {InterpolationModel::Kriging,
         InterpolationModel::Shepard,
         InterpolationModel::Sph},
        "kriging, shepard or sph");
  for (const char* const option : {"variogram", "trend", "octants", "block"})
    check(option, {InterpolationModel::Kriging}, "kriging");
  check("power", {InterpolationModel::Shepard}, "shepard");
  for (const char* const option : {"kernel", "smoothing-length", "mass"})
    check(option, {InterpolationModel::Sph}, "sph");
}

void
InterpolationOptions::parseVariogram()
{
  const std::size_t comma = std::min(variogram_.find(','), variogram_.size());
  pcl_uvol::KrigingParameters& kriging = parameters_.kriging;
  if (!fromWord(variogram_.substr(0, comma), kriging.variogram))
    throw UsageError("-variogram starts with spherical, exponential, gaussian, "
                     "matern32 or matern52, not " +
                     pcl_uvol::quoteText(variogram_) + ".");
  if (comma == variogram_.size())
    return;
  const auto numbers = parseNumbers("variogram", variogram_.substr(comma + 1), 3);
  kriging.nugget = numbers[0];
  kriging.psill = numbers[1];
  kriging.range = numbers[2];
}

InterpolationParameters
InterpolationOptions::resolve(const Options& options,
                              pcl_uvol::Dataset& samples,
                              pcl_uvol::Report& report,
                              Facts& facts) const
{
  const auto& fields = samples.cloud.fields;
  InterpolationParameters parameters = parameters_;
  if (fields_.empty())
    parameters.fields = {pcl_uvol::chooseField(samples, "")};
  else if (fields_ == "all" && pcl_uvol::findField(fields, "all") == nullptr)
    parameters.fields = pcl_uvol::listScalars(pcl_uvol::listNumberFields(samples));
  else
    parameters.fields = parseFieldNames("field", fields_, samples);
  for (std::string& field : parameters.fields) {
    addField(samples, field, options, report);
    pcl_uvol::refuseNames(samples, field);
  }
  // The first one of several fields tells how distances are measured.
  const auto stretch = scale_.resolve(pcl_uvol::viewOf(samples.cloud),
                                      parameters.fields.front(),
                                      options.threads(),
                                      report,
                                      facts);
  parameters.scale = stretch.scale;
  parameters.rotation = stretch.rotation;
  return parameters;
}

Folds
InterpolationOptions::makeFolds(const pcl_uvol::Dataset& samples,
                                unsigned threads) const
{
  const pcl_uvol::CloudView view = pcl_uvol::viewOf(samples.cloud);
  if (validate_by_ == "random")
    return Folds::byRandom(view.count, folds_);
  if (validate_by_ == "blocks")
    return Folds::byBlocks(view, folds_, threads);
  return Folds::byField(view, validate_by_, folds_);
}

pcl_uvol::ModelChoice
InterpolationOptions::chooseModel(const pcl_uvol::Dataset& samples,
                                  const pcl::Indices& indices,
                                  const InterpolationParameters& parameters,
                                  unsigned threads,
                                  pcl_uvol::Report& report) const
{
  const pcl_uvol::CloudView cloud = pcl_uvol::viewOf(samples.cloud);
  if (!hasValidation() || validate_by_ == "random")
    return pcl_uvol::chooseModel(cloud, indices, parameters, threads, report);
  return pcl_uvol::chooseModel(
      cloud, indices, parameters, makeFolds(samples, threads), threads, report);
}

Facts
InterpolationOptions::validate(const pcl_uvol::Dataset& samples,
                               const pcl::Indices& indices,
                               const InterpolationParameters& parameters,
                               unsigned threads,
                               pcl_uvol::Report& report) const
{
  const pcl_uvol::StepTimer timer(report, "validation");
  const auto scores = crossValidate(pcl_uvol::viewOf(samples.cloud),
                                    indices,
                                    parameters,
                                    makeFolds(samples, threads),
                                    0,
                                    threads,
                                    report);
  Facts facts, of_fields;
  for (const pcl_uvol::FieldScore& score : scores) {
    FactText text;
    text.precision(4);
    if (score.covered == 0)
      text << "no error is measured";
    else
      text << "RMS " << score.rms << ", bias " << score.bias;
    if (!std::isnan(score.share))
      text << ", " << std::round(1000.0 * score.share) / 10.0
           << " % within their standard error";
    text << ", at " << score.covered << " of " << score.tested << " held-out samples";
    of_fields.emplace_back(
        score.field,
        text.str(),
        Fact::Members{{"rms", {score.rms}},
                      {"bias", {score.bias}},
                      {"share_within_error", {score.share}},
                      {"tested", {static_cast<double>(score.tested)}},
                      {"covered", {static_cast<double>(score.covered)}}});
    facts.push_back(
        Fact("validation of " + score.field, of_fields.back().getText()).withoutJson());
  }
  facts.emplace_back("validation", of_fields);
  return facts;
}

Facts
describe(const pcl_uvol::ModelChoice& choice)
{
  FactText text;
  text.precision(3);
  Facts errors;
  for (const pcl_uvol::ModelScore& score : choice.scores) {
    text << (errors.empty() ? "" : ", ") << toWord(score.model) << ' ' << score.error;
    errors.emplace_back(toWord(score.model), score.error);
  }
  text << " (RMS errors by the spread of the field, at " << choice.tested
       << " values left out)";
  return {Fact("compared", text.str()).withoutJson(), Fact("compared_models", errors)};
}

} // namespace uvol_tools
