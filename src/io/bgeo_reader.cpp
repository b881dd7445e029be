// SPDX-License-Identifier: BSD-3-Clause
// Particles in Houdini's classic binary format, version 5, as Partio, SPlisHSPlasH and
// splashsurf write them: a header, attributes, points, primitives; the first byte of a
// number is its highest one.
#include "common/printable.h"
#include "common/records.h"
#include "io/formats.h"
#include "io/position_tables.h"
#include "io/record_source.h"
#include "io/text_column.h"

#include <pcl/PCLPointField.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <set>

namespace pcl_uvol {
namespace io {
namespace {

using Type = pcl::PCLPointField;

constexpr std::size_t number_bytes = 4; ///< of every number of a point
constexpr std::uint32_t version = 5, particle_system = 0x8000;
/** Points are numbered by two bytes where these suffice. */
constexpr std::uint64_t most_short_numbers = 1u << 16;

/** Types of attributes, as the file numbers them. */
enum class Kind : std::uint32_t { Float = 0, Int = 1, Index = 4, Vector = 5 };

struct Attribute {
  std::string name;
  Kind kind = Kind::Float;
  std::size_t components = 1;
  std::vector<std::string> names; ///< that the numbers of an index stand for
};

/** Counts of the header, in the order of the file. */
struct Counts {
  std::uint32_t points, primitives, point_groups, primitive_groups, point_attributes,
      vertex_attributes, primitive_attributes, attributes;
};

/** Takes what stands before and behind the points. */
class BgeoHeader {
public:
  explicit BgeoHeader(const std::string& path)
      : path_(path)
      , cursor_(path)
  {
  }

  /** Reads all but the points.
   * \param[out] attributes of the points
   * \return what is known of the points, without their labels */
  RecordInfo
  read(std::vector<Attribute>& attributes);

  std::uint64_t
  getOffset() const
  {
    return offset_;
  }

private:
  template <typename T>
  T
  takeNumber();
  std::string
  takeText();
  void
  takeMagic();
  Counts
  takeCounts();
  std::vector<Attribute>
  takeAttributes(std::uint32_t count);
  void
  passPrimitives(const Counts& counts);
  [[noreturn]] void
  throwTruncated() const
  {
    throwUnreadable(path_, {"truncated_part", "its header"});
  }

