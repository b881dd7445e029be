// SPDX-License-Identifier: BSD-3-Clause
#include "io/globe_places.h"

#include "common/number_range.h"
#include "common/numbers.h"
#include "common/scalar_field.h"
#include "common/sketch.h"
#include "io/record_source.h"
#include "io/text_column.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <sstream>

namespace pcl_uvol {
namespace io {
namespace {

/** Kilometres; a region that is smaller is mapped in metres. */
constexpr double small_region = 100.0;
/** Octaves of the distance from the median without any position, between the positions
 * of a region and those far from it: the latter are at least four times as far. From
 * one position to the next farther one, distances grow by at most a factor of 1.2 in
 * seven real files (gliders, floats, stations, a magnetic survey); two fixes at (0, 0)
 * are 35 times as far as the others. The files themselves say nothing of this number,
 * since one file has one gap or none. */
constexpr int empty_octaves = 2;
/** One position in eight may be far from the others, as findTypicalRange() has it. */
constexpr std::size_t far_part = 8;
/** Octaves of kilometres that are distinguished: from a millimetre on. */
constexpr int lowest_octave = -20;

using Place = std::array<double, 2>;

bool
isOnGlobe(const Place& place)
{
  return std::abs(place[0]) <= 360.0 && std::abs(place[1]) <= 90.0;
}

/** Above -180 and up to 180 degrees: both ends are one meridian. */
double
wrapLongitude(double longitude)
{
  const double wrapped = std::remainder(longitude, 360.0);
  return wrapped == -180.0 ? 180.0 : wrapped;
}

/** Where a map is centred, to the digit that the note has. */
double
roundDegrees(double degrees)
{
  return std::round(degrees * 1e4) / 1e4;
}

/** Longitudes counted on from the far side of the largest gap between them, so that
 * those on both sides of 180 degrees follow one another. */
std::vector<double>
unwrap(std::vector<double> longitudes)
{
  std::sort(longitudes.begin(), longitudes.end());
  double start = longitudes.front(),
         largest = longitudes.front() + 360.0 - longitudes.back();
  for (std::size_t i = 1; i < longitudes.size(); ++i)
    if (longitudes[i] - longitudes[i - 1] > largest) {
      largest = longitudes[i] - longitudes[i - 1];
      start = longitudes[i];
    }
  for (double& longitude : longitudes)
    longitude += longitude < start ? 360.0 : 0.0;
  std::sort(longitudes.begin(), longitudes.end());
  return longitudes;
}

double
medianOf(const std::vector<double>& sorted)
{
  return 0.5 * (sorted[(sorted.size() - 1) / 2] + sorted[sorted.size() / 2]);
}

/** The median of positions, as a map in kilometres. */
MapProjection
findCentre(const std::vector<Place>& places)
{
  MapProjection map;
  std::vector<double> east, north;
  for (const Place& place : places) {
    east.push_back(place[0]);
    north.push_back(place[1]);
  }
  east = unwrap(east);
  std::sort(north.begin(), north.end());
  map.longitude = wrapLongitude(roundDegrees(medianOf(east)));
  map.latitude = roundDegrees(medianOf(north));
  map.per_kilometre = 1.0;
  return map;
}

int
octaveOf(const Place& on_map)
{
  const double distance = std::hypot(on_map[0], on_map[1]);
  return distance > 0.0 ? std::max(std::ilogb(distance), lowest_octave) : lowest_octave;
}

/** Positions about as far from the centre as one another. */
struct Ring {
  std::uint64_t count = 0;
  std::array<NumberRange, 2> on_map;
  Place first{{360.0, 90.0}}; ///< the lowest longitude, then latitude

