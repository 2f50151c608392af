// Media along shadow rays.
#ifndef LANELIGHT_MEDIA_SHADOW_INL_H_
#define LANELIGHT_MEDIA_SHADOW_INL_H_

#include "kernels/media/grid-inl.h"
#include "kernels/media/medium-inl.h"

LANELIGHT_BEGIN_KERNELS

/// Returns the medium in which a shadow ray starts: that of the path, or the one on the
/// light's side of the surface.
template <bool kChanges>
LANELIGHT_INLINE VI ShadowStartMedium(const Wave& wave, const Slots& slots) {
  const PathColumns& p = wave.path;
  const VI here = Gather(p.medium, slots);
  if constexpr (!kChanges) return here;
  const V3 ls = Gather3(p.ls_x, p.ls_y, p.ls_z, slots);
  const V3 ng = Gather3(p.ng_x, p.ng_y, p.ng_z, slots);
  return Sides(*wave.media, Gather(p.prim, slots)).Toward(ls, ng, here);
}

/// Returns what a tentative collision leaves of a ray: all but the share `real` of real
/// collisions in each channel (ratio tracking: Novak, Selle and Jarosz 2014), at least 0.
LANELIGHT_INLINE V3 Leaves(V3 left, V3 real) {
  const V3 after = Mul(left, Splat3(1, 1, 1) - real);
  return IfThenElse(hn::Gt(MaxComponent(after), Splat(0)), after, Splat3(0, 0, 0));
}

/// Returns the transmittance of `length` of a heterogeneous medium by tentative
/// collisions, with one majorant for all channels, so that no channel needs another's
/// weight.
LANELIGHT_INLINE V3 TrackedTransmittance(const GridMedium& medium, V3 o, V3 d, VF length,
                                         WalkRandom& random) {
  CellWalk at(medium, o, d, length);
  const VF scale = MaxComponent(medium.MajorantScale()), zero = Splat(0);
  V3 left = Splat3(1, 1, 1);
  VF u0, u1;
  random.Next(&u0, &u1);
  VF depth = ExponentialOf(u0);
  for (;;) {
    const MF going = hn::And(at.IsInside(), hn::Gt(MaxComponent(left), zero));
    if (hn::AllFalse(DF(), going)) return left;
    const VF sigma_m = hn::Mul(scale, at.Majorant(medium.grid));
    const VF room = hn::Sub(at.Exit(), at.t), needed = hn::Div(depth, sigma_m);
    const MF collides = hn::And(going, hn::Lt(needed, room));
    const MF crosses = hn::AndNot(collides, going);
    depth = hn::IfThenElse(crosses, hn::NegMulAdd(sigma_m, room, depth), depth);
    at.Advance(collides, sigma_m, needed);
    at.Cross(crosses);
    if (hn::AllFalse(DF(), collides)) continue;
    random.NextWhere(collides, &u0, &u1);
    depth = hn::IfThenElse(collides, ExponentialOf(u0), depth);
    const Coefficients c = medium.At(at.Point(at.t), collides);
    const V3 real = Mul(c.sigma_a + c.sigma_s, hn::Div(Splat(1.0f), sigma_m));
    left = IfThenElse(collides, Leaves(left, real), left);
  }
}

/// A length of a shadow ray from o in a medium. `number` counts the lengths before it.
struct ShadowLeg {
  VI medium;
  V3 o;
  VF length;
  uint32_t number;
};

/// Returns the transmittance of lanes in media with a grid; 1 for the others.
HWY_NOINLINE V3 GridTransmittance(const Wave& wave, const Slots& slots,
                                  const ShadowLeg& leg, V3 d) {
  const MediumTable& table = *wave.media;
  V3 left = Splat3(1, 1, 1);
  for (std::size_t i = 0; i < table.media.size(); ++i) {
    if (table.media[i].grid < 0) continue;
    const auto mine = hn::Eq(leg.medium, hn::Set(DI(), static_cast<int32_t>(i)));
    if (hn::AllFalse(DI(), mine)) continue;
    const GridMedium medium(wave, i, slots);
    WalkRandom random(wave, slots, 0xcc9e2d51u + leg.number * 0x85ebca6bu);
    const MF lanes = hn::RebindMask(DF(), mine);
    const VF own = hn::IfThenElseZero(lanes, leg.length);
    left = Mul(left, TrackedTransmittance(medium, leg.o, d, own, random));
  }
  return left;
}

/// Multiplies what the shadow ray carries by the transmittance of a length of it.
LANELIGHT_INLINE void DimShadow(const Wave& wave, const StoreSlots& slots,
                                const ShadowLeg& leg) {
  const PathColumns& p = wave.path;
  const MediumTable& table = *wave.media;
  const Media medium(table, leg.medium);
  MF homogeneous = IsInMedium(leg.medium);
  V3 left = Splat3(1, 1, 1);
  if (!table.grids.empty()) {
    homogeneous = hn::AndNot(medium.Varies(), homogeneous);
    const V3 d = Gather3(p.ls_x, p.ls_y, p.ls_z, slots);
    left = GridTransmittance(wave, slots, leg, d);
  }
  const V3 sigma_t = IfThenElseZero(homogeneous, medium.SigmaT(wave, slots));
  left = Mul(left, Transmittance(sigma_t, leg.length));
  const V3 sh = Mul(Gather3(p.sh_r, p.sh_g, p.sh_b, slots), left);
  Scatter3(sh, p.sh_r, p.sh_g, p.sh_b, slots);
}

LANELIGHT_END_KERNELS

#endif
