// SPDX-License-Identifier: BSD-3-Clause
#include "levelset/memory_need.h"

#include "levelset/band.h"
#include "levelset/constants.h"

#include <algorithm>
#include <cmath>

namespace pcl_uvol {

namespace {

constexpr double float_bytes = sizeof(float), index_bytes = sizeof(std::uint32_t);

/** In spacings, of random samples: samples next to a surface lie within so much of it
 * on both sides together (measured on spheres, tori and gyroids: 2.9). */
constexpr double crossing_thickness = 2.9;

/** The stencils and weights of a centre (see Stencils). */
double
stencilBytes(const LevelSetParameters& parameters)
{
  const auto rows = static_cast<double>(derivativesOf(parameters.scheme));
  const auto k = static_cast<double>(parameters.k);
  return k * (index_bytes + rows * sizeof(std::int16_t)) + (rows + 3.0) * float_bytes;
}

/** The bytes of a centre in the evolver: nine numbers, three more for the normals of
 * the linear scheme. */
double
evolverBytes(const LevelSetParameters& parameters)
{
  return (parameters.scheme == FitScheme::Linear ? 12.0 : 9.0) * float_bytes;
}

/** The bytes of a centre: its index and distance; target and trust of the data; phi and
 * rate; and those of the evolver. */
double
centerBytes(const LevelSetParameters& parameters)
{
  return index_bytes + (1.0 + 2.0 + 2.0) * float_bytes + evolverBytes(parameters);
}

/** The bytes of a neighbour of centres that is none: its index, the centre beside it,
 * its phi, the rate and the target. */
constexpr double other_bytes = index_bytes + sizeof(Band::Support) + 3.0 * float_bytes;

} // namespace

double
bandBytes(double samples, double crossing, const LevelSetParameters& parameters)
{
  // The band is as much thicker than the crossing samples as its width on both sides;
  // neighbours reach beyond by the radius of the ball that holds k of them.
  const auto k = static_cast<double>(parameters.k);
  const double per_spacing = crossing / crossing_thickness;
  const double reach = std::cbrt(k / (4.0 / 3.0 * 3.14159265358979));
  const double thickness = crossing_thickness + 2.0 * parameters.band_width;
  const double centers = parameters.band_width > 0.0
                             ? std::min(samples, per_spacing * thickness)
                             : samples;
  const double others = std::min(samples - centers, 2.0 * per_spacing * reach);
  // Weights are tried by a second evolver, on data of its own; of a given one a band
  // around a patch tells what it leaves of the noise, twice.
  const double trials =
      parameters.mu ? (stencilBytes(parameters) + 2.0 * centerBytes(parameters)) *
                          centers * std::min(1.0, level_set.patch_samples / crossing)
                    : (evolverBytes(parameters) + 4.0 * float_bytes) * centers +
                          3.0 * float_bytes * others;
  return (stencilBytes(parameters) + centerBytes(parameters)) * centers +
         other_bytes * others + trials;
}

} // namespace pcl_uvol
