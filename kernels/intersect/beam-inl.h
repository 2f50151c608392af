// A packet of similar rays against the triangles of a leaf at once: the lanes are
// triangles, and those that no ray of the packet can meet drop out. Of 13 triangles that
// a leaf holds, camera rays keep 6.
#if defined(LANELIGHT_INTERSECT_BEAM_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef LANELIGHT_INTERSECT_BEAM_INL_H_
#undef LANELIGHT_INTERSECT_BEAM_INL_H_
#else
#define LANELIGHT_INTERSECT_BEAM_INL_H_
#endif

#include <algorithm>
#include <cmath>
#include <limits>

#include "kernels/intersect/leaf-inl.h"
#include "kernels/intersect/many-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lanelight {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

HWY_INLINE float LeastLane(VF v) { return hn::GetLane(hn::MinOfLanes(DF(), v)); }
HWY_INLINE float LargestLane(VF v) { return hn::GetLane(hn::MaxOfLanes(DF(), v)); }

/// Slopes may differ by at most this from the mean for the test to pay: on narrow targets
/// only those of a frustum's rays do (AVX2: 0.25 costs bounces and shadow rays 0 to 10
/// %).
inline constexpr float kBeamSlope = hn::MaxLanes(DF()) >= 16 ? 0.25f : 0.05f;
/// What rounding may change, relatively: sheared positions err by less than 10 unit
/// roundoffs (2^-24) of |z| and of themselves, where they are tested and here, because
/// the first step of both is the difference to the origin.
inline constexpr float kBeamSlack = 0x1p-18f;

/// Where a packet passes. Seen in the permuted axes of its rays, which must be the same,
/// a vertex at distance z from the middle of the origins is, relative to any of the rays,
/// at most `radius` + `slope` |z| away from where it is relative to the middle one, for
/// the two axes across.
struct Beam {
  P3<float> o;  // middle of the origins
  float s[2], radius[2], slope[2];

  HWY_INLINE bool IsNarrow() const { return std::max(slope[0], slope[1]) <= kBeamSlope; }
};

/// The beam around the rays of all lanes. A position across is p - o - s z; with s = c +-
/// r and z = z0 +- q over the rays, s z = c z0 +- (|c| q + r |z0| + r q).
HWY_INLINE Beam MakeBeam(const Shear<VF>& shear) {
  const auto middle = [](VF v, float& radius) HWY_ATTR {
    const float lo = LeastLane(v), hi = LargestLane(v);
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

/// Triangles of a leaf, as bits, whose bounds across the beam meet it. `row`: the rows of
/// TriangleLeaf::vertex in the permuted order of axes.
HWY_INLINE uint32_t TrianglesInBeam(const Beam& beam, const TriangleLeaf& leaf,
                                    const uint32_t (&row)[3]) {
  const DL d;
  const hn::RebindToUnsigned<DL> du;
  const hn::Rebind<uint8_t, DL> d8;
  LeafAxis lo[2], hi[2];
  for (int i = 0; i < kLeafVertices; i += LeafLanes()) {
    const auto from = [&](int a, float o) HWY_ATTR {
      return hn::Sub(hn::Load(d, leaf.vertex[row[a]] + i), hn::Set(d, o));
    };
    const VL z = from(2, beam.o.z);
    const VL p[2] = {from(0, beam.o.x), from(1, beam.o.y)};
    for (int a = 0; a < 2; ++a) {
      const VL middle = hn::NegMulAdd(hn::Set(d, beam.s[a]), z, p[a]);
      const VL radius =
          hn::MulAdd(hn::Set(d, beam.slope[a]), hn::Abs(z), hn::Set(d, beam.radius[a]));
      lo[a].Set(i / LeafLanes(), hn::Sub(middle, radius));
      hi[a].Set(i / LeafLanes(), hn::Add(middle, radius));
    }
  }
  uint32_t bits = 0;
  for (int i = 0; i < kLeafTriangles; i += LeafLanes()) {
    const auto a = hn::PromoteTo(du, hn::LoadU(d8, leaf.corner[0] + i));
    const auto b = hn::PromoteTo(du, hn::LoadU(d8, leaf.corner[1] + i));
    const auto c = hn::PromoteTo(du, hn::LoadU(d8, leaf.corner[2] + i));
    const VL least = hn::Max(Min3(lo[0].At(a), lo[0].At(b), lo[0].At(c)),
                             Min3(lo[1].At(a), lo[1].At(b), lo[1].At(c)));
    const VL largest = hn::Min(Max3(hi[0].At(a), hi[0].At(b), hi[0].At(c)),
                               Max3(hi[1].At(a), hi[1].At(b), hi[1].At(c)));
    const VL zero = hn::Zero(d);
    bits |= MaskBits(d, hn::And(hn::Le(least, zero), hn::Ge(largest, zero))) << i;
  }
  return bits & leaf.used;
}

}  // namespace HWY_NAMESPACE
}  // namespace lanelight
HWY_AFTER_NAMESPACE();

#endif
