// SPDX-License-Identifier: BSD-3-Clause
// One explicit step of the level-set equation (thesis 3.7) at the samples of some
// groups of stencils. Plain arrays, no library headers: the file is compiled once per
// instruction set.
//
// Lengths are those of the samples. Arrays have a place for every lane of every group
// ("centres"), phi also one for every other neighbour behind them.
#pragma once

#include "derivatives/stencil_view.h"

namespace pcl_uvol {

/** The level-set function in a step: phi + rate * time at every place; at time 0 rates
 * are not read. */
struct TimeLines {
  const float *phi, *rate;
  float time;
};

/** What a step reads and writes. */
struct EvolutionStep {
  StencilView stencils;
  TimeLines lines;
  const float* target; ///< f - f_iso as a distance
  const float* trust;  ///< part of the pull of targets on the own side of the surface
  const float* reference; ///< curvature that is left as it is; null: 0
  const float* sq_length; ///< squared unit of length of the curvature terms
  float most_pull;        ///< farther targets pull no more than one that far away
  float most_slope;       ///< steeper places are pulled no faster
  float advection;        ///< mu dt
  float diffusion;        ///< (1 - mu) dt
  float to_distance;      ///< weight times dt of the term of 3.4 that keeps the slope
                          ///< at 1
  float* next;            ///< phi after the step
  float* curvature;       ///< mean curvature times slope, before it
  float* slope;           ///< |grad phi|, before it; evolveByNormals() reads it
};

/** Relaxation to a distance function (the Eikonal equation of thesis 3.4). */
struct DistanceStep {
  StencilView stencils;
  const float* phi;
  const float* sign;     ///< of the function at the start, smooth across its zero level
  float change, damping; ///< dt in units of length; viscosity along the normal times
                         ///< dt, squared length
  float* next;
  float* slope;
};

/** Normals of the level sets, for curvature by the thesis's way. */
struct NormalStep {
  StencilView stencils;
  TimeLines lines;
  float* normal[3]; ///< 0 where the slope is
  float* slope;
};

/** Means of some fields over neighbours. */
struct AverageStep {
  static constexpr std::size_t most_fields = 3;

  StencilView stencils;
  std::size_t centers; ///< that count
  std::size_t fields;  ///< 1 to most_fields
  const float* values[most_fields];
  float* means[most_fields];
};

/** \brief One instruction set's versions, for groups first to last - 1. */
struct EvolutionKernels {
  /** Curvature from second derivatives: (tr H - n^T H n) / 2. */
  void (*evolve)(const EvolutionStep& step, std::size_t first, std::size_t last);

  void (*findNormals)(const NormalStep& step, std::size_t first, std::size_t last);

  /** Curvature as half the divergence of the normals (thesis 3.3). Neighbours that are
   * no centres count as if they had the sample's own normal.
   * \param normals of all centres, which findNormals() left, and slopes in the step */
  void (*evolveByNormals)(const EvolutionStep& step,
                          const float* const* normals,
                          std::size_t centers,
                          std::size_t first,
                          std::size_t last);

  void (*relaxToDistance)(const DistanceStep& step,
                          std::size_t first,
                          std::size_t last);

  /** Means over each centre and its neighbours, those that are no centres left out. */
  void (*average)(const AverageStep& step, std::size_t first, std::size_t last);
};

namespace baseline {
extern const EvolutionKernels evolution_kernels;
}
namespace avx2 {
extern const EvolutionKernels evolution_kernels;
}
namespace avx512 {
extern const EvolutionKernels evolution_kernels;
}

} // namespace pcl_uvol
