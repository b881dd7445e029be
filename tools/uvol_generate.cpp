// SPDX-License-Identifier: BSD-3-Clause
// Test data: analytic fields, resampled volumes, points on meshes.
#include "common/parallel.h"
#include "common/random.h"
#include "generation/analytic_fields.h"
#include "generation/mesh_scatter.h"
#include "shared/options.h"
#include "shared/point_files.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/io/dataset.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <iterator>
#include <utility>

namespace {

using pcl_uvol::Report;
using pcl_uvol::StepTimer;

struct Arguments {
  std::string input, output, field = "radial", scatter = "uniform";
  std::uint64_t n = 1000000, seed = 1;
  double noise = 0.0;
  bool ascii = false;
};

constexpr std::size_t block_points = 1u << 14;

/** A dataset of n points of float fields, zero. */
pcl_uvol::Dataset
makeDataset(const std::vector<std::string>& names, std::uint64_t n)
{
  pcl_uvol::Dataset dataset;
  auto& cloud = dataset.cloud;
  for (const std::string& name : names) {
    pcl::PCLPointField field;
    field.name = name;
    field.offset = cloud.point_step;
    field.datatype = pcl::PCLPointField::FLOAT32;
    field.count = 1;
    cloud.fields.push_back(field);
    cloud.point_step += sizeof(float);
  }
  cloud.height = 1;
  cloud.width = static_cast<std::uint32_t>(n);
  cloud.row_step = cloud.point_step * cloud.width;
  cloud.data.resize(static_cast<std::size_t>(cloud.point_step) * n);
  cloud.is_dense = 1;
  return dataset;
}

/** Change every point by fill(index, floats of the point). */
template <typename Fill>
void
fillPoints(pcl_uvol::Dataset& dataset, unsigned threads, const Fill& fill)
{
  auto& cloud = dataset.cloud;
  pcl_uvol::parallelBlocks(
      cloud.width, block_points, threads, [&](std::size_t begin, std::size_t end) {
        std::vector<float> point(cloud.fields.size());
        for (std::size_t i = begin; i < end; ++i) {
          std::uint8_t* const bytes = &cloud.data[i * cloud.point_step];
          std::memcpy(point.data(), bytes, cloud.point_step);
          fill(i, point);
          std::memcpy(bytes, point.data(), cloud.point_step);
        }
      });
}

/** Give every point the scalar of the place that is written. Not in one pass with the
 * positions: g++ 12 then leaves their rounding to float out. */
template <typename Function>
void
fillValues(pcl_uvol::Dataset& dataset,
           const Arguments& arguments,
           unsigned threads,
           const Function& value)
{
  fillPoints(dataset, threads, [&](std::size_t i, std::vector<float>& point) {
    const std::array<double, 3> position{{point[0], point[1], point[2]}};
    point[3] = static_cast<float>(
        value(position) + arguments.noise * pcl_uvol::normalAt(arguments.seed, i, 7));
  });
}

constexpr std::pair<const char*, pcl_uvol::Scatter> scatters[] = {
    {"uniform", pcl_uvol::Scatter::Uniform},
    {"jittered", pcl_uvol::Scatter::Jittered},
    {"lattice", pcl_uvol::Scatter::Lattice},
    {"clustered", pcl_uvol::Scatter::Clustered},
    {"tracks", pcl_uvol::Scatter::Tracks},
    {"casts", pcl_uvol::Scatter::Casts},
    {"holes", pcl_uvol::Scatter::Holes}};

std::vector<std::string>
listScatters()
{
  std::vector<std::string> names;
  for (const auto& scatter : scatters)
    names.emplace_back(scatter.first);
  return names;
}

pcl_uvol::Scatter
parseScatter(const std::string& name)
{
  return std::find_if(std::begin(scatters),
                      std::end(scatters),
                      [&](const auto& known) { return known.first == name; })
      ->second;
}

/** Tell the lines apart that samples lie on: by numbers, and holes by names. */
void
addLines(pcl_uvol::Scatter scatter, pcl_uvol::Dataset& dataset)
{
  std::vector<std::int32_t> lines;
  for (std::uint64_t i = 0; i < dataset.cloud.width; ++i)
    lines.push_back(
        static_cast<std::int32_t>(pcl_uvol::lineOf(scatter, i, dataset.cloud.width)));
  const char* const name = scatter == pcl_uvol::Scatter::Tracks  ? "track"
                           : scatter == pcl_uvol::Scatter::Casts ? "cast"
                                                                 : "hole";
  setField(dataset, name, lines);
  if (scatter != pcl_uvol::Scatter::Holes)
    return;
  const std::size_t digits = std::to_string(lines.back() + 1).size();
  for (std::int32_t line = 1; line <= lines.back() + 1; ++line) {
    const std::string number = std::to_string(line);
    dataset.labels[name].push_back("DH-" + std::string(digits - number.size(), '0') +
                                   number);
  }
}

pcl_uvol::Dataset
generateField(const Arguments& arguments, unsigned threads)
{
  const auto& field = pcl_uvol::findAnalyticField(arguments.field);
  const auto scatter = parseScatter(arguments.scatter);
  const std::uint64_t n = pcl_uvol::scatterCount(scatter, arguments.n);
  // The thesis's test keeps the mean spacing at 1, whatever the number of samples.
  const double factor =
      arguments.field == "radial" ? std::cbrt(static_cast<double>(n) / 4e6) : 1.0;
  auto dataset = makeDataset({"x", "y", "z", field.name}, n);
  fillPoints(dataset, threads, [&](std::size_t i, std::vector<float>& point) {
    const auto position = pcl_uvol::scatterAt(
        scatter, arguments.seed, i, n, factor * field.lower, factor * field.upper);
    std::transform(position.begin(),
                   position.end(),
                   point.begin(),
                   [](double coordinate) { return static_cast<float>(coordinate); });
  });
  fillValues(dataset, arguments, threads, field.value);
  if (pcl_uvol::isOnLines(scatter))
    addLines(scatter, dataset);
  return dataset;
}

pcl_uvol::Dataset
resampleVolume(const Arguments& arguments, unsigned threads)
{
  const pcl_uvol::Volume volume = pcl_uvol::loadVolume(arguments.input);
  const auto upper = volume.upper();
  auto dataset = makeDataset({"x", "y", "z", volume.name}, arguments.n);
  fillPoints(dataset, threads, [&](std::size_t i, std::vector<float>& point) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      point[axis] = static_cast<float>(
          volume.origin[axis] + (upper[axis] - volume.origin[axis]) *
                                    pcl_uvol::uniformAt(arguments.seed, i, axis));
  });
  fillValues(dataset, arguments, threads, [&](const std::array<double, 3>& position) {
    return volume.sample(position);
  });
  return dataset;
}

