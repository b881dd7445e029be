// SPDX-License-Identifier: BSD-3-Clause
#include "isosurface/examined_isopoints.h"

#include <pcl_uvol/common/point_types.h>

#include <algorithm>

namespace pcl_uvol {

namespace {

bool
comesBefore(const Position& a, const Position& b)
{
  return lessAlong(0, a, b);
}

} // namespace

void
ExaminedCandidates::add(const std::vector<Position>& roots)
{
  for (const Position& root : roots)
    add(root);
}

std::vector<Position>
ExaminedCandidates::list() const
{
  std::vector<Position> roots;
  for (const Sketch<3>::Item& item : sketch_.getItems())
    roots.push_back({{static_cast<float>(item[0]),
                      static_cast<float>(item[1]),
                      static_cast<float>(item[2])}});
  return roots;
}

ExaminedIsopoints::ExaminedIsopoints(const ExaminedCandidates& candidates)
    : roots_(candidates.list())
{
  std::sort(roots_.begin(), roots_.end(), comesBefore);
}

bool
ExaminedIsopoints::contain(const Position& root) const
{
  return std::binary_search(roots_.begin(), roots_.end(), root, comesBefore);
}

void
countExamined(const std::vector<std::uint8_t>& supports,
              SurfaceTally& tally,
              Report& report)
{
  const auto count = [&](IsoSupport support) {
    return static_cast<std::uint64_t>(std::count(
        supports.begin(), supports.end(), static_cast<std::uint8_t>(support)));
  };
  const std::uint64_t bridged = count(IsoSupport::Bridged),
                      rim = count(IsoSupport::Rim);
  tally.examined += supports.size();
  tally.examined_bridged += bridged;
  tally.examined_rim += rim;
  report.count("examined", supports.size());
  report.count("examined_bridged", bridged);
  report.count("examined_rim", rim);
}

} // namespace pcl_uvol
