// One candidate of light after the other, of which one is kept (light-candidates).
#ifndef LANELIGHT_LIGHTS_RESERVOIR_INL_H_
#define LANELIGHT_LIGHTS_RESERVOIR_INL_H_

#include <cstdint>

#include "kernels/queue/slots-inl.h"
#include "kernels/simd/vec3-inl.h"
#include "src/vocabulary/path/fields.h"

LANELIGHT_BEGIN_KERNELS

/// A candidate of this worth takes the place of the one kept so far with probability
/// worth / (sum of the worths up to it): in the end, whichever is kept has been so with
/// probability worth / sum. One number serves all choices: what a choice leaves of it is
/// stretched back to [0, 1).
struct Reservoir {
  VF sum, u;

  /// Returns whether the candidate is taken. `worth` is finite and at least 0; 0 is never
  /// taken, the first above 0 always is.
  LANELIGHT_INLINE MF Take(VF worth) {
    sum = hn::Add(sum, worth);
    const MF some = hn::Gt(worth, hn::Zero(DF()));
    const VF share = hn::IfThenElseZero(some, hn::Div(worth, sum));
    const MF take = hn::Lt(u, share);
    const VF one = Splat(1.0f);
    const VF part = hn::IfThenElse(take, share, hn::Sub(one, share));
    const VF left = hn::Div(hn::IfThenElse(take, u, hn::Sub(u, share)), part);
    u = hn::Min(left, Splat(0x1.fffffep-1f));
    return take;
  }
};

/// Worths are cut here, so that no sum of them overflows.
inline constexpr float kMostWorth = 1e36f;

LANELIGHT_INLINE VF Luminance(V3 c) {
  return hn::MulAdd(c.x, Splat(0.212671f),
                    hn::MulAdd(c.y, Splat(0.715160f), hn::Mul(c.z, Splat(0.072169f))));
}

/// Stores in the lanes of `take`; the others keep what they have.
LANELIGHT_INLINE void Replace(MF take, VF value, float* column, const StoreSlots& slots) {
  Scatter(hn::IfThenElse(take, value, Gather(column, slots)), column, slots);
}

/// Makes the light sample in ls_* the kept one in the lanes of `take`.
LANELIGHT_INLINE void KeepSample(const PathColumns& p, MF take, VF worth,
                                 const StoreSlots& slots) {
  const auto copy = [&](const float* from, float* to)
                        HWY_ATTR { Replace(take, Gather(from, slots), to, slots); };
  copy(p.ls_x, p.kept_x), copy(p.ls_y, p.kept_y), copy(p.ls_z, p.kept_z);
  copy(p.ls_r, p.kept_r), copy(p.ls_g, p.kept_g), copy(p.ls_b, p.kept_b);
  copy(p.ls_distance, p.kept_distance);
  copy(p.ls_pdf, p.kept_pdf);
  if (p.ls_light != nullptr) {
    copy(reinterpret_cast<const float*>(p.ls_light),
         reinterpret_cast<float*>(p.kept_light));
  }
  Replace(take, worth, p.kept_worth, slots);
}

/// A number in [0, 1) on the grid of 24 bits, moved on by `step` of that grid modulo 1:
/// exact, so that uniform numbers stay uniform.
LANELIGHT_INLINE void Advance(float* column, float step, const StoreSlots& slots) {
  const VF moved = hn::Sub(Gather(column, slots), Splat(1.0f - step));
  const MF below = hn::Lt(moved, hn::Zero(DF()));
  Scatter(hn::IfThenElse(below, hn::Add(moved, Splat(1.0f)), moved), column, slots);
}

/// The nearest number on that grid.
constexpr float OnGrid(double step) {
  return static_cast<float>(static_cast<std::int32_t>(step * 0x1p24 + 0.5)) * 0x1p-24f;
}

/// Moves the numbers of a light sample on to those of the next of `count` candidates:
/// the choice of light by 1 / count, so that they are spread over the lights as evenly as
/// can be, points by powers of the generalised golden ratio (Roberts 2018).
LANELIGHT_INLINE void AdvanceCandidate(const PathColumns& p, std::uint32_t count,
                                       const StoreSlots& slots) {
  if (p.u_select != nullptr) Advance(p.u_select, OnGrid(1.0 / count), slots);
  Advance(p.u_light_0, OnGrid(0.7548776662466927), slots);
  Advance(p.u_light_1, OnGrid(0.5698402909980532), slots);
}

LANELIGHT_END_KERNELS

#endif
