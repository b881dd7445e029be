// SPDX-License-Identifier: BSD-3-Clause
#include "shared/measure_table.h"

#include "common/number_range.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

namespace uvol_tools {

using pcl_uvol::InnerFieldMeasures;
using pcl_uvol::Measure;
using pcl_uvol::PieceMeasures;
using pcl_uvol::SampleSum;
using pcl_uvol::SurfaceFieldMeasures;

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

constexpr const char* axis_names[] = {"x", "y", "z"};

std::string
plural(std::int64_t count, const std::string& thing)
{
  return std::to_string(count) + " " + thing + (std::abs(count) == 1 ? "" : "s");
}

std::string
describeSize(const PieceMeasures& surface, std::int64_t pieces)
{
  std::string text = "area " + describe(surface.area);
  if (surface.cap_area > 0.0) {
    FactText caps;
    caps << " (caps " << surface.cap_area << ")";
    text += caps.str();
  }
  if (surface.rims == 0)
    text += ", volume " + describe(surface.volume);
  else
    text += surface.triangles == 0
                ? ", open"
                : ", open at " + plural(surface.rims, "boundary loop");
  text += ", " + plural(pieces, "piece");
  if (surface.genus)
    text += ", genus " + std::to_string(*surface.genus);
  if (!surface.inside.empty())
    text += ", " + plural(surface.samples, "sample") + " inside";
  if (surface.samples_beyond)
    text += ", " + plural(*surface.samples_beyond, "sample") + " beyond the isovalue";
  return text;
}

/** Centroid, half axes and fields of a surface. */
void
describeParts(const PieceMeasures& surface, const std::string& of, Facts& facts)
{
  const auto add = [&](const std::string& name, const std::string& text) {
    facts.push_back(Fact(name + of, text).withoutJson());
  };
  const auto vector = [](const Eigen::Vector3d& numbers) {
    FactText text;
    text << numbers[0] << ", " << numbers[1] << ", " << numbers[2];
    return text.str();
  };
  add("centroid", vector(surface.centroid));
  add("half axes", vector(surface.half_axes));
  for (const SurfaceFieldMeasures& field : surface.on_surface) {
    FactText mean;
    mean << field.mean;
    add(field.name + " on the surface",
        "mean " + mean.str() + ", integral " + describe(field.integral));
  }
  const auto describeBeyond = [&](std::size_t field) {
    FactText sum;
    if (field < surface.sums_beyond.size())
      sum << ", sum beyond the isovalue " << surface.sums_beyond[field].sum;
    return sum.str();
  };
  for (std::size_t i = 0; i < surface.inside.size(); ++i) {
    const InnerFieldMeasures& field = surface.inside[i];
    FactText mean, sum;
    mean << field.mean;
    sum << field.sum;
    add(field.name + " inside",
        "mean " + mean.str() + ", integral " + describe(field.integral) +
            ", sum of samples " + sum.str() + describeBeyond(i));
  }
  if (surface.inside.empty())
    for (const SampleSum& field : surface.sums_beyond) {
      FactText sum;
      sum << field.sum;
      add(field.name + " beyond the isovalue", "sum of samples " + sum.str());
    }
}

} // namespace

std::string
describe(const Measure& measure)
{
  FactText text;
  if (!std::isfinite(measure.value))
    return "unknown";
  if (measure.error > 0.0 && std::isfinite(measure.error)) {
    const double digits =
        std::floor(std::log10(std::abs(measure.value) / measure.error)) + 3.0;
    text.precision(static_cast<int>(std::clamp(digits, 2.0, 12.0)));
  }
  text << measure.value;
  FactText error;
  error.precision(2);
  error << measure.error;
  return text.str() + " +- " + error.str();
}

pcl_uvol::SurfaceFigures
measureSurface(const std::shared_ptr<const pcl_uvol::Dataset>& vertices,
               const std::vector<pcl_uvol::Triangle>& triangles,
               const std::shared_ptr<const pcl_uvol::Dataset>& samples,
               const std::vector<double>& isovalues,
               const pcl_uvol::SurfaceMeasuresParameters& parameters,
               unsigned threads,
               pcl_uvol::Report& report)
{
  pcl_uvol::SurfaceMeasures measures;
  measures.setInputSurface(vertices, triangles);
  measures.setInputSamples(samples);
  measures.setParameters(parameters);
  measures.setNumberOfThreads(threads);
  measures.setProgressCallback(report.progress);
  pcl_uvol::SurfaceFigures figures = measures.compute();
  for (auto* const list : {&figures.isovalues, &figures.pieces})
    for (PieceMeasures& surface : *list)
      for (const double isovalue : isovalues)
        if (surface.isovalue == static_cast<double>(static_cast<float>(isovalue)))
          surface.isovalue = isovalue;
  // The surface has told the samples' counts already.
  const pcl_uvol::Report& own = measures.getReport();
  if (parameters.find_intersections)
    report.setCount("intersections", figures.intersections.size());
  for (const auto& [step, milliseconds] : own.milliseconds)
    report.time(step, milliseconds);
  report.warn(own.warnings);
  return figures;
}

MeasureTable::MeasureTable(const std::vector<PieceMeasures>& isovalues)
{
  for (const PieceMeasures& all : isovalues)
    addRow(all, -1.0);
}

void
MeasureTable::append(const std::vector<PieceMeasures>& pieces)
{
  double number = 0.0;
  for (const PieceMeasures& piece : pieces)
    addRow(piece, number++);
}

