// SPDX-License-Identifier: BSD-3-Clause
#include "uvol_probe/probe_picture.h"

#include "charts/line_plot.h"
#include "charts/picture_file.h"
#include "charts/slice_plot.h"
#include "common/printable.h"
#include "common/scalar_field.h"
#include <pcl_uvol/common/cloud_view.h>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
#include <sstream>
#include <utility>

namespace uvol_tools {

using pcl_uvol::detail::Place;
using pcl_uvol::detail::QueryLattice;
using pcl_uvol::detail::Slice;

namespace {

using Eigen::Vector3d;

Vector3d
vectorOf(const Place& place)
{
  return Vector3d(place.data());
}

/** An axis of a slice's picture. */
struct PictureAxis {
  Vector3d direction;
  std::string name;
  AxisScale scale{}; ///< coordinates in that direction

  PictureAxis(const QueryLattice& lattice, std::size_t axis)
      : direction(vectorOf(lattice.steps[axis]) / lattice.spacing(axis))
  {
    scale.low = direction.dot(vectorOf(lattice.origin));
    scale.high = scale.low +
                 lattice.spacing(axis) * static_cast<double>(lattice.counts[axis] - 1);
    Eigen::Index along = 0;
    if (direction.maxCoeff(&along) == 1.0) {
      name = std::string(1, static_cast<char>('x' + along));
      return;
    }
    std::ostringstream text;
    text << std::setprecision(3) << "along (" << direction.x() << ", " << direction.y()
         << ", " << direction.z() << ")";
    name = text.str();
  }
};

std::string
withUnit(const std::string& name, const std::string& unit)
{
  return unit.empty() ? name : name + " (" + unit + ")";
}

} // namespace

void
ProbePicture::declare(Options& options)
{
  options.group("Picture");
  options
      .output("png",
              "out.png|.svg|.pdf",
              path_,
              "draw the first field as well, of -line or -plane; the options below "
              "are for the picture")
      .check(checkPicturePath);
  options.numbers("contours", "v,...", 0, contours_, "draw lines of these values");
  colors_.declare(options);
  options
      .number("samples",
              near_,
              0.0,
              std::numeric_limits<double>::max(),
              "draw the samples within this distance of the plane, in their colours")
      .rare();
  options.text("unit", "text", unit_, "unit of the coordinates, such as km").rare();
}

void
ProbePicture::finish(const Options& options,
                     bool is_plane,
                     bool is_line,
                     const Paper& paper)
{
  paper_ = paper;
  for (const char* const option :
       {"contours", "range", "log", "colormap", "samples", "label", "unit"})
    if (options.given(option) && path_.empty())
      throw UsageError(std::string("-") + option + " needs -png.");
  for (const char* const option : {"contours", "range", "log", "colormap", "samples"})
    if (options.given(option) && !is_plane)
      throw UsageError(std::string("-") + option + " needs -plane.");
  if (path_.empty())
    return;
  if (!is_plane && !is_line)
    throw UsageError("-png needs -plane or -line.");
  colors_.check();
}

void
ProbePicture::drawLine(const std::string& field,
                       const std::vector<double>& distances,
                       const std::vector<double>& values,
                       const std::vector<double>& errors) const
{
  const PictureFile file(path_, paper_.dots_per_inch);
  file.save(drawProfile(
      {distances, values, errors, withUnit("distance", unit_), colors_.getLabel(field)},
      paper_));
}

void
ProbePicture::drawSlice(const std::string& field,
                        const Slice& slice,
                        const std::vector<float>& values,
                        const AxisScale& of_samples,
                        const pcl_uvol::Dataset& samples,
                        PictureSeries* series,
                        pcl_uvol::Report& report) const
{
  const PictureAxis across(slice.lattice, slice.horizontal),
      up(slice.lattice, slice.vertical);
  SlicePlot plot;
  plot.width = slice.lattice.counts[slice.horizontal];
  plot.height = slice.lattice.counts[slice.vertical];
  plot.values = values;
  plot.across = across.scale;
  plot.up = up.scale;
  plot.across_label = withUnit(across.name, unit_);
  plot.up_label = withUnit(up.name, unit_);
  plot.title = colors_.getLabel(field);
  plot.map = colors_.getMap();
  const auto range = colors_.getRange();
  plot.scale =
      range ? pcl_uvol::ColorScale{(*range)[0], (*range)[1], colors_.isLogarithmic()}
            : findColorScale(values, of_samples, colors_.isLogarithmic());
  const auto hidden = std::count_if(values.begin(), values.end(), [&plot](float value) {
    return !std::isnan(value) && !plot.scale.hasPlace(value);
  });
  if (hidden > 0)
    report.warn("grey_places",
                {{"hidden", hidden},
                 {"places", values.size()},
                 {"field", pcl_uvol::shortenText(field)}});
  plot.contours = contours_;
  plot.paper = paper_;
  if (near_ >= 0.0) {
    const pcl_uvol::CloudView view = pcl_uvol::viewOf(samples.cloud);
    const pcl_uvol::ScalarField scalar(view.fields, field);
    const Vector3d origin = vectorOf(slice.lattice.origin),
                   normal = across.direction.cross(up.direction);
    for (std::size_t i = 0; i < view.count; ++i) {
      const float* const x = view.xyz(i);
      const Vector3d place =
          Vector3d(x[0], x[1], x[2]) + Vector3d(samples.origin.data());
      const double value = scalar.read(view.point(i));
      if (std::abs(normal.dot(place - origin)) <= near_ && std::isfinite(value))
        plot.samples.push_back(
            {across.direction.dot(place), up.direction.dot(place), value});
    }
  }
  if (series)
    series->add(std::move(plot), range.has_value(), path_);
  else {
    const PictureFile file(path_, paper_.dots_per_inch);
    file.save(drawSlicePlot(plot));
  }
}

} // namespace uvol_tools