  void
  add(const Place& place, const Place& at)
  {
    ++count;
    for (std::size_t axis = 0; axis < 2; ++axis)
      on_map[axis].add(at[axis]);
    first = std::min(first, place);
  }
};

using Rings = std::map<int, Ring>;

/** The first ring of positions far from all others. */
Rings::const_iterator
findFar(const Rings& rings, int typical)
{
  auto ring = rings.lower_bound(typical);
  for (; ring != rings.end(); ++ring) {
    const auto next = std::next(ring);
    if (next != rings.end() && next->first - ring->first > empty_octaves)
      return next;
  }
  return rings.end();
}

/** "42.5 S" */
std::string
degreeWords(double degrees, const char* letters)
{
  std::ostringstream text;
  text.precision(8);
  text << std::abs(degrees) << ' ' << letters[degrees < 0.0 ? 1 : 0];
  return text.str();
}

/** What is said of positions far from the others. */
Message
describeFar(const Rings& rings,
            Rings::const_iterator far,
            const MapProjection& centre,
            const std::string& latitude)
{
  std::uint64_t count = 0, all = 0;
  for (const auto& [octave, ring] : rings)
    all += ring.count;
  for (auto ring = far; ring != rings.end(); ++ring)
    count += ring->second.count;
  const Place& example = far->second.first;
  const Place at = centre.toMap(example[0], example[1]);
  return {"far_positions",
          {{"far", count},
           {"positions", all},
           {"longitude", degreeWords(example[0], "EW")},
           {"latitude", degreeWords(example[1], "NS")},
           {"distance", std::lround(std::hypot(at[0], at[1]))},
           {"field", latitude},
           {"degrees", example[1]}}};
}

} // namespace

MapProjection
chooseMap(const VisitGlobe& visit,
          const MapProjection& wanted,
          const std::string& latitude,
          std::vector<Message>& notes)
{
  Sketch<2> sketch;
  visit([&](double east, double north) {
    if (const Place place{std::remainder(east, 360.0), north}; isOnGlobe({east, north}))
      sketch.add(place);
  });
  const std::vector<Place> items = sketch.getItems();
  MapProjection centre;
  if (items.empty())
    centre = {0.0, 0.0, 1.0};
  else
    centre = findCentre(items);
  std::vector<int> octaves;
  for (const Place& place : items)
    octaves.push_back(octaveOf(centre.toMap(place[0], place[1])));
  std::sort(octaves.begin(), octaves.end());
  Rings rings;
  visit([&](double east, double north) {
    if (!isOnGlobe({east, north}))
      return;
    const Place place{std::remainder(east, 360.0), north};
    const Place at = centre.toMap(place[0], place[1]);
    rings[octaveOf(at)].add(place, at);
  });
  const auto far =
      octaves.empty()
          ? rings.cend()
          : findFar(rings, octaves[octaves.size() - 1 - octaves.size() / far_part]);
  if (far != rings.cend())
    notes.push_back(describeFar(rings, far, centre, latitude));
  std::array<NumberRange, 2> region;
  for (auto ring = rings.cbegin(); ring != far; ++ring)
    for (std::size_t axis = 0; axis < 2; ++axis)
      region[axis].add(ring->second.on_map[axis]);
  MapProjection map = wanted;
  if (!std::isfinite(map.longitude) || !std::isfinite(map.latitude)) {
    map.longitude = centre.longitude;
    map.latitude = centre.latitude;
  }
  if (!(map.per_kilometre > 0.0))
    map.per_kilometre =
        std::max(region[0].getExtent(), region[1].getExtent()) < small_region ? 1000.0
                                                                              : 1.0;
  return map;
}

Message
describeMap(const MapProjection& map, const std::string& z)
{
  return {"mapped_positions",
          {{"longitude", degreeWords(map.longitude, "EW")},
           {"latitude", degreeWords(map.latitude, "NS")},
           {"in_metres", map.per_kilometre > 1.0},
           {"gives_z", !z.empty()},
           {"z", z}}};
}

namespace {

/** Points with longitude and latitude, and where they are now. */
class GlobePoints {
public:
  GlobePoints(const Dataset& points, const std::array<std::string, 2>& names)
      : points_(points)
      , degrees_{{{points.cloud.fields, names[0]}, {points.cloud.fields, names[1]}}}
      , axes_{{{points.cloud.fields, "x"},
               {points.cloud.fields, "y"},
               {points.cloud.fields, "z"}}}
  {
  }

  std::size_t
  size() const
  {
    return points_.cloud.width;
  }

  double
  degrees(std::size_t i, std::size_t axis) const
  {
    return degrees_[axis].read(at(i));
  }

  double
  coordinate(std::size_t i, std::size_t axis) const
  {
    return axes_[axis].read(at(i)) + points_.origin[axis];
  }

private:
  const std::uint8_t*
  at(std::size_t i) const
  {
    return &points_.cloud.data[i * points_.cloud.point_step];
  }

  const Dataset& points_;
  std::array<ScalarField, 2> degrees_;
  std::array<ScalarField, 3> axes_;
};

/** The southernmost and the northernmost point. */
std::optional<std::array<std::size_t, 2>>
findEnds(const GlobePoints& points)
{
  std::optional<std::array<std::size_t, 2>> ends;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double north = points.degrees(i, 1);
    if (!std::isfinite(points.degrees(i, 0) + north + points.coordinate(i, 0) +
                       points.coordinate(i, 1)))
      continue;
    if (!ends)
      ends = {i, i};
    if (north < points.degrees((*ends)[0], 1))
      (*ends)[0] = i;
    if (north > points.degrees((*ends)[1], 1))
      (*ends)[1] = i;
  }
  return ends;
}

/** True if the coordinates are those on a map, to the digits of float. */
bool
areOn(const MapProjection& map, const GlobePoints& points)
{
  constexpr double tolerance = 1e-6; // ten times what float loses of an extent
  NumberRange range;
  double largest = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto at = map.toMap(points.degrees(i, 0), points.degrees(i, 1));
    for (std::size_t axis = 0; axis < 2; ++axis)
      if (const double now = points.coordinate(i, axis);
          std::isfinite(now + at[axis])) {
        range.add(now);
        largest = std::max(largest, std::abs(now - at[axis]));
      }
  }
  return largest <= tolerance * range.getLargest();
}

/** The map that the coordinates of points are on; nothing if they are on none. */
std::optional<MapProjection>
recoverMap(const GlobePoints& globe)
{
  const auto ends = findEnds(globe);
  if (!ends)
    return std::nullopt;
  const auto [south, north] = *ends;
  const double degrees = globe.degrees(north, 1) - globe.degrees(south, 1);
  const double per_degree =
      (globe.coordinate(north, 1) - globe.coordinate(south, 1)) / degrees;
  MapProjection map{0.0, 0.0, 1.0};
  if (!(degrees > 0.0) || !(per_degree > 0.0))
    return std::nullopt;
  map.per_kilometre = per_degree / map.findFactors()[1] > 30.0 ? 1000.0 : 1.0;
  const auto identity = [](double number) { return number; };
  for (double (*const round)(double) : {&roundDegrees, +identity}) {
    map.latitude = round(globe.degrees(south, 1) -
                         globe.coordinate(south, 1) / map.findFactors()[1]);
    map.longitude = wrapLongitude(round(
        globe.degrees(south, 0) - globe.coordinate(south, 0) / map.findFactors()[0]));
    if (areOn(map, globe))
      return map;
  }
  return std::nullopt;
}

} // namespace