void
MeasureTable::append(const MeasureTable& rows)
{
  const std::size_t before = countRows(), after = before + rows.countRows();
  for (const auto& [name, numbers] : rows.columns_) {
    Fact::Numbers& own = column(name);
    own.resize(before, none);
    own.insert(own.end(), numbers.begin(), numbers.end());
  }
  for (auto& [name, numbers] : columns_)
    numbers.resize(after, none);
}

void
MeasureTable::prepend(const std::string& name, double number)
{
  columns_.emplace(columns_.begin(), name, Fact::Numbers(countRows(), number));
}

Fact::Numbers&
MeasureTable::column(const std::string& name)
{
  const auto at = std::find_if(columns_.begin(),
                               columns_.end(),
                               [&](const auto& known) { return known.first == name; });
  if (at != columns_.end())
    return at->second;
  return columns_.emplace_back(name, Fact::Numbers(countRows(), none)).second;
}

void
MeasureTable::addRow(const PieceMeasures& measures, double piece)
{
  const std::size_t rows = countRows();
  const auto put = [&](const std::string& name, double number) {
    Fact::Numbers& numbers = column(name);
    numbers.resize(rows, none);
    numbers.push_back(number);
  };
  const auto putMeasure = [&](const std::string& name, const Measure& measure) {
    put(name, measure.value);
    put(name + "_error", measure.error);
  };
  put("isovalue", measures.isovalue);
  put("piece", piece);
  put("vertices", measures.vertices);
  put("triangles", measures.triangles);
  put("rims", measures.rims);
  put("genus", measures.genus ? static_cast<double>(*measures.genus) : none);
  putMeasure("area", measures.area);
  putMeasure("volume", measures.volume);
  if (measures.triangles > 0) {
    put("cap_area", measures.cap_area);
    put("capped_volume", measures.capped_volume);
  }
  for (int axis = 0; axis < 3; ++axis)
    put(axis_names[axis], measures.centroid[axis]);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    put(std::string("low_") + axis_names[axis], measures.low[axis]);
    put(std::string("high_") + axis_names[axis], measures.high[axis]);
  }
  for (int i = 0; i < 3; ++i) {
    const std::string number = std::to_string(i + 1);
    put("half_axis_" + number, measures.half_axes[i]);
    for (int axis = 0; axis < 3; ++axis)
      put("axis_" + number + "_" + axis_names[axis], measures.axes(axis, i));
  }
  for (const SurfaceFieldMeasures& field : measures.on_surface) {
    put(field.name + "_surface_mean", field.mean);
    putMeasure(field.name + "_surface_integral", field.integral);
  }
  if (!measures.inside.empty())
    put("samples", static_cast<double>(measures.samples));
  for (const InnerFieldMeasures& field : measures.inside) {
    put(field.name + "_volume_mean", field.mean);
    putMeasure(field.name + "_volume_integral", field.integral);
    put(field.name + "_sample_sum", field.sum);
  }
  if (measures.samples_beyond)
    put("samples_beyond", static_cast<double>(*measures.samples_beyond));
  for (const SampleSum& field : measures.sums_beyond)
    put(field.name + "_beyond_sum", field.sum);
  // What an open surface among closed ones has not.
  for (auto& [name, numbers] : columns_)
    numbers.resize(rows + 1, none);
}

const Fact::Numbers*
MeasureTable::find(const std::string& name) const
{
  for (const auto& [other, numbers] : columns_)
    if (other == name)
      return &numbers;
  return nullptr;
}

pcl_uvol::Dataset
MeasureTable::toDataset() const
{
  pcl_uvol::Dataset dataset;
  dataset.double_coordinates = true;
  dataset.cloud.height = 1;
  const std::size_t rows = countRows();
  dataset.cloud.width = static_cast<std::uint32_t>(rows);
  std::vector<double> xyz;
  for (std::size_t i = 0; i < rows; ++i)
    for (const char* const name : axis_names)
      xyz.push_back((*find(name))[i]);
  pcl_uvol::setCoordinates(dataset, xyz);
  for (const auto& [name, numbers] : columns_)
    if (std::find(std::begin(axis_names), std::end(axis_names), name) ==
        std::end(axis_names))
      pcl_uvol::setField(dataset, name, numbers);
  return dataset;
}

Facts
describeMeasures(const pcl_uvol::SurfaceFigures& figures)
{
  constexpr std::size_t most_described = 3;
  Facts facts;
  std::vector<double> isovalues;
  for (const PieceMeasures& all : figures.isovalues)
    isovalues.push_back(all.isovalue);
  const std::vector<std::string> names = pcl_uvol::describeNumbers(isovalues);
  for (std::size_t i = 0; i < isovalues.size(); ++i) {
    const PieceMeasures& all = figures.isovalues[i];
    const std::string of = std::isnan(all.isovalue) ? "" : " at " + names[i];
    const auto pieces = std::count_if(
        figures.pieces.begin(), figures.pieces.end(), [&](const PieceMeasures& piece) {
          return std::isnan(all.isovalue) || piece.isovalue == all.isovalue;
        });
    facts.push_back(Fact("surface" + of, describeSize(all, pieces)).withoutJson());
    if (isovalues.size() <= most_described)
      describeParts(all, of, facts);
  }
  facts.emplace_back("surfaces", "", MeasureTable(figures.isovalues).getColumns());
  MeasureTable pieces{std::vector<PieceMeasures>()};
  pieces.append(figures.pieces);
  facts.emplace_back("pieces", "", pieces.getColumns());
  return facts;
}

} // namespace uvol_tools
