// SPDX-License-Identifier: BSD-3-Clause
#include "isosurface/one_sided.h"

#include "common/parallel.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace pcl_uvol {

namespace {

constexpr std::size_t one_sided_block = 256;

/** Samples that decide. Around a place on a surface each is on either side by chance:
 * so many are all on one side at 2 * 0.5^8 = 0.8 % of the places. Of a glider's 220
 * bridged isopoints, whose track crosses the isotherm 22 times at 67 to 87 m, they
 * leave 52, one of them below 106 m; 4 samples leave 27, 16 leave 95, nine of them at
 * 290 m. Of 13,368 isopoints between drill holes 8 remove 7 % and 4 remove 17 %. */
constexpr std::size_t deciding_samples = 8;

/** Share of the distance between the two samples of an edge. An isopoint with a smaller
 * error is known from its fit, as an automatic largest error says as well, and on one
 * side of a curved or noisy surface 8 samples may lie by chance. */
constexpr float precise_part = 0.5f;

} // namespace

OneSidedTest::OneSidedTest(const IsopointInput& input, float isovalue)
    : input_(input)
    , isovalue_(isovalue)
    , nearest_(input.samples, deciding_samples)
{
}

bool
OneSidedTest::contradicts(const PointIso& point, const IsoEdge& edge, float& reach)
{
  if (point.support != static_cast<std::uint8_t>(IsoSupport::Bridged) ||
      point.error <= precise_part * point.edge_length)
    return false;
  const Position &a = input_.samples.getPositions()[edge.first],
                 &b = input_.samples.getPositions()[edge.second];
  Position root;
  for (int axis = 0; axis < 3; ++axis)
    root.x[axis] = a[axis] + edge.t * (b[axis] - a[axis]);
  const auto row = nearest_.find(root, 1.0f);
  std::size_t above = 0;
  float sq_farthest = 0.0f;
  for (std::size_t i = 0; i < row.size; ++i) {
    above += input_.values[row.samples[i]] >= isovalue_;
    sq_farthest = std::max(sq_farthest, row.sq_dists[i]);
  }
  reach = std::max(reach, std::sqrt(sq_farthest));
  return row.size == deciding_samples && (above == 0 || above == row.size);
}

void
removeContradicted(const IsopointInput& input,
                   float isovalue,
                   std::vector<PointIso>& points,
                   IsoEdges& edges,
                   SurfaceTally& tally,
                   Report& report)
{
  std::vector<std::uint8_t> contradicted(points.size());
  parallelBlocks(
      points.size(), one_sided_block, input.threads, [&](auto begin, auto end) {
        OneSidedTest test(input, isovalue);
        float reach = 0.0f;
        for (std::size_t i = begin; i < end; ++i)
          contradicted[i] = test.contradicts(points[i], edges[i], reach);
      });
  std::size_t kept = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (contradicted[i] == 0) {
      points[kept] = points[i];
      edges[kept++] = edges[i];
    }
  tally.contradicted += points.size() - kept;
  if (kept < points.size())
    report.count("contradicted", points.size() - kept);
  points.resize(kept);
  edges.resize(kept);
}

} // namespace pcl_uvol