void
putOnMap(Dataset& points, const std::optional<MapProjection>& wanted)
{
  const auto names = findGlobeFields(points.cloud.fields);
  if (!names || findMap(points))
    return;
  const GlobePoints globe(points, *names);
  if (!wanted) {
    if (const auto map = recoverMap(globe))
      setMap(points, *map);
    return;
  }
  const auto visit = [&](const std::function<void(double, double)>& take) {
    for (std::size_t i = 0; i < globe.size(); ++i)
      take(globe.degrees(i, 0), globe.degrees(i, 1));
  };
  const MapProjection map = chooseMap(visit, *wanted, (*names)[1], points.notes);
  std::vector<double> xyz;
  xyz.reserve(3 * globe.size());
  for (std::size_t i = 0; i < globe.size(); ++i) {
    const auto at = map.toMap(globe.degrees(i, 0), globe.degrees(i, 1));
    xyz.insert(xyz.end(), {at[0], at[1], globe.coordinate(i, 2)});
  }
  points.double_coordinates = true;
  points.origin = {};
  setCoordinates(points, xyz);
  setMap(points, map);
  if (!wanted->isComplete())
    points.notes.insert(points.notes.begin(), describeMap(map));
}

namespace {

/** Records whose x and y are computed of their longitude and latitude. */
class MappedSource : public NumberedSource {
public:
  MappedSource(std::unique_ptr<RecordSource> source,
               const std::array<std::string, 2>& names,
               const MapProjection& wanted)
      : source_(std::move(source))
      , east_(source_->getInfo().fields, names[0])
      , north_(source_->getInfo().fields, names[1])
  {
    info_ = source_->getInfo();
    info_.origin.reset();
    info_.double_coordinates = true;
    for (std::size_t axis = 0; axis < 2; ++axis)
      axes_[axis] = *findField(info_.fields, axis == 0 ? "x" : "y");
    const auto visit = [&](const std::function<void(double, double)>& take) {
      visitRecords(take);
    };
    map_ = chooseMap(visit, wanted, names[1], info_.notes);
    if (!wanted.isComplete())
      info_.notes.insert(info_.notes.begin(), describeMap(*map_));
    source_->seek(0);
  }

  void
  seek(std::uint64_t record) override
  {
    source_->seek(record);
    next_ = record;
  }

  void
  read(std::size_t count, std::uint8_t* records) override
  {
    source_->read(count, records);
    next_ += count;
    const std::size_t step = recordBytes(info_.fields);
    for (std::size_t i = 0; i < count; ++i, records += step) {
      const auto at = map_->toMap(east_.read(records), north_.read(records));
      for (std::size_t axis = 0; axis < 2; ++axis)
        putNumber(at[axis], axes_[axis].datatype, records + axes_[axis].offset);
    }
  }

  std::uint64_t
  heldBytes() const override
  {
    return source_->heldBytes();
  }

private:
  void
  visitRecords(const std::function<void(double, double)>& take)
  {
    constexpr std::uint64_t block_records = 1u << 12;
    const std::size_t step = recordBytes(info_.fields);
    std::vector<std::uint8_t> block;
    source_->seek(0);
    for (std::uint64_t first = 0; first < info_.count; first += block_records) {
      const auto count = static_cast<std::size_t>(
          std::min<std::uint64_t>(block_records, info_.count - first));
      block.resize(count * step);
      source_->read(count, block.data());
      for (std::size_t i = 0; i < count; ++i)
        take(east_.read(&block[i * step]), north_.read(&block[i * step]));
    }
  }

  std::unique_ptr<RecordSource> source_;
  ScalarField east_, north_;
  std::array<pcl::PCLPointField, 2> axes_;
};

} // namespace

std::unique_ptr<RecordSource>
mapRecords(std::unique_ptr<RecordSource> source, const MapProjection& wanted)
{
  const auto names = findGlobeFields(source->getInfo().fields);
  if (!names || source->getMap())
    return source;
  return std::make_unique<MappedSource>(std::move(source), *names, wanted);
}

} // namespace io
} // namespace pcl_uvol
