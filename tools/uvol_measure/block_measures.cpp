// SPDX-License-Identifier: BSD-3-Clause
#include "uvol_measure/block_measures.h"

#include "common/number_range.h"

#include <cstddef>
#include <vector>

namespace uvol_tools {

using pcl_uvol::detail::BlockVolume;
using pcl_uvol::detail::BlockVolumes;

MeasureTable
makeTable(const BlockVolumes& found, const std::string& field)
{
  const auto column = [&](const std::string& name, const auto& numberOf) {
    Fact::Numbers numbers;
    for (const BlockVolume& all : found.isovalues)
      numbers.push_back(numberOf(all));
    return std::make_pair(name, numbers);
  };
  const std::string mean = field + "_volume_mean",
                    integral = field + "_volume_integral";
  return MeasureTable(
      {column("isovalue", [](const BlockVolume& all) { return all.isovalue; }),
       column("piece", [](const BlockVolume&) { return -1.0; }),
       column("volume", [](const BlockVolume& all) { return all.volume; }),
       column("volume_error", [](const BlockVolume& all) { return all.volume_error; }),
       column("x", [](const BlockVolume& all) { return all.centroid[0]; }),
       column("y", [](const BlockVolume& all) { return all.centroid[1]; }),
       column("z", [](const BlockVolume& all) { return all.centroid[2]; }),
       column(mean, [](const BlockVolume& all) { return all.mean; }),
       column(mean + "_error", [](const BlockVolume& all) { return all.mean_error; }),
       column(integral, [](const BlockVolume& all) { return all.integral; }),
       column(integral + "_error",
              [](const BlockVolume& all) { return all.integral_error; })});
}

Facts
describeBlocks(const BlockVolumes& found, const std::string& field)
{
  const auto& [nx, ny, nz] = found.blocks;
  const std::size_t all_blocks = nx * ny * nz;
  const std::string grid =
      std::to_string(nx) + " x " + std::to_string(ny) + " x " + std::to_string(nz);
  Facts facts;
  facts.emplace_back(
      "blocks",
      grid + ", " + std::to_string(found.estimated) + " of " +
          std::to_string(all_blocks) +
          " estimated; the others are outside of the data, or "
          "less accurate than the mean of all samples",
      Fact::Members{{"all", {static_cast<double>(all_blocks)}},
                    {"estimated", {static_cast<double>(found.estimated)}}});
  std::vector<double> isovalues;
  for (const BlockVolume& all : found.isovalues)
    isovalues.push_back(all.isovalue);
  const std::vector<std::string> names = pcl_uvol::describeNumbers(isovalues);
  for (std::size_t i = 0; i < isovalues.size(); ++i) {
    const BlockVolume& all = found.isovalues[i];
    facts.push_back(Fact("beyond " + names[i],
                         "volume " + describe({all.volume, all.volume_error}) +
                             ", mean " + field + " " +
                             describe({all.mean, all.mean_error}) + ", integral " +
                             describe({all.integral, all.integral_error}))
                        .withoutJson());
  }
  facts.emplace_back("beyond", "", makeTable(found, field).getColumns());
  return facts;
}

} // namespace uvol_tools
