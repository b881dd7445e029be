// SPDX-License-Identifier: BSD-3-Clause
#include "levelset/evolution_kernel.h"

#include "derivatives/stencil_lanes.h"
#include "levelset/constants.h"

namespace pcl_uvol::PCL_UVOL_SIMD {

namespace {

constexpr std::size_t first_derivatives = 3;

/** Slopes below it have no direction. */
constexpr float smallest_slope = 1e-12f;

Floats
normOf(const Floats* gradient)
{
  return squareRoot(gradient[0] * gradient[0] + gradient[1] * gradient[1] +
                    gradient[2] * gradient[2]);
}

/** 1 / slope, 0 where there is none. */
Floats
inverseOf(const Floats& slope)
{
  return slope > smallest_slope ? 1.0f / maximum(slope, fill(smallest_slope))
                                : Floats{};
}

/** The second derivative along the normal. */
Floats
alongNormal(const Floats* d, const Floats& per_slope)
{
  const Floats x = d[0] * per_slope, y = d[1] * per_slope, z = d[2] * per_slope;
  return x * x * d[3] + y * y * d[6] + z * z * d[8] +
         2.0f * (x * y * d[4] + x * z * d[5] + y * z * d[7]);
}

/** Call visit(first centre of a register, group, part). */
template <typename Visit>
void
forRegisters(std::size_t first, std::size_t last, const Visit& visit)
{
  for (std::size_t group = first; group < last; ++group)
    for (int part = 0; part < stencil_registers; ++part)
      visit(
          group * stencil_lanes + static_cast<std::size_t>(part * lanes), group, part);
}

/** The function at a time between steps, or at time 0, where the rates are not read. */
template <bool between_steps>
struct Values {
  const TimeLines& lines;

  Floats
  at(std::size_t i) const
  {
    const Floats phi = load<Floats>(lines.phi + i);
    return between_steps ? phi + load<Floats>(lines.rate + i) * lines.time : phi;
  }