pcl_uvol::Dataset
scatterMesh(const Arguments& arguments, unsigned threads)
{
  const pcl_uvol::Mesh mesh = pcl_uvol::loadMesh(arguments.input);
  const auto points = pcl_uvol::scatterOverMesh(mesh, arguments.n, arguments.seed);
  auto dataset =
      makeDataset({"x", "y", "z", "normal_x", "normal_y", "normal_z"}, points.size());
  dataset.origin = mesh.origin;
  fillPoints(dataset, threads, [&](std::size_t i, std::vector<float>& point) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      point[axis] = points[i].position[axis] +
                    static_cast<float>(arguments.noise *
                                       pcl_uvol::normalAt(arguments.seed, i, 7 + axis));
      point[3 + axis] = points[i].normal[axis];
    }
  });
  return dataset;
}

int
run(int argc, char** argv)
{
  Arguments arguments;
  std::string first, second;
  std::string purpose =
      "Generate scattered samples of an analytic field, a volume (nrrd nhdr vti mha "
      "mhd)\n"
      "or a mesh (ply vtp vtkhdf obj off stl; evenly spread).\n\n"
      "Fields and isovalues:";
  for (const auto& field : pcl_uvol::analyticFields()) {
    purpose += std::string("\n  ") + field.name + ": " + field.description + ", -iso ";
    for (std::size_t i = 0; i < field.isovalues.size(); ++i) {
      char text[32];
      std::snprintf(text, sizeof(text), "%s%g", i > 0 ? "," : "", field.isovalues[i]);
      purpose += text;
    }
  }
  uvol_tools::Options options(
      "uvol_generate", "[in.nhdr|in.ply] out.pcd [options]", purpose);
  options.file("out", first);
  options.file("out", second, false);
  options.group("Samples");
  options.integer("n", arguments.n, 1, 4000000000ULL, "number of points");
  options.text("field", "name", arguments.field, "analytic field (default radial)");
  options.choice("samples",
                 listScatters(),
                 arguments.scatter,
                 "how samples of a field are scattered; tracks of a robot, casts of a "
                 "ship and drill holes have a field that identifies the line");
  options.number(
      "noise",
      arguments.noise,
      0.0,
      1e30,
      "standard deviation of noise added to the scalar, or to points of a mesh");
  options.integer(
      "seed", arguments.seed, 0, ~std::uint64_t(0), "seed of all randomness");
  options.group("Output");
  options.flag("ascii", arguments.ascii, "write PCD and PLY as text");
  if (!options.parse(argc, argv))
    return 0;
  arguments.input = second.empty() ? "" : first;
  arguments.output = second.empty() ? first : second;
  if (!arguments.input.empty() && (options.given("field") || options.given("samples")))
    throw uvol_tools::UsageError(
        "-field and -samples belong to analytic fields, not to " + arguments.input +
        ".");
  pcl_uvol::checkSavePath(arguments.output);

  Report report;
  pcl_uvol::Dataset dataset;
  {
    const StepTimer timer(report, "generate");
    dataset = arguments.input.empty() ? generateField(arguments, options.threads())
              : pcl_uvol::isVolumeFile(arguments.input)
                  ? resampleVolume(arguments, options.threads())
                  : scatterMesh(arguments, options.threads());
  }
  pcl_uvol::SaveOptions save;
  save.ascii = arguments.ascii;
  uvol_tools::savePoints(arguments.output, dataset, save, report);
  report.count("points", dataset.cloud.width);
  uvol_tools::printReport(options, report, {{"output", arguments.output}});
  return 0;
}

} // namespace

int
main(int argc, char** argv)
{
  return uvol_tools::runTool("uvol_generate", [&] { return run(argc, argv); });
}
