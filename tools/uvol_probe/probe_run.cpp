// SPDX-License-Identifier: BSD-3-Clause
#include "uvol_probe/probe_run.h"

#include "io/formats.h"
#include "io/lattice_file.h"
#include "neighbors/periodic_box.h"
#include "shared/point_files.h"
#include <pcl_uvol/io/dataset.h>

#include <algorithm>
#include <filesystem>

namespace uvol_tools {

using pcl_uvol::Dataset;
using pcl_uvol::InterpolatedFields;
using pcl_uvol::Report;
using pcl_uvol::StepTimer;
using pcl_uvol::detail::AnswerSummary;
using pcl_uvol::detail::Place;
using pcl_uvol::detail::QueryLattice;
using pcl_uvol::detail::Slice;
using Kind = QueryOptions::Kind;

namespace {

/** One run: the probe with what it fills. */
class Runner {
public:
  Runner(const Probe& probe, AnswerSummary& summary, Report& report)
      : probe_(probe)
      , samples_(probe.samples)
      , box_{{}, probe.sides}
      , summary_(summary)
      , report_(report)
  {
  }

  Facts
  probePoints();

  Facts
  probeLattice();

private:
  InterpolatedFields
  answer(const std::vector<Place>& queries);

  Place
  toSamples(const Place& place, const Place& origin) const;

  void
  addGlobeFields(Dataset& points) const;

  Facts
  writePoints(const InterpolatedFields& answers,
              const std::vector<pcl_uvol::Triangle>& triangles,
              Dataset& points);

  Facts
  writeLatticeAsPoints(const Slice& slice);

  Facts
  writeLattice(const Slice& slice);

  void
  drawSlice(const Slice& slice, const std::vector<float>& values);

  std::vector<pcl_uvol::LatticeArray>
  listArrays() const;