  /** Gathers values of neighbours. */
  Floats
  operator()(const Ints& index) const
  {
    const Floats phi = gather(lines.phi, index);
    return between_steps ? phi + gather(lines.rate, index) * lines.time : phi;
  }
};

/** Call body(values) with the kind of values that the time asks for. */
template <typename Body>
void
withValues(const TimeLines& lines, const Body& body)
{
  if (lines.time == 0.0f)
    body(Values<false>{lines});
  else
    body(Values<true>{lines});
}

/** The right side of (3.7), and what the step leaves. */
void
finish(const EvolutionStep& step,
       std::size_t i,
       const Floats& own,
       const Floats& slope,
       const Floats& curvature,
       const Floats& to_distance)
{
  Floats bend = curvature;
  if (step.reference != nullptr)
    bend -= load<Floats>(step.reference + i) * slope;
  const Floats most = fill(step.most_pull);
  const Floats target = load<Floats>(step.target + i), gap = target - own;
  const Floats trust = target * own < 0.0f ? fill(1.0f) : load<Floats>(step.trust + i);
  const Floats pull = trust * minimum(maximum(gap, -most), most) *
                      minimum(slope, fill(step.most_slope));
  store(step.curvature + i, curvature);
  store(step.next + i,
        own + step.advection * pull +
            load<Floats>(step.sq_length + i) *
                (step.diffusion * bend + step.to_distance * to_distance));
}

void
evolve(const EvolutionStep& step, std::size_t first, std::size_t last)
{
  withValues(step.lines, [&](const auto& values) {
    forRegisters(first, last, [&](std::size_t i, std::size_t group, int part) {
      const Floats own = values.at(i);
      Floats d[most_stencil_rows];
      differentiate<most_stencil_rows>(step.stencils, group, part, values, own, d);
      const Floats slope = normOf(d), per_slope = inverseOf(slope);
      const Floats x = d[0] * per_slope, y = d[1] * per_slope, z = d[2] * per_slope;
      const Floats trace = d[3] + d[6] + d[8];
      const Floats across =
          trace - (x * x * d[3] + y * y * d[6] + z * z * d[8] +
                   2.0f * (x * y * d[4] + x * z * d[5] + y * z * d[7]));
      store(step.slope + i, slope);
      finish(step, i, own, slope, 0.5f * across, trace - across * per_slope);
    });
  });
}

void
findNormals(const NormalStep& step, std::size_t first, std::size_t last)
{
  withValues(step.lines, [&](const auto& values) {
    forRegisters(first, last, [&](std::size_t i, std::size_t group, int part) {
      const Floats own = values.at(i);
      Floats gradient[first_derivatives];
      differentiate<first_derivatives>(
          step.stencils, group, part, values, own, gradient);
      const Floats slope = normOf(gradient), per_slope = inverseOf(slope);
      store(step.slope + i, slope);
      for (std::size_t axis = 0; axis < first_derivatives; ++axis)
        store(step.normal[axis] + i, gradient[axis] * per_slope);
    });
  });
}

void
evolveByNormals(const EvolutionStep& step,
                const float* const* normals,
                std::size_t centers,
                std::size_t first,
                std::size_t last)
{
  const Ints end = fill(static_cast<std::int32_t>(centers));
  forRegisters(first, last, [&](std::size_t i, std::size_t group, int part) {
    const Floats own = Values<true>{step.lines}.at(i);
    const Floats slope = load<Floats>(step.slope + i);
    Floats divergence{}, along{}; // of the normals; of the slope, along the normal
    for (std::size_t axis = 0; axis < first_derivatives; ++axis) {
      const Floats here = load<Floats>(normals[axis] + i);
      const auto value = [&](const Ints& index) {
        const Ints is_center = index < end;
        return is_center ? gather(normals[axis], is_center ? index : Ints{}) : here;
      };
      Floats d[first_derivatives];
      differentiate<first_derivatives>(step.stencils, group, part, value, here, d);
      divergence += d[axis];
    }
    const auto slopes = [&](const Ints& index) {
      const Ints is_center = index < end;
      return is_center ? gather(step.slope, is_center ? index : Ints{}) : slope;
    };
    Floats change[first_derivatives];
    differentiate<first_derivatives>(step.stencils, group, part, slopes, slope, change);
    for (std::size_t axis = 0; axis < first_derivatives; ++axis)
      along += change[axis] * load<Floats>(normals[axis] + i);
    // div((1 - 1 / |grad phi|) grad phi), with grad phi = slope times normal.
    const Floats to_distance = (slope - 1.0f) * divergence + along;
    finish(step, i, own, slope, 0.5f * divergence * slope, to_distance);
  });
}

void
relaxToDistance(const DistanceStep& step, std::size_t first, std::size_t last)
{
  const TimeLines lines{step.phi, nullptr, 0.0f};
  const Values<false> values{lines};
  forRegisters(first, last, [&](std::size_t i, std::size_t group, int part) {
    const Floats own = values.at(i), sign = load<Floats>(step.sign + i);
    Floats d[most_stencil_rows];
    differentiate<most_stencil_rows>(step.stencils, group, part, values, own, d);
    // Only what is nearer to the zero level may pull a sample there: by itself it would
    // go on beyond.
    const auto upwind = [&](const Ints& index) {
      const Floats value = values(index);
      return sign >= 0.0f ? minimum(value, own) : maximum(value, own);
    };
    Floats half[first_derivatives];
    differentiate<first_derivatives>(step.stencils, group, part, upwind, own, half);
    const Floats slope = normOf(d), per_slope = inverseOf(slope);
    store(step.slope + i, slope);
    // Distances stay: for them it is 0.
    const Floats along = alongNormal(d, per_slope);
    const Floats steepness = minimum(slope, level_set.most_upwind * normOf(half));
    store(step.next + i,
          own + step.change * sign * (1.0f - steepness) +
              step.damping * absolute(sign) * along);
  });
}

template <std::size_t fields>
void
averageFields(const AverageStep& step, std::size_t first, std::size_t last)
{
  const Ints end = fill(static_cast<std::int32_t>(step.centers));
  forRegisters(first, last, [&](std::size_t i, std::size_t group, int part) {
    Floats sums[fields], count = fill(1.0f);
    for (std::size_t field = 0; field < fields; ++field)
      sums[field] = load<Floats>(step.values[field] + i);
    const std::uint32_t* indices = step.stencils.indicesOf(group) + part * lanes;
    for (std::size_t j = 0; j < step.stencils.neighbors;
         ++j, indices += stencil_lanes) {
      fetchAhead(indices, stencil_lanes);
      const Ints index = load<Ints>(indices);
      const Ints is_center = index < end;
      for (std::size_t field = 0; field < fields; ++field)
        sums[field] += is_center
                           ? gather(step.values[field], is_center ? index : Ints{})
                           : Floats{};
      count += is_center ? fill(1.0f) : Floats{};
    }
    for (std::size_t field = 0; field < fields; ++field)
      store(step.means[field] + i, sums[field] / count);
  });
}

void
average(const AverageStep& step, std::size_t first, std::size_t last)
{
  static_assert(AverageStep::most_fields == 3, "as many cases");
  if (step.fields == 1)
    averageFields<1>(step, first, last);
  else if (step.fields == 2)
    averageFields<2>(step, first, last);
  else
    averageFields<3>(step, first, last);
}

} // namespace

extern const EvolutionKernels evolution_kernels{
    evolve, findNormals, evolveByNormals, relaxToDistance, average};

} // namespace pcl_uvol::PCL_UVOL_SIMD
