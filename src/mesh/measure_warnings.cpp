// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/measure_warnings.h"

#include "common/number_range.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

namespace pcl_uvol::detail {

namespace {

/** Share of a figure: one that is known no better is hardly one. */
constexpr double large_error = 1.0 / 3.0;

/** Share of the samples beyond the isovalue: of smooth fields those inside of the mesh
 * differ from them by one or two in a hundred. */
constexpr double many_missed = 0.1;

void
warnOfOpen(const SurfaceFigures& figures, Report& report)
{
  const auto open =
      std::count_if(figures.pieces.begin(),
                    figures.pieces.end(),
                    [](const PieceMeasures& piece) { return piece.rims > 0; });
  if (open > 0)
    report.warnings.push_back(
        "Of " + std::to_string(figures.pieces.size()) + " pieces " +
        std::to_string(open) +
        " are open, or disagree with others about the outside: they enclose no "
        "volume, and only their area is measured.");
}

void
warnOfVague(const SurfaceFigures& figures, Report& report)
{
  const auto vague = std::count_if(
      figures.isovalues.begin(), figures.isovalues.end(), [](const PieceMeasures& all) {
        return all.volume.error > large_error * std::abs(all.volume.value) ||
               all.area.error > large_error * all.area.value;
      });
  if (vague > 0)
    report.warnings.push_back(
        "Area or volume of " + std::to_string(vague) + " of " +
        std::to_string(figures.isovalues.size()) +
        " surfaces are not known to better than a third: vertices lie that far from "
        "where the surface may be.");
}

/** Whether a closed surface has no volume and encloses no sample. */
bool
hasNoVolume(const PieceMeasures& all)
{
  return all.rims == 0 && all.volume.value == 0.0 && all.triangles > 0 &&
         all.samples <= 0;
}

/** Compares the samples inside with those beyond the isovalue. */
void
warnOfMissedSamples(const SurfaceFigures& figures, Report& report)
{
  for (const PieceMeasures& all : figures.isovalues) {
    if (all.rims > 0 || all.triangles == 0 || !all.samples_beyond || hasNoVolume(all))
      continue;
    const auto beyond = static_cast<double>(*all.samples_beyond);
    if (std::abs(static_cast<double>(all.samples) - beyond) <= many_missed * beyond)
      continue;
    report.warnings.push_back(
        "At " + describeNumbers({all.isovalue})[0] + " the surface encloses " +
        std::to_string(all.samples) + " samples, and " +
        std::to_string(*all.samples_beyond) +
        " have values beyond the isovalue: the mesh is coarser than clumps of few "
        "samples, or leaves them out. For masses, take the sum beyond the isovalue.");
  }
}

} // namespace

bool
isUnsure(const PieceMeasures& piece)
{
  return piece.area.error > piece.area.value &&
         (piece.rims > 0 || piece.volume.error > std::abs(piece.volume.value));
}

bool
isFlat(const SurfaceIntegrals& integrals, const PieceMeasures& piece)
{
  constexpr double rounding = std::numeric_limits<float>::epsilon();
  if (!(integrals.area > 0.0))
    return true;
  double largest = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis)
    largest =
        std::max({largest, std::abs(piece.low[axis]), std::abs(piece.high[axis])});
  const Eigen::Vector3d mean = integrals.area_moment / integrals.area;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(
      Eigen::Matrix3d(integrals.area_products / integrals.area -
                      mean * mean.transpose()),
      Eigen::EigenvaluesOnly);
  const double square = rounding * largest;
  return solver.eigenvalues()[0] <= square * square;
}

void
warnOfUnsure(const UnsurePieces& found, Report& report)
{
  if (found.are_left_out && found.kept > 0)
    report.warnings.push_back(
        "All pieces of some isovalues (" + std::to_string(found.kept) + " of " +
        std::to_string(found.pieces) +
        " pieces) have an error as large as they are. They are kept, since nothing "
        "would be left.");
  if (found.unsure == 0)
    return;
  const auto words = describeNumbers({found.area.value, found.area.error});
  report.warnings.push_back(
      std::to_string(found.unsure) + " of " + std::to_string(found.pieces) +
      " pieces (area " + words[0] + " +- " + words[1] +
      ") have an error as large as they are: few samples are around them, or only "
      "debris far from the others. " +
      (found.are_left_out ? "They are left out of all figures."
                          : "Try: uvol_measure with -drop-unsure leaves them out."));
}

void
warnOfMeasures(const SurfaceFigures& figures, Report& report)
{
  warnOfOpen(figures, report);
  const auto flat =
      std::count_if(figures.isovalues.begin(), figures.isovalues.end(), hasNoVolume);
  if (flat > 0)
    report.warnings.push_back(
        std::to_string(flat) + " of " + std::to_string(figures.isovalues.size()) +
        " surfaces have no volume, and no samples inside: a mesh in one plane "
        "encloses nothing. If all samples are in one plane, the isosurface is a "
        "curve.");
  warnOfVague(figures, report);
  warnOfMissedSamples(figures, report);
  for (const PieceMeasures& all : figures.isovalues)
    if (all.volume.value < -all.volume.error) {
      report.warnings.push_back(
          "The surface looks to the side that it encloses: volumes are "
          "negative.");
      break;
    }
}

} // namespace pcl_uvol::detail