  const Probe& probe_;
  const Dataset& samples_;
  const pcl_uvol::PeriodicBox box_; ///< of the samples, with its low corner at 0
  AnswerSummary& summary_;
  Report& report_;
};

/** Put numbers in double as an array's type. */
void
putNumbers(const pcl_uvol::PutNumbers& put,
           const pcl_uvol::LatticeArray& array,
           std::size_t index,
           std::size_t first,
           std::size_t places,
           const double* numbers)
{
  if (array.datatype == pcl::PCLPointField::FLOAT64)
    return put(index, first, places, numbers);
  const std::vector<float> singles(numbers, numbers + places * array.components);
  put(index, first, places, singles.data());
}

InterpolatedFields
Runner::answer(const std::vector<Place>& queries)
{
  InterpolatedFields answers =
      probe_.interpolator.interpolate(queries, probe_.options.threads(), report_);
  summary_.add(answers);
  return answers;
}

/** The query at a place: counted from the samples' origin, and in their box.
 * \param origin that the place counts from */
Place
Runner::toSamples(const Place& place, const Place& origin) const
{
  Place query = place;
  for (std::size_t axis = 0; axis < 3; ++axis)
    query[axis] += origin[axis] - samples_.origin[axis];
  return box_.toBox(query);
}

/** Longitude and latitude of points that do not have them, if the samples are on a map.
 */
void
Runner::addGlobeFields(Dataset& points) const
{
  const auto map = findMap(samples_);
  if (!map || pcl_uvol::findGlobeFields(points.cloud.fields))
    return;
  setMap(points, *map);
  setGlobeFields(points);
}

/** Append answers to points and write them. */
Facts
Runner::writePoints(const InterpolatedFields& answers,
                    const std::vector<pcl_uvol::Triangle>& triangles,
                    Dataset& points)
{
  const auto names = appendFields(answers, points.cloud);
  std::string list;
  for (const std::string& name : names)
    list += (list.empty() ? "" : ", ") + name;
  pcl_uvol::checkSavePath(probe_.output, points.cloud.fields);
  pcl_uvol::SaveOptions save;
  save.ascii = probe_.ascii;
  const StepTimer timer(report_, "write");
  if (triangles.empty())
    saveDataset(probe_.output, points, save);
  else
    saveMesh(probe_.output, points, triangles, save);
  warnOfLosses(probe_.output, points, report_);
  return {{"appended fields", list}};
}

Facts
Runner::probePoints()
{
  const std::string& path = probe_.queries.getPoints();
  const auto ending = [](const std::string& file) {
    return std::filesystem::path(file).extension();
  };
  Dataset points;
  std::vector<pcl_uvol::Triangle> triangles;
  if (ending(path) == ".ply" && ending(probe_.output) == ".ply")
    points = loadMesh(path, triangles, report_);
  else
    points = loadPoints(path, report_, pcl_uvol::io::adaptOptions(path, probe_.load));
  std::vector<Place> queries =
      pcl_uvol::detail::readPlaces(pcl_uvol::viewOf(points.cloud));
  for (Place& query : queries)
    query = toSamples(query, points.origin);
  const InterpolatedFields answers = answer(queries);
  addGlobeFields(points);
  Facts facts = writePoints(answers, triangles, points);
  if (!triangles.empty())
    facts.emplace_back("triangles", static_cast<double>(triangles.size()));
  return facts;
}

/** The places of a lattice as points. */
Facts
Runner::writeLatticeAsPoints(const Slice& slice)
{
  const QueryLattice& lattice = slice.lattice;
  std::vector<Place> queries(lattice.size());
  std::vector<double> xyz, distances;
  xyz.reserve(3 * queries.size());
  for (std::size_t i = 0; i < queries.size(); ++i) {
    const Place place = lattice.at(i);
    queries[i] = toSamples(place, {});
    distances.push_back(static_cast<double>(i) * lattice.spacing(0));
    xyz.insert(xyz.end(), place.begin(), place.end());
  }
  const InterpolatedFields answers = answer(queries);
  Dataset points;
  points.double_coordinates = samples_.double_coordinates;
  setCoordinates(points, xyz);
  addGlobeFields(points);
  const auto first = static_cast<std::ptrdiff_t>(answers.size);
  const std::vector<double> values(answers.values.begin(),
                                   answers.values.begin() + first);
  if (probe_.queries.getKind() == Kind::Line)
    setField(points, "distance", distances);
  if (probe_.picture.isAskedFor() && probe_.queries.getKind() == Kind::Line)
    probe_.picture.drawLine(answers.names.front(),
                            distances,
                            values,
                            {answers.errors.begin(), answers.errors.begin() + first});
  else if (probe_.picture.isAskedFor())
    drawSlice(slice, {values.begin(), values.end()});
  return writePoints(answers, {}, points);
}

/** The first field as a picture. */
void
Runner::drawSlice(const Slice& slice, const std::vector<float>& values)
{
  const StepTimer timer(report_, "picture");
  const AnswerSummary::Field& field = summary_.getFields().front();
  probe_.picture.drawSlice(field.name,
                           slice,
                           values,
                           {field.sample_low, field.sample_high},
                           samples_,
                           probe_.series,
                           report_);
}

std::vector<pcl_uvol::LatticeArray>
Runner::listArrays() const
{
  using Type = pcl::PCLPointField;
  std::vector<pcl_uvol::LatticeArray> arrays;
  for (const std::string& name : probe_.interpolator.getNames()) {
    arrays.push_back(
        {name, pcl_uvol::detail::findFileType(samples_.cloud.fields, name), 1});
    arrays.push_back({name + "_error", Type::FLOAT32, 1});
    if (probe_.parameters.gradients)
      arrays.push_back({name + "_gradient", Type::FLOAT32, 3});
  }
  arrays.push_back({"support", Type::UINT8, 1});
  if (findMap(samples_))
    for (const char* const name : {"longitude", "latitude"})
      arrays.push_back({name, Type::FLOAT64, 1});
  return arrays;
}

/** Longitude (axis 0) or latitude of some places of a lattice. */
std::vector<double>
listDegrees(const pcl_uvol::MapProjection& map,
            const Slice& slice,
            std::size_t first,
            std::size_t count,
            std::size_t axis)
{
  std::vector<double> degrees;
  for (std::size_t i = first; i < first + count; ++i) {
    const Place place = slice.lattice.at(i);
    degrees.push_back(map.toGlobe(place[0], place[1])[axis]);
  }
  return degrees;
}

/** Answer the queries of a lattice a block after the other, into a file. */
Facts
Runner::writeLattice(const Slice& slice)
{
  const auto arrays = listArrays();
  const std::vector<std::string> files = pcl_uvol::latticeFiles(probe_.output, arrays);
  checkDistinct({probe_.input}, files);
  const auto map = findMap(samples_);
  std::vector<float> drawn;
  const auto take = [&](const pcl_uvol::PutNumbers& put,
                        std::size_t first,
                        const InterpolatedFields& answers) {
    summary_.add(answers);
    const std::size_t count = answers.size;
    if (probe_.picture.isAskedFor())
      drawn.insert(drawn.end(),
                   answers.values.begin(),
                   answers.values.begin() + static_cast<std::ptrdiff_t>(count));
    std::size_t array = 0;
    const auto next = [&](const double* numbers) {
      putNumbers(put, arrays[array], array, first, count, numbers);
      ++array;
    };
    for (std::size_t f = 0; f < answers.names.size(); ++f) {
      next(answers.values.data() + f * count);
      next(answers.errors.data() + f * count);
      if (probe_.parameters.gradients)
        next(answers.gradients.data() + 3 * f * count);
    }
    put(array++, first, count, answers.support.data());
    for (std::size_t axis = 0; map && axis < 2; ++axis)
      put(array++, first, count, listDegrees(*map, slice, first, count, axis).data());
  };
  saveLattice(
      probe_.output, slice.lattice, arrays, [&](const pcl_uvol::PutNumbers& put) {
        probe_.interpolator.interpolate(
            slice.lattice.size(),
            [&](std::size_t query) { return toSamples(slice.lattice.at(query), {}); },
            probe_.options.threads(),
            report_,
            [&](std::size_t first, const InterpolatedFields& answers) {
              take(put, first, answers);
            });
      });
  if (probe_.picture.isAskedFor())
    drawSlice(slice, drawn);
  std::string list;
  for (const std::string& file : files)
    list += (list.empty() ? "" : ", ") + file;
  return files.size() > 1 ? Facts{{"files", list}} : Facts{};
}

Facts
Runner::probeLattice()
{
  const Slice& slice = *probe_.lattice;
  const QueryLattice& lattice = slice.lattice;
  FactText text;
  for (std::size_t axis = 0; axis < 3; ++axis)
    text << (axis > 0 ? " x " : "") << lattice.counts[axis];
  text << " points, " << lattice.spacing(slice.horizontal) << " apart";
  Facts facts{Fact(
      "lattice",
      text.str(),
      Fact::Members{
          {"counts", toNumbers(lattice.counts)},
          {"origin", toNumbers(lattice.origin)},
          {"spacing", {lattice.spacing(0), lattice.spacing(1), lattice.spacing(2)}}})};
  const Facts written = isWrittenInParts(probe_.queries, probe_.output)
                            ? writeLattice(slice)
                            : writeLatticeAsPoints(slice);
  append(facts, written);
  return facts;
}

} // namespace

bool
isWrittenInParts(const QueryOptions& queries, const std::string& output)
{
  const Kind kind = queries.getKind();
  return (kind == Kind::Plane || kind == Kind::Grid) && pcl_uvol::isLatticeFile(output);
}

Facts
runProbe(const Probe& probe, AnswerSummary& summary, Report& report)
{
  Runner runner(probe, summary, report);
  return probe.lattice ? runner.probeLattice() : runner.probePoints();
}

} // namespace uvol_tools
