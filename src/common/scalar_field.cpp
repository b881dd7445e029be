// SPDX-License-Identifier: BSD-3-Clause
// Field expressions resolved against the fields of a cloud.
#include "common/scalar_field.h"

#include "common/numbers.h"
#include "common/printable.h"
#include "common/scalar_names.h"
#include <pcl_uvol/common/exceptions.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstring>
#include <string_view>

namespace pcl_uvol {
namespace {

using Fields = std::vector<pcl::PCLPointField>;

struct TypeInfo {
  const char* name;
  std::size_t size;
};

/** In the order of pcl::PCLPointField::PointFieldTypes, which starts at 1. */
constexpr std::array<TypeInfo, 11> type_infos{{{"int8", 1},
                                               {"uint8", 1},
                                               {"int16", 2},
                                               {"uint16", 2},
                                               {"int32", 4},
                                               {"uint32", 4},
                                               {"float32", 4},
                                               {"float64", 8},
                                               {"int64", 8},
                                               {"uint64", 8},
                                               {"bool", 1}}};
static_assert(pcl::PCLPointField::INT8 == 1 && pcl::PCLPointField::BOOL == 11);

const TypeInfo&
typeInfo(std::uint8_t datatype)
{
  if (datatype < 1 || datatype > type_infos.size())
    throw InvalidArgument("unknown_datatype", {{"type", datatype}});
  return type_infos[datatype - 1];
}

template <typename T>
double
readAs(const std::uint8_t* bytes)
{
  T value;
  std::memcpy(&value, bytes, sizeof(T));
  return static_cast<double>(value);
}

std::size_t
componentCount(const pcl::PCLPointField& field)
{
  return std::max<std::size_t>(field.count, 1); // PCL writes 0 for some scalars
}

FieldComponent
componentOf(const pcl::PCLPointField& field, std::size_t index)
{
  return {field.offset + index * datatypeSize(field.datatype), field.datatype};
}

[[noreturn]] void
throwUnknown(const Fields& fields, const std::string& name)
{
  const bool has_coordinates_only =
      std::all_of(fields.begin(), fields.end(), [](const pcl::PCLPointField& field) {
        return field.name == "x" || field.name == "y" || field.name == "z";
      });
  throw InvalidArgument("unknown_field",
                        {{"field", shortenText(name)},
                         {"fields", describeFields(fields)},
                         {"has_coordinates_only", has_coordinates_only}});
}

/** The components of fields called name and one of the endings, as far as there are any
 * of them. */
template <typename EndingOf>
std::vector<FieldComponent>
collectComponents(const Fields& fields,
                  const std::string& name,
                  std::size_t least,
                  const EndingOf& ending_of)
{
  std::vector<FieldComponent> components;
  while (const auto* const part =
             findField(fields, name + ending_of(components.size())))
    components.push_back(componentOf(*part, 0));
  if (components.size() < least)
    components.clear();
  return components;
}

std::vector<FieldComponent>
allComponents(const Fields& fields, const std::string& name)
{
  auto components = findComponents(fields, name);
  if (components.empty())
    throwUnknown(fields, name);
  return components;
}

/** One scalar: `density` or `vel[1]`. */
FieldComponent
scalarComponent(const Fields& fields, const std::string& expression)
{
  if (const auto* const field = findField(fields, expression)) {
    const std::size_t count = componentCount(*field);
    if (count > 1)
      throw InvalidArgument("field_of_components",
                            {{"field", shortenText(expression)},
                             {"components", count},
                             {"last", count - 1}});
    return componentOf(*field, 0);
  }
  const std::size_t bracket = expression.rfind('[');
  if (bracket == std::string::npos || bracket == 0 || expression.back() != ']')
    throwUnknown(fields, expression);
  std::size_t index = 0;
  const char* const last = expression.data() + expression.size() - 1;
  const auto parsed = std::from_chars(expression.data() + bracket + 1, last, index, 10);
  if (parsed.ec != std::errc() || parsed.ptr != last)
    throw InvalidArgument("component_not_number", {{"field", shortenText(expression)}});
  const std::string name(trimmed(std::string_view(expression).substr(0, bracket)));
  const auto* const field = findField(fields, name);
  const auto parts = // of one field there may be very many
      field ? std::vector<FieldComponent>() : allComponents(fields, name);
  const std::size_t count = field ? componentCount(*field) : parts.size();
  if (index >= count)
    throw InvalidArgument("component_too_large",
                          {{"field", shortenText(expression)}, {"last", count - 1}});
  return field ? componentOf(*field, index) : parts[index];
}

bool
isCandidate(const pcl::PCLPointField& field)
{
  static constexpr std::array<std::string_view, 18> never{"",
                                                          "_",
                                                          "x",
                                                          "y",
                                                          "z",
                                                          "normal_x",
                                                          "normal_y",
                                                          "normal_z",
                                                          "nx",
                                                          "ny",
                                                          "nz",
                                                          "red",
                                                          "green",
                                                          "blue",
                                                          "alpha",
                                                          "rgb",
                                                          "rgba",
                                                          "curvature"};
  return std::find(never.begin(), never.end(), field.name) == never.end();
}

} // namespace

std::vector<NamedScalar>
listNamedScalars(const Fields& fields)
{
  std::vector<NamedScalar> scalars;
  for (const pcl::PCLPointField& field : fields) {
    if (!isCandidate(field))
      continue;
    const std::size_t count = componentCount(field);
    for (std::size_t i = 0; i < count; ++i)
      scalars.push_back(
          {count > 1 ? field.name + '[' + std::to_string(i) + ']' : field.name,
           componentOf(field, i)});
  }
  return scalars;
}

std::vector<std::string>
listScalars(const Fields& fields)
{
  std::vector<std::string> names;
  for (NamedScalar& scalar : listNamedScalars(fields))
    names.push_back(std::move(scalar.name));
  return names;
}

double
FieldComponent::read(const std::uint8_t* point) const
{
  using Type = pcl::PCLPointField;
  const std::uint8_t* const bytes = point + offset;
  switch (datatype) {
  case Type::FLOAT32:
    return readAs<float>(bytes);
  case Type::FLOAT64:
    return readAs<double>(bytes);
  case Type::INT8:
    return readAs<std::int8_t>(bytes);
  case Type::INT16:
    return readAs<std::int16_t>(bytes);
  case Type::UINT16:
    return readAs<std::uint16_t>(bytes);
  case Type::INT32:
    return readAs<std::int32_t>(bytes);
  case Type::UINT32:
    return readAs<std::uint32_t>(bytes);
  case Type::INT64:
    return readAs<std::int64_t>(bytes);
  case Type::UINT64:
    return readAs<std::uint64_t>(bytes);
  default: // UINT8, BOOL
    return readAs<std::uint8_t>(bytes);
  }
}

ScalarField::ScalarField(const Fields& fields, const std::string& expression)
    : name_(findField(fields, expression) ? expression
                                          : std::string(trimmed(expression)))
    , is_length_(!findField(fields, name_) && name_.size() > 1 &&
                 name_.front() == '|' && name_.back() == '|')
{
  if (!is_length_) {
    components_.push_back(scalarComponent(fields, name_));
    return;
  }
  const std::string inside = name_.substr(1, name_.size() - 2);
  if (inside.find(',') == std::string::npos ||
      !findComponents(fields, std::string(trimmed(inside))).empty()) {
    components_ = allComponents(fields, std::string(trimmed(inside)));
    return;
  }
  for (std::size_t start = 0; start <= inside.size();) {
    const std::size_t end = std::min(inside.find(',', start), inside.size());
    components_.push_back(scalarComponent(
        fields,
        std::string(trimmed(std::string_view(inside).substr(start, end - start)))));
    start = end + 1;
  }
}

std::string
ScalarField::defaultName(const Fields& fields)
{
  Fields candidates, scalars;
  for (const auto& field : fields) {
    if (!isCandidate(field))
      continue;
    candidates.push_back(field);
    if (componentCount(field) > 1)
      continue;
    if (field.name == "intensity")
      return field.name;
    scalars.push_back(field);
  }
  if (scalars.size() == 1)
    return scalars.front().name;
  if (candidates.empty())
    throw InvalidArgument("no_scalar_field", {{"fields", describeFields(fields)}});
  throw InvalidArgument("several_scalar_fields",
                        {{"fields", describeFields(candidates)}});
}

double
ScalarField::read(const std::uint8_t* point) const
{
  if (!is_length_)
    return components_.front().read(point);
  double sum = 0.0;
  for (const auto& component : components_) {
    const double value = component.read(point);
    sum += value * value;
  }
  return std::sqrt(sum);
}

std::string
describeFields(const Fields& fields)
{
  constexpr std::size_t most_bytes = 200; // sentences stay sentences
  std::string text;
  for (const auto& field : fields) {
    if (text.size() > most_bytes)
      return text + " and " + std::to_string(&fields.back() - &field + 1) + " more";
    if (!text.empty())
      text += ", ";
    text += shortenText(field.name) + " (" + typeInfo(field.datatype).name;
    if (componentCount(field) > 1)
      text += " x " + std::to_string(field.count);
    text += ')';
  }
  return text.empty() ? "none" : text;
}

const pcl::PCLPointField*
findField(const Fields& fields, const std::string& name)
{
  const auto found = std::find_if(fields.begin(), fields.end(), [&](const auto& field) {
    return field.name == name;
  });
  return found == fields.end() ? nullptr : &*found;
}

std::vector<FieldComponent>
findComponents(const Fields& fields, const std::string& name)
{
  std::vector<FieldComponent> components;
  if (const auto* const field = findField(fields, name)) {
    for (std::size_t i = 0; i < componentCount(*field); ++i)
      components.push_back(componentOf(*field, i));
    return components;
  }
  if (name.empty()) // which endings alone would complete
    return components;
  for (const char* const separator : {"_", ":"}) {
    components = collectComponents(
        fields, name, 1, [&](std::size_t i) { return separator + std::to_string(i); });
    if (!components.empty())
      return components;
  }
  for (const char* const separator : {"_", ""}) {
    components = collectComponents(fields, name, 2, [&](std::size_t i) {
      return i < 3 ? separator + std::string(1, "xyz"[i]) : "";
    });
    if (!components.empty())
      return components;
  }
  return components;
}

std::size_t
datatypeSize(std::uint8_t datatype)
{
  return typeInfo(datatype).size;
}

} // namespace pcl_uvol
