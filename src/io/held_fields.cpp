// SPDX-License-Identifier: BSD-3-Clause
#include "io/held_fields.h"

#include "common/numbers.h"
#include "common/printable.h"
#include "common/scalar_field.h"
#include "io/files.h"
#include "io/ply_types.h"

#include <cstring>

namespace pcl_uvol {
namespace io {
namespace {

using Type = pcl::PCLPointField;

/** True for what has at most 53 digits in the binary system, which double keeps. */
bool
isExactInDouble(std::uint64_t magnitude)
{
  while (magnitude != 0 && magnitude % 2 == 0)
    magnitude /= 2;
  return magnitude < std::uint64_t(1) << 53;
}

/** Whether double holds all numbers of a field of 64-bit integers. */
bool
isExactInDouble(const pcl::PCLPointCloud2& cloud, const pcl::PCLPointField& field)
{
  const std::size_t points = std::size_t{cloud.width} * cloud.height;
  const std::uint8_t* point = cloud.data.data() + field.offset;
  for (std::size_t i = 0; i < points; ++i, point += cloud.point_step)
    for (std::size_t k = 0; k < field.count; ++k) {
      std::uint64_t bits;
      std::memcpy(&bits, point + k * sizeof(bits), sizeof(bits));
      const bool is_negative = field.datatype == Type::INT64 && bits >> 63 != 0;
      if (!isExactInDouble(is_negative ? 0 - bits : bits))
        return false;
    }
  return true;
}

bool
isLeftOut(const std::string& ending,
          const Dataset& dataset,
          const pcl::PCLPointField& field)
{
  return !holdsType(ending, field.datatype) && !isExactInDouble(dataset.cloud, field);
}

} // namespace

bool
holdsType(const std::string& ending, std::uint8_t datatype)
{
  return ending != ".ply" || plyTypeName(datatype) != nullptr;
}

Fields
heldFields(const std::string& ending, const Dataset& dataset)
{
  Fields held;
  for (pcl::PCLPointField& field : savedFields(dataset)) {
    if (isLeftOut(ending, dataset, field))
      continue;
    if (!holdsType(ending, field.datatype))
      field.datatype = Type::FLOAT64;
    held.push_back(std::move(field));
  }
  return held;
}

namespace {

void
noteFieldsLeftOut(const std::string& path,
                  const Dataset& dataset,
                  std::vector<Message>& losses)
{
  const std::string ending = getEnding(path);
  std::string names;
  std::size_t count = 0;
  for (const auto& field : savedFields(dataset))
    if (isLeftOut(ending, dataset, field)) {
      names += (names.empty() ? "" : ", ") + quoteText(field.name);
      ++count;
    }
  if (count > 0)
    losses.push_back({"inexact_fields_left_out",
                      {{"path", path}, {"fields", count}, {"names", names}}});
}

void
noteUnheldLabels(const std::string& path,
                 const Dataset& dataset,
                 std::vector<Message>& losses)
{
  const std::string ending = getEnding(path);
  const bool has_comments = ending == ".pcd" || ending == ".ply";
  std::string fields;
  for (const auto& field : dataset.cloud.fields)
    if (findLabels(dataset.cloud.fields, dataset.labels, field.name))
      fields += (fields.empty() ? "" : ", ") + quoteText(field.name);
  if (!fields.empty() && (has_comments || ending == ".npz" || ending == ".vtkhdf"))
    losses.push_back({has_comments ? "numbered_names_listed" : "numbered_names",
                      {{"path", path}, {"fields", fields}}});
}

void
noteLostOrigin(const std::string& path,
               const Dataset& dataset,
               std::vector<Message>& losses)
{
  if (getEnding(path) == ".stl" && dataset.origin != std::array<double, 3>{})
    losses.push_back({"stl_without_origin", {{"origin", joinNumbers(dataset.origin)}}});
}

} // namespace
} // namespace io

std::vector<Message>
describeLosses(const std::string& path, const Dataset& dataset)
{
  std::vector<Message> losses;
  io::noteFieldsLeftOut(path, dataset, losses);
  io::noteUnheldLabels(path, dataset, losses);
  io::noteLostOrigin(path, dataset, losses);
  return losses;
}

} // namespace pcl_uvol
