// SPDX-License-Identifier: BSD-3-Clause
// Points for which comparisons like "experiment=1 && T>=4" hold.
#include "common/numbers.h"
#include "common/scalar_field.h"
#include <pcl_uvol/common/dataset.h>
#include <pcl_uvol/common/exceptions.h>

#include <cmath>
#include <cstring>
#include <string_view>

namespace pcl_uvol {
namespace {

enum class Relation { Equal, NotEqual, Less, LessEqual, Greater, GreaterEqual };

bool
holds(double value, Relation relation, double number)
{
  switch (relation) {
  case Relation::Equal:
    return value == number;
  case Relation::NotEqual:
    return value != number;
  case Relation::Less:
    return value < number;
  case Relation::LessEqual:
    return value <= number;
  case Relation::Greater:
    return value > number;
  default:
    return value >= number;
  }
}

/** A field expression compared with a number. */
class Comparison {
public:
  Comparison(const Dataset& dataset, std::string_view text);

  bool
  operator()(const std::uint8_t* point) const
  {
    return holds(read(point), relation_, number_);
  }

private:
  double
  read(const std::uint8_t* point) const;

  std::vector<FieldComponent> components_;
  std::vector<double> addends_; ///< origins of coordinates, for lengths
  bool is_length_ = false;
  Relation relation_ = Relation::Equal;
  double number_ = 0.0;
};

double
originAt(const Dataset& dataset, const FieldComponent& component)
{
  constexpr const char* axes[] = {"x", "y", "z"};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto* const field = findField(dataset.cloud.fields, axes[axis]);
    if (field && field->offset == component.offset)
      return dataset.origin[axis];
  }
  return 0.0;
}

Comparison::Comparison(const Dataset& dataset, std::string_view text)
{
  constexpr struct {
    const char* sign;
    Relation relation;
  } relations[] = {{"!=", Relation::NotEqual},
                   {"<=", Relation::LessEqual},
                   {">=", Relation::GreaterEqual},
                   {"==", Relation::Equal},
                   {"=", Relation::Equal},
                   {"<", Relation::Less},
                   {">", Relation::Greater}};
  const std::size_t at = text.find_first_of("=!<>");
  std::string_view right;
  for (const auto& [sign, relation] : relations)
    if (at != std::string_view::npos &&
        text.compare(at, std::strlen(sign), sign) == 0) {
      right = pcl_uvol::trimmed(text.substr(at + std::strlen(sign)));
      relation_ = relation;
      break;
    }
  const std::string_view left = pcl_uvol::trimmed(text.substr(0, at));
  if (left.empty() || !pcl_uvol::parseNumber(right, number_) || std::isnan(number_))
    throw InvalidArgument("'" + std::string(pcl_uvol::trimmed(text)) +
                          "' is no comparison: write a field, one of =, !=, <, <=, >, "
                          ">=, and a number.");
  const ScalarField field(dataset.cloud.fields, std::string(left));
  components_ = field.getComponents();
  is_length_ = field.isLength();
  for (const auto& component : components_)
    addends_.push_back(originAt(dataset, component));
  if (is_length_)
    return;
  // compared relative to the origin, and with the float nearest to the number where the
  // field is float: else T=4.1 would never hold
  number_ -= addends_.front();
  if (components_.front().datatype == pcl::PCLPointField::FLOAT32)
    number_ = static_cast<double>(static_cast<float>(number_));
}

double
Comparison::read(const std::uint8_t* point) const
{
  if (!is_length_)
    return components_.front().read(point);
  double sum = 0.0;
  for (std::size_t i = 0; i < components_.size(); ++i) {
    const double value = components_[i].read(point) + addends_[i];
    sum += value * value;
  }
  return std::sqrt(sum);
}

} // namespace

std::size_t
selectRows(Dataset& dataset, const std::string& where)
{
  std::vector<Comparison> comparisons;
  for (std::size_t start = 0; start <= where.size();) {
    const std::size_t end = std::min(where.find("&&", start), where.size());
    comparisons.emplace_back(dataset,
                             std::string_view(where).substr(start, end - start));
    start = end + 2;
  }
  auto& cloud = dataset.cloud;
  const std::size_t count = static_cast<std::size_t>(cloud.width) * cloud.height;
  const std::size_t step = cloud.point_step;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint8_t* const point = cloud.data.data() + i * step;
    bool selected = true;
    for (const auto& comparison : comparisons)
      selected = selected && comparison(point);
    if (!selected)
      continue;
    if (kept != i)
      std::memcpy(cloud.data.data() + kept * step, point, step);
    ++kept;
  }
  cloud.data.resize(kept * step);
  cloud.height = 1;
  cloud.width = static_cast<pcl::uindex_t>(kept);
  cloud.row_step = static_cast<pcl::uindex_t>(kept * step);
  return count - kept;
}

} // namespace pcl_uvol
