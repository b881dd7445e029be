// SPDX-License-Identifier: BSD-3-Clause
#include "io/snapshot.h"

#include "common/numbers.h"
#include "common/printable.h"
#include "io/files.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <system_error>

namespace pcl_uvol {
namespace io {
namespace {

std::string
describeKinds(const std::vector<ParticleKind>& kinds)
{
  std::string text;
  for (const ParticleKind& kind : kinds)
    if (kind.count > 0)
      text += (text.empty() ? "" : ", ") + std::to_string(kind.count) + " of " +
              (kind.name.empty() ? "kind " : kind.name + " (") +
              std::to_string(kind.number) + (kind.name.empty() ? "" : ")");
  return text;
}

} // namespace

std::vector<ParticleKind>
listGadgetKinds(const std::vector<std::uint64_t>& counts)
{
  constexpr const char* names[] = {"gas", "dm", "disk", "bulge", "stars", "bh"};
  std::vector<ParticleKind> kinds;
  for (std::size_t i = 0; i < counts.size(); ++i)
    kinds.push_back({i, i < std::size(names) ? names[i] : "", counts[i]});
  return kinds;
}

std::size_t
chooseKind(const std::string& path,
           const std::vector<ParticleKind>& kinds,
           const std::string& chosen,
           std::vector<Message>& notes)
{
  std::uint64_t number = 0;
  const bool is_number = parseCount(chosen, number);
  const auto is_meant = [&](const ParticleKind& kind) {
    if (kind.count == 0)
      return false;
    return chosen.empty() ||
           (is_number ? kind.number == number : kind.name == lowerCase(chosen));
  };
  const auto found = std::find_if(kinds.begin(), kinds.end(), is_meant);
  if (found == kinds.end())
    throwUnreadable(
        path,
        {"no_particles", !chosen.empty(), shortenText(chosen), describeKinds(kinds)});
  const auto filled = std::count_if(
      kinds.begin(), kinds.end(), [](const ParticleKind& k) { return k.count > 0; });
  if (chosen.empty() && filled > 1)
    notes.push_back({"several_kinds", {{"kinds", describeKinds(kinds)}}});
  return found->number;
}

std::vector<std::string>
listSnapshotFiles(const std::string& path, std::size_t count)
{
  namespace fs = std::filesystem;
  if (count <= 1)
    return {path};
  const bool has_ending = getEnding(path).find_first_of("0123456789", 1) != 1;
  const fs::path ending = has_ending ? fs::path(path).extension() : fs::path();
  const fs::path stem =
      has_ending ? fs::path(path).replace_extension() : fs::path(path);
  const std::string number = stem.extension().string();
  std::uint64_t own = 0;
  if (number.empty() || !parseCount(number.substr(1), own))
    throwUnreadable(path, {"snapshot_without_number", count, ending.string()});
  std::vector<std::string> files;
  for (std::size_t i = 0; i < count; ++i) {
    files.push_back(fs::path(stem)
                        .replace_extension(std::to_string(i))
                        .concat(ending.string())
                        .string());
    std::error_code ignored; // of a name that is too long
    if (!fs::exists(files.back(), ignored))
      throwUnreadable(path, {"no_required_file", files.back()});
  }
  return files;
}

std::array<double, 3>
toBox(const std::vector<double>& sides)
{
  std::array<double, 3> box{};
  for (std::size_t axis = 0; axis < 3 && !sides.empty(); ++axis) {
    const double side = sides[sides.size() < 3 ? 0 : axis];
    box[axis] = std::isfinite(side) && side > 0.0 ? side : 0.0;
  }
  return box;
}

void
noteHeader(const CosmologyHeader& header, std::vector<Message>& notes)
{
  const bool has_hubble = header.hubble && *header.hubble > 0.0;
  if (!(header.redshift > 1e-9) && !(has_hubble && *header.hubble != 1.0))
    return;
  notes.push_back({"comoving_units",
                   {{"redshift", header.redshift},
                    {"has_hubble", has_hubble},
                    {"hubble", header.hubble.value_or(0.0)}}});
}

} // namespace io
} // namespace pcl_uvol