  const std::string& path_;
  FileCursor cursor_;
  std::uint64_t offset_ = 0; ///< of the points
};

template <typename T>
T
BgeoHeader::takeNumber()
{
  const char* const bytes = cursor_.take(sizeof(T));
  if (!bytes)
    throwTruncated();
  T number = 0;
  for (std::size_t i = 0; i < sizeof(T); ++i)
    number = static_cast<T>(number << 8 | static_cast<std::uint8_t>(bytes[i]));
  return number;
}

std::string
BgeoHeader::takeText()
{
  const auto length = takeNumber<std::uint16_t>();
  const char* const bytes = cursor_.take(length);
  if (!bytes)
    throwTruncated();
  return {bytes, length};
}

void
BgeoHeader::takeMagic()
{
  constexpr std::size_t magic_bytes = 5;
  const std::string magic = cursor_.getFile().head(magic_bytes);
  if (magic.rfind("\x7fNSJ", 0) == 0)
    throwUnreadable(path_, "houdini_12");
  if (magic != "BgeoV")
    throwUnreadable(path_,
                    {"wrong_start", "a classic .bgeo file of Houdini", "'BgeoV'"});
  cursor_.skip(magic_bytes);
  const auto found = takeNumber<std::uint32_t>();
  if (found != version)
    throwUnreadable(
        path_,
        {"unsupported_value", "its version", shortenText(std::to_string(found)), "5"});
}

Counts
BgeoHeader::takeCounts()
{
  std::array<std::uint32_t, 8> counts{};
  for (std::uint32_t& count : counts) {
    count = takeNumber<std::uint32_t>();
    if (count > INT32_MAX)
      throwUnreadable(path_, {"invalid_part", "a count of its header"});
  }
  return {counts[0],
          counts[1],
          counts[2],
          counts[3],
          counts[4],
          counts[5],
          counts[6],
          counts[7]};
}

std::vector<Attribute>
BgeoHeader::takeAttributes(std::uint32_t count)
{
  std::vector<Attribute> attributes;
  std::set<std::string> known;
  for (std::uint32_t i = 0; i < count; ++i) {
    Attribute attribute;
    attribute.name = takeText();
    attribute.components = takeNumber<std::uint16_t>();
    const auto kind = takeNumber<std::uint32_t>();
    attribute.kind = Kind{kind};
    const std::string called = "its attribute " + quoteText(attribute.name);
    if (attribute.kind != Kind::Float && attribute.kind != Kind::Int &&
        attribute.kind != Kind::Index && attribute.kind != Kind::Vector)
      throwUnreadable(path_,
                      {"unsupported_value",
                       "the type of " + called,
                       shortenText(std::to_string(kind)),
                       "0, 1, 4 and 5 (numbers, names and vectors)"});
    if (attribute.components < 1 || attribute.components > most_table_components)
      throwUnreadable(path_,
                      {"unsupported_value",
                       "the number of components of " + called,
                       shortenText(std::to_string(attribute.components)),
                       "1 to " + std::to_string(most_table_components)});
    if (!known.insert(attribute.name).second)
      throwUnreadable(path_, {"repeated_part", called});
    if (attribute.kind == Kind::Index) {
      const auto names = takeNumber<std::uint32_t>();
      if (names > most_names)
        throwUnreadable(path_, {"too_many_parts", called, most_names, "names"});
      for (std::uint32_t k = 0; k < names; ++k)
        attribute.names.push_back(takeText());
    }
    else if (!cursor_.skip(attribute.components * number_bytes)) // of new points
      throwTruncated();
    attributes.push_back(std::move(attribute));
  }
  return attributes;
}

std::size_t
countBytes(const std::vector<Attribute>& attributes)
{
  std::size_t components = 0;
  for (const Attribute& attribute : attributes)
    components += attribute.components;
  return components * number_bytes;
}

/** Systems of particles list their points, which are those of the file anyway. */
void
BgeoHeader::passPrimitives(const Counts& counts)
{
  const std::size_t of_vertex =
      (counts.points < most_short_numbers ? sizeof(std::uint16_t)
                                          : sizeof(std::uint32_t)) +
      countBytes(takeAttributes(counts.vertex_attributes));
  const std::size_t of_primitive =
      countBytes(takeAttributes(counts.primitive_attributes));
  for (std::uint32_t i = 0; i < counts.primitives; ++i) {
    const auto kind = takeNumber<std::uint32_t>();
    if (kind != particle_system)
      throwUnreadable(path_, {"houdini_primitives", kind});
    const auto vertices = takeNumber<std::uint32_t>();
    if (vertices > cursor_.left() / of_vertex ||
        !cursor_.skip(vertices * of_vertex + of_primitive))
      throwUnreadable(
          path_,
          {"truncated_part", "a system of " + std::to_string(vertices) + " particles"});
  }
}

RecordInfo
BgeoHeader::read(std::vector<Attribute>& attributes)
{
  takeMagic();
  const Counts counts = takeCounts();
  attributes = takeAttributes(counts.point_attributes);
  offset_ = cursor_.tell().offset;
  RecordInfo info;
  info.count = counts.points;
  for (const char* const axis : {"x", "y", "z"})
    appendField(info.fields, axis, Type::FLOAT32);
  appendField(info.fields, "_", Type::FLOAT32); // a weight, which splines have
  for (const Attribute& attribute : attributes) {
    const bool is_real =
        attribute.kind == Kind::Float || attribute.kind == Kind::Vector;
    appendField(info.fields,
                attribute.name,
                is_real ? Type::FLOAT32 : Type::INT32,
                attribute.components);
    if (attribute.kind == Kind::Index && attribute.components > 1)
      info.notes.push_back(
          {"several_names", {{"attribute", shortenText(attribute.name)}}});
  }
  const std::size_t point_bytes = recordBytes(info.fields);
  if (info.count > cursor_.left() / point_bytes)
    throwUnreadable(path_,
                    {"truncated_data",
                     info.count,
                     "points of " + std::to_string(point_bytes) + " bytes",
                     cursor_.left()});
  cursor_.skip(info.count * point_bytes);
  if (counts.primitives > 0)
    passPrimitives(counts);
  if (counts.attributes > 0)
    info.notes.push_back({"file_attributes", {{"attributes", counts.attributes}}});
  if (counts.point_groups > 0)
    info.notes.push_back({"point_groups", {{"groups", counts.point_groups}}});
  return info;
}

/** Points whose numbers of names become those in the order of the names. */
class BgeoSource : public FixedSource {
public:
  BgeoSource(const std::string& path,
             RecordInfo info,
             std::uint64_t offset,
             const std::vector<Attribute>& attributes)
      : FixedSource(path, std::move(info), offset, true)
  {
    for (const Attribute& attribute : attributes)
      if (attribute.kind == Kind::Index && attribute.components == 1)
        addLabels(attribute);
  }

  void
  read(std::size_t count, std::uint8_t* records) override;

private:
  struct Ranks {
    std::size_t offset; ///< in a record
    std::vector<std::int32_t> rank_of;
  };

  void
  addLabels(const Attribute& attribute);

  std::vector<Ranks> ranks_;
};

void
BgeoSource::addLabels(const Attribute& attribute)
{
  std::vector<std::string> names = attribute.names;
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  Ranks ranks{0, {}};
  const auto field = std::find_if(
      info_.fields.rbegin(), info_.fields.rend(), [&](const pcl::PCLPointField& f) {
        return f.name == attribute.name; // the coordinates come before all attributes
      });
  ranks.offset = field->offset;
  for (const std::string& name : attribute.names)
    ranks.rank_of.push_back(static_cast<std::int32_t>(
        std::lower_bound(names.begin(), names.end(), name) - names.begin()));
  ranks_.push_back(std::move(ranks));
  info_.labels.emplace(attribute.name, std::move(names));
}

void
BgeoSource::read(std::size_t count, std::uint8_t* records)
{
  FixedSource::read(count, records);
  const std::size_t step = recordBytes(info_.fields);
  for (const Ranks& ranks : ranks_)
    for (std::size_t i = 0; i < count; ++i) {
      std::uint8_t* const bytes = records + i * step + ranks.offset;
      std::int32_t number;
      std::memcpy(&number, bytes, sizeof(number));
      const bool has_name =
          number >= 0 && static_cast<std::size_t>(number) < ranks.rank_of.size();
      number = has_name ? ranks.rank_of[static_cast<std::size_t>(number)]
                        : static_cast<std::int32_t>(no_name);
      std::memcpy(bytes, &number, sizeof(number));
    }
}

} // namespace

std::unique_ptr<RecordSource>
openBgeo(const std::string& path)
{
  BgeoHeader header(path);
  std::vector<Attribute> attributes;
  RecordInfo info = header.read(attributes);
  return std::make_unique<BgeoSource>(
      path, std::move(info), header.getOffset(), attributes);
}

} // namespace io
} // namespace pcl_uvol
