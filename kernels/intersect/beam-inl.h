// A packet of similar rays against the triangles of a leaf at once: the lanes are
// triangles, and those that no ray of the packet can meet drop out. Of 13 triangles that
// a leaf holds, camera rays keep 6.
#ifndef LANELIGHT_INTERSECT_BEAM_INL_H_
#define LANELIGHT_INTERSECT_BEAM_INL_H_

#include <algorithm>
#include <cmath>
#include <limits>

#include "kernels/intersect/leaf-inl.h"
#include "kernels/intersect/many-inl.h"

LANELIGHT_BEGIN_KERNELS

LANELIGHT_INLINE float MinLane(VF v) { return hn::GetLane(hn::MinOfLanes(DF(), v)); }
LANELIGHT_INLINE float MaxLane(VF v) { return hn::GetLane(hn::MaxOfLanes(DF(), v)); }

/// Slopes may differ by at most this from the mean: beyond it the test costs more than it
/// saves. On narrow targets only the rays of a frustum are so similar (AVX2: 0.25 costs
/// bounces and shadow rays 0 to 10 %).
inline constexpr float kBeamSlope = hn::MaxLanes(DF()) >= 16 ? 0.25f : 0.05f;
/// Relative slack for rounding: sheared positions err by less than 10 unit roundoffs
/// (2^-24) of |z| and of themselves. That holds in the test and here: both start with the
/// difference to the origin.
inline constexpr float kBeamSlack = 0x1p-18f;

/// The extent of a packet, in the permuted axes of its rays, which must be equal. Across
/// the packet, the offset of a vertex at distance z from a ray differs from its offset to
/// the middle ray by at most `radius` + `slope` |z| per axis.
struct Beam {
  P3<float> o;  // middle of the origins
  float s[2], radius[2], slope[2];

  LANELIGHT_INLINE bool IsNarrow() const {
    return std::max(slope[0], slope[1]) <= kBeamSlope;
  }
};

/// The beam around the rays of all lanes. A position across is p - o - s z; with s = c +-
/// r and z = z0 +- q over the rays, s z = c z0 +- (|c| q + r |z0| + r q).
LANELIGHT_INLINE Beam MakeBeam(const Shear<VF>& shear) {
  const auto middle = [](VF v, float& radius) HWY_ATTR {
    const float lo = MinLane(v), hi = MaxLane(v);
    constexpr float kRound = 2 * std::numeric_limits<float>::epsilon();
    radius = 0.5f * (hi - lo) + kRound * std::max(std::abs(lo), std::abs(hi));
    return 0.5f * lo + 0.5f * hi;
  };
  Beam beam;
  float across[2], along;
  beam.o = {middle(shear.o.x, across[0]), middle(shear.o.y, across[1]),
            middle(shear.o.z, along)};
  beam.s[0] = middle(shear.s.x, beam.slope[0]);
  beam.s[1] = middle(shear.s.y, beam.slope[1]);
  for (int a = 0; a < 2; ++a) {
    const float moved = (std::abs(beam.s[a]) + beam.slope[a]) * along;
    beam.radius[a] = (1 + kBeamSlack) * (across[a] + moved) + kBeamSlack * along;
    beam.slope[a] = (1 + kBeamSlack) * beam.slope[a] + kBeamSlack;
  }
  return beam;
}

/// Triangles of a leaf, as bits, whose bounds across the beam meet it. `axis`: the
/// permuted order of axes.
template <class Leaf>
LANELIGHT_INLINE uint32_t TrianglesInBeam(const Beam& beam, const Leaf& leaf,
                                          const uint32_t (&axis)[3]) {
  using V = LeafVec<Leaf>;
  const LeafTag<Leaf> d;
  constexpr int kStep = LeafLanes<Leaf>();
  LeafColumn<Leaf> lo[2], hi[2];
  for (int i = 0; i < Leaf::kVertexLanes; i += kStep) {
    const auto from = [&](int a, float o) HWY_ATTR {
      return hn::Sub(hn::Load(d, leaf.vertex[axis[a]] + i), hn::Set(d, o));
    };
    const V z = from(2, beam.o.z);
    const V p[2] = {from(0, beam.o.x), from(1, beam.o.y)};
    for (int a = 0; a < 2; ++a) {
      const V middle = hn::NegMulAdd(hn::Set(d, beam.s[a]), z, p[a]);
      const V radius =
          hn::MulAdd(hn::Set(d, beam.slope[a]), hn::Abs(z), hn::Set(d, beam.radius[a]));
      lo[a].Set(i / kStep, hn::Sub(middle, radius));
      hi[a].Set(i / kStep, hn::Add(middle, radius));
    }
  }
  uint32_t bits = 0;
  for (int i = 0; i < Leaf::kLanes; i += kStep) {
    const auto minimum = [&](const LeafColumn<Leaf>& v) HWY_ATTR {
      return Min3(v.Corner(leaf, 0, i), v.Corner(leaf, 1, i), v.Corner(leaf, 2, i));
    };
    const auto largest = [&](const LeafColumn<Leaf>& v) HWY_ATTR {
      return Max3(v.Corner(leaf, 0, i), v.Corner(leaf, 1, i), v.Corner(leaf, 2, i));
    };
    const V zero = hn::Zero(d);
    const auto below = hn::Le(hn::Max(minimum(lo[0]), minimum(lo[1])), zero);
    const auto above = hn::Ge(hn::Min(largest(hi[0]), largest(hi[1])), zero);
    bits |= MaskBits(d, hn::And(below, above)) << i;
  }
  return bits & UsedLanes(leaf);
}

LANELIGHT_END_KERNELS

#endif
