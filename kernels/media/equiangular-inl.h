// Distances along rays that are uniform in the angle around a light, and so dense where
// its light is strong.
//   source  Kulla and Fajardo 2012, "Importance Sampling Techniques for Path Tracing in
//           Participating Media"
#ifndef LANELIGHT_MEDIA_EQUIANGULAR_INL_H_
#define LANELIGHT_MEDIA_EQUIANGULAR_INL_H_

#include "kernels/media/medium-inl.h"
#include "src/scene/compiled/lights.h"

LANELIGHT_BEGIN_KERNELS

/// Draws the middle of a light by power with two numbers in [0, 1); infinite for lights
/// without a place.
LANELIGHT_INLINE V3 DrawAnchor(const LightChances& table, VF u0, VF u1) {
  const DI di;
  const LightAnchor* anchors = table.anchors.data();
  const std::size_t size = table.anchors.size();
  const VI last = hn::Set(di, static_cast<int32_t>(size) - 1);
  const VF scaled = hn::Mul(u0, Splat(static_cast<float>(size)));
  const VI bin = hn::Min(hn::ConvertTo(di, scaled), last);
  const VF keep = RecordWords(anchors, bin).F(offsetof(LightAnchor, keep));
  const VI other = Gather(table.anchor_alias.data(), bin);
  const auto kept = hn::RebindMask(di, hn::Lt(u1, keep));
  const VI drawn = hn::IfThenElse(kept, bin, other);
  return RecordWords(anchors, drawn).F3(offsetof(LightAnchor, position));
}

/// Distances in (0, length) of a ray from o along d by the angle around `anchor`. The
/// length may be infinite. The distance of ray and anchor is at least `min_distance` > 0,
/// which bounds the density of rays through the anchor.
struct Equiangular {
  VF closest;   // distance along the ray of the point nearest to the anchor
  VF beside;    // distance of the anchor from that point
  VF squared;   // distance of origin and anchor, squared
  VF angle;     // the angle of the length, seen from the anchor
  MF possible;  // the anchor is finite

  LANELIGHT_INLINE Equiangular(V3 o, V3 d, VF length, V3 anchor, VF min_distance) {
    const V3 to = anchor - o;
    closest = Dot(to, d);
    const V3 across = Cross(to, d);
    beside = hn::Max(hn::Sqrt(Dot(across, across)), min_distance);
    squared = hn::MulAdd(closest, closest, Sqr(beside));
    // Not the difference of two angles, which cancels for anchors far away.
    angle = Atan2(beside, hn::Sub(hn::Div(squared, length), closest));
    possible = hn::And(hn::Lt(squared, Splat(std::numeric_limits<float>::infinity())),
                       hn::Gt(angle, Splat(0)));
  }
  /// u in [0, 1].
  LANELIGHT_INLINE VF Sample(VF u) const {
    const SinCosPair at = SinCos2Pi(hn::Mul(hn::Mul(u, angle), Splat(0.159154943f)));
    const VF below = hn::MulAdd(closest, at.sin, hn::Mul(beside, at.cos));
    return hn::Div(hn::Mul(squared, at.sin), below);
  }
  LANELIGHT_INLINE VF Pdf(VF distance) const {
    const VF from = hn::Sub(distance, closest);
    const VF spread = hn::MulAdd(from, from, Sqr(beside));
    return hn::Div(beside, hn::Mul(angle, spread));
  }
};

/// Number of events of a path of which lights draw the distances. Such an event can
/// double the weight of a path, so that many of them would make rare bright samples.
inline constexpr int32_t kEquiangularEvents = 2;

/// Samples one half of the first events in media by the angle around a light.
/// Transmittance decides whether there is an event, so surfaces behind are found as often
/// as before. For a channel with extinction sigma, on a ray of length t, the density is
/// (sigma T(d)
/// + (1 - T(t)) p_angle(d)) / 2.
struct EquiangularHalf {
  Equiangular around;
  VF jitter;  // in [0, 2^-24)

  LANELIGHT_INLINE EquiangularHalf(const Wave& wave, const Slots& slots, VF drawn, VF t)
      : EquiangularHalf(wave, slots, drawn, t, WalkRandom(wave, slots, 0x9e3779b1u)) {}

  /// Returns the distance of an event of a channel with extinction `drawn`, u in [0, 1 -
  /// T(t)).
  LANELIGHT_INLINE VF Sample(VF drawn, VF t, VF u) const {
    const VF half = Splat(0.5f);
    const VF fraction = hn::Div(hn::Add(u, jitter), Interacted(drawn, t));
    const MF turns = hn::And(around.possible, hn::Ge(fraction, half));
    const VF rest = hn::IfThenElse(around.possible, hn::Add(u, u), u);
    const VF below_1 = hn::Min(rest, Splat(1 - 0x1p-24f));
    const VF straight = hn::Div(ExponentialOf(below_1), drawn);
    const VF xi = hn::Min(hn::MulAdd(fraction, Splat(2), Splat(-1.0f)), Splat(1.0f));
    return hn::Min(hn::IfThenElse(turns, around.Sample(xi), straight), t);
  }
  /// Converts the densities of an event at d by transmittance alone.
  LANELIGHT_INLINE V3 Density(V3 by_transmittance, V3 sigma_t, VF t, VF d) const {
    const V3 by_angle = Mul(Interacted(sigma_t, t), around.Pdf(d));
    return IfThenElse(around.possible, Mul(by_transmittance + by_angle, Splat(0.5f)),
                      by_transmittance);
  }

 private:
  LANELIGHT_INLINE EquiangularHalf(const Wave& wave, const Slots& slots, VF drawn, VF t,
                                   WalkRandom random)
      : around(Around(wave, slots, drawn, t, random)), jitter(Jitter(random)) {
    const VI limit = hn::Set(DI(), kEquiangularEvents);
    const auto early = hn::Lt(Gather(wave.path.depth, slots), limit);
    around.possible = hn::And(around.possible, hn::RebindMask(DF(), early));
  }
  LANELIGHT_INLINE static Equiangular Around(const Wave& wave, const Slots& slots,
                                             VF drawn, VF t, WalkRandom& random) {
    const PathColumns& p = wave.path;
    const V3 o = Gather3(p.o_x, p.o_y, p.o_z, slots);
    const V3 d = Gather3(p.d_x, p.d_y, p.d_z, slots);
    VF u0, u1;
    random.Next(&u0, &u1);
    const V3 anchor = DrawAnchor(*wave.chances, u0, u1);
    const V3 to = anchor - o;
    const VF reach = hn::Min(t, hn::Div(Splat(1.0f), drawn));
    const VF min_distance = hn::Mul(Splat(1e-4f), hn::Add(hn::Sqrt(Dot(to, to)), reach));
    return Equiangular(o, d, t, anchor, min_distance);
  }
  LANELIGHT_INLINE static VF Jitter(WalkRandom& random) {
    VF u0, u1;
    random.Next(&u0, &u1);
    return hn::Mul(u0, Splat(0x1p-24f));
  }
};

LANELIGHT_END_KERNELS

#endif
