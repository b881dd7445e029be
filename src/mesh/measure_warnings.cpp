// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/measure_warnings.h"

#include "common/number_range.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

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
    report.warn("open_pieces", {{"pieces", figures.pieces.size()}, {"open", open}});
}

void
warnOfUncertainMeasures(const SurfaceFigures& figures, Report& report)
{
  const auto uncertain = std::count_if(
      figures.isovalues.begin(), figures.isovalues.end(), [](const PieceMeasures& all) {
        return all.volume.error > large_error * std::abs(all.volume.value) ||
               all.area.error > large_error * all.area.value;
      });
  if (uncertain > 0)
    report.warn("uncertain_measures",
                {{"uncertain", uncertain}, {"surfaces", figures.isovalues.size()}});
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
    if (std::abs(static_cast<double>(all.samples) - beyond) > many_missed * beyond)
      report.warn("missed_samples",
                  {{"isovalue", describeNumbers({all.isovalue})[0]},
                   {"enclosed", all.samples},
                   {"beyond", beyond},
                   {"encloses_more", static_cast<double>(all.samples) > beyond}});
  }
}

} // namespace

bool
isUncertain(const PieceMeasures& piece)
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
warnOfWeak(const WeakVertices& vertices, Report& report)
{
  if (vertices.areMost())
    report.warn("unconstrained_measures",
                {{"percent", 100 * vertices.weak / vertices.all}});
}

void
warnOfUncertain(const UncertainPieces& found, Report& report)
{
  if (found.are_left_out && found.kept > 0)
    report.warn("kept_uncertain_pieces",
                {{"kept", found.kept}, {"pieces", found.pieces}});
  if (found.uncertain == 0)
    return;
  const auto words = describeNumbers({found.area.value, found.area.error});
  report.warn("uncertain_pieces",
              {{"uncertain", found.uncertain},
               {"pieces", found.pieces},
               {"area", words[0]},
               {"error", words[1]},
               {"are_left_out", found.are_left_out}});
}

void
warnOfMeasures(const SurfaceFigures& figures, Report& report)
{
  warnOfOpen(figures, report);
  const auto flat =
      std::count_if(figures.isovalues.begin(), figures.isovalues.end(), hasNoVolume);
  if (flat > 0)
    report.warn("flat_surfaces",
                {{"flat", flat}, {"surfaces", figures.isovalues.size()}});
  warnOfUncertainMeasures(figures, report);
  warnOfMissedSamples(figures, report);
  if (std::any_of(figures.isovalues.begin(),
                  figures.isovalues.end(),
                  [](const PieceMeasures& all) {
                    return all.volume.value < -all.volume.error;
                  }))
    report.warn("negative_volumes");
}

} // namespace pcl_uvol::detail
