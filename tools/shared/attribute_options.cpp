// SPDX-License-Identifier: BSD-3-Clause
#include "shared/attribute_options.h"

#include "common/sample_checks.h"
#include "common/scalar_field.h"
#include "shared/point_files.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/isosurface/isosurface_extraction.h>

#include <pcl/conversions.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace uvol_tools {

void
AttributeOptions::declare(Options& options)
{
  options.text("attributes",
               "a,b,...",
               text_,
               "fields that span the space: rho, vel[1], |vel|, |vx,vy,vz|, log10(u)");
  options.flag("position", has_position_, "add x, y and z to the attributes");
  options.flag("raw",
               is_standardized_,
               "take attributes in their units, not in standard deviations",
               false);
}

std::vector<std::string>
AttributeOptions::required() const
{
  std::vector<std::string> names =
      names_.empty() ? parseNames("attributes", text_) : names_;
  if (has_position_)
    for (const char* const axis : {"x", "y", "z"})
      if (std::find(names.begin(), names.end(), axis) == names.end())
        names.emplace_back(axis);
  if (names.empty())
    throw UsageError("-attributes is missing: name the fields to look at, as in "
                     "-attributes rho,u.");
  return names;
}

void
AttributeOptions::addFields(const Options& options,
                            pcl_uvol::Dataset& dataset,
                            pcl_uvol::Report& report)
{
  names_ = parseFieldNames("attributes", text_, dataset);
  for (std::string& name : names_) {
    addField(dataset, name, options, report);
    pcl_uvol::refuseNames(dataset, name);
  }
}

pcl_uvol::Clustering
AttributeOptions::cluster(const Options& options,
                          const pcl_uvol::Dataset& dataset,
                          const pcl_uvol::ClusteringParameters& parameters,
                          pcl_uvol::Report& report) const
{
  checkPosition(dataset);
  pcl_uvol::DensityClustering<pcl::PCLPointCloud2> clustering;
  clustering.setInputCloud(
      pcl::PCLPointCloud2::ConstPtr(&dataset.cloud, [](const void*) {}));
  clustering.setParameters(parameters);
  clustering.setAttributes(required());
  clustering.setStandardized(is_standardized_);
  clustering.setNumberOfThreads(options.threads());
  clustering.setProgressCallback(report.progress);
  pcl_uvol::Clustering found;
  clustering.compute(found.labels);
  report.merge(clustering.getReport());
  found.probabilities = clustering.getProbabilities();
  found.tree = clustering.getTree();
  return found;
}

pcl_uvol::ProjectedPoints
AttributeOptions::project(const Options& options,
                          const pcl_uvol::Dataset& dataset,
                          const std::string& label,
                          pcl_uvol::ProjectionMethod method,
                          pcl_uvol::Report& report) const
{
  checkPosition(dataset);
  const pcl_uvol::CloudView cloud = pcl_uvol::viewOf(dataset.cloud);
  pcl_uvol::StarCoordinates<pcl::PCLPointCloud2> star;
  star.setInputCloud(pcl::PCLPointCloud2::ConstPtr(&dataset.cloud, [](const void*) {}));
  pcl_uvol::StarCoordinateParameters parameters;
  parameters.attributes = required();
  parameters.is_standardized = is_standardized_;
  parameters.method = method;
  star.setParameters(parameters);
  if (const std::string field = labelField(cloud, label); !field.empty())
    star.setLabels(readLabels(cloud, field));
  star.setNumberOfThreads(options.threads());
  star.setProgressCallback(report.progress);
  pcl::PointCloud<pcl::PointXYZ> points;
  star.compute(points);
  report.merge(star.getReport());
  return star.getResult();
}

void
AttributeOptions::checkPosition(const pcl_uvol::Dataset& dataset) const
{
  if (has_position_ && !dataset.has_coordinates)
    throw pcl_uvol::InvalidArgument("no_coordinates_for", {});
}

pcl_uvol::LoadOptions
withoutPositions(const InputOptions& reading)
{
  pcl_uvol::LoadOptions load = reading.makeLoadOptions();
  load.needs_coordinates = false;
  return load;
}

std::string
labelField(const pcl_uvol::CloudView& cloud, const std::string& asked_for)
{
  if (!asked_for.empty())
    return asked_for;
  return pcl_uvol::findField(cloud.fields, "label") != nullptr ? "label" : "";
}

std::vector<std::int32_t>
readLabels(const pcl_uvol::CloudView& cloud, const std::string& field)
{
  const pcl_uvol::ScalarField scalar(cloud.fields, field);
  std::vector<std::int32_t> labels(cloud.count, -1);
  for (std::size_t i = 0; i < cloud.count; ++i) {
    const double value = scalar.read(cloud.point(i));
    if (!std::isfinite(value))
      continue;
    if (value != std::round(value) ||
        std::abs(value) > std::numeric_limits<std::int32_t>::max())
      throw pcl_uvol::InvalidArgument("labels_not_integers", {{"field", field}});
    labels[i] = static_cast<std::int32_t>(value);
  }
  return labels;
}

pcl_uvol::Dataset
takePoints(const pcl_uvol::Dataset& dataset, const std::vector<std::uint32_t>& points)
{
  const pcl_uvol::CloudView cloud = pcl_uvol::viewOf(dataset.cloud);
  std::vector<std::array<float, 3>> places;
  places.reserve(points.size());
  for (const std::uint32_t point : points) {
    const float* const p = cloud.xyz(point);
    places.push_back({{p[0], p[1], p[2]}});
  }
  pcl_uvol::Dataset result = takePoints(dataset, points, places);
  result.origin = dataset.origin;
  result.double_coordinates = dataset.double_coordinates;
  return result;
}

pcl_uvol::Dataset
takePoints(const pcl_uvol::Dataset& dataset,
           const std::vector<std::uint32_t>& points,
           const std::vector<std::array<float, 3>>& places)
{
  pcl::PointCloud<pcl::PointXYZ> cloud;
  cloud.reserve(places.size());
  for (const auto& place : places)
    cloud.push_back({place[0], place[1], place[2]});
  pcl_uvol::Dataset result;
  pcl::toPCLPointCloud2(cloud, result.cloud);
  pcl_uvol::copyFields(dataset.cloud, points, result.cloud);
  result.labels = dataset.labels;
  return result;
}

} // namespace uvol_tools
