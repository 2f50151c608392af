// Samples distances in heterogeneous media by null collisions against the majorants of
// cells.
//   density     of tentative collisions: that of the channel's majorant sigma_m; of each,
//               that it is real: sigma_t / sigma_m
//   estimator   a real one scatters with sigma_s / sigma_t, after a null one the ray
//               continues; over the mean density of the channels (medium-inl.h)
//   unbiased    sigma_m >= sigma_t everywhere in the cell, as the scene is compiled
//   emission    sigma_a Le / sigma_m at each tentative collision
//   cost        proportional to the majorants along the ray
//   source      Woodcock et al. 1965; Kutz et al. 2017; Miller, Georgiev and Jarosz 2019
#include "kernels/simd/each_target-inl.h"

#include "kernels/media/emission-inl.h"
#include "kernels/media/event-inl.h"
#include "kernels/media/grid-inl.h"
#include "kernels/queue/batch-inl.h"

LANELIGHT_BEGIN_KERNELS

// A walk of a vector of rays: f and the densities of the channels over that of the one
// drawn, the event at its end, and the emission on the way.
template <bool kEmission>
struct Track {
  const GridMedium& medium;
  const GridEmission* emission;  // null without kEmission
  const Channel& channel;
  V3 odds;  // before the walk
  V3 f = Splat3(1, 1, 1), pdf = Splat3(1, 1, 1);
  V3 emitted = Splat3(0, 0, 0);
  MF event = hn::FirstN(DF(), 0);

  // Advances by dt in a cell with majorants sigma_m.
  HWY_INLINE void Pass(MF mask, V3 sigma_m, VF dt) {
    const VF own = channel.Of(sigma_m);
    const auto other = [&](VF sigma) HWY_ATTR {
      const VF power = hn::Mul(hn::Sub(own, sigma), dt);
      return hn::IfThenElse(mask, Exp(hn::Min(power, Splat(80.0f))), Splat(1.0f));
    };
    const V3 relative = {other(sigma_m.x), other(sigma_m.y), other(sigma_m.z)};
    f = Mul(f, relative);
    pdf = Mul(pdf, relative);
  }
  // Adds the medium's emission at a tentative collision at p.
  HWY_INLINE void Emit(MF mask, V3 sigma_m, V3 p, V3 sigma_a) {
    const V3 candidates = Mul(odds, Mul(pdf, sigma_m));
    const V3 sent = Mul(Mul(f, sigma_a), hn::Div(Splat(1.0f), MeanChannel(candidates)));
    emitted = emitted + IfThenElseZero(mask, Mul(sent, emission->At(p, mask)));
  }
  // Samples a tentative collision at p; returns whether it is real.
  HWY_INLINE MF Collide(MF mask, V3 sigma_m, V3 p, VF u) {
    const Coefficients at = medium.At(p, mask);
    const V3 sigma_t = at.sigma_a + at.sigma_s, null = sigma_m - sigma_t;
    LL_DCHECK(AllUnder(mask, hn::Ge(hn::Min(null.x, hn::Min(null.y, null.z)), Splat(0))));
    const VF own_m = channel.Of(sigma_m), own_t = channel.Of(sigma_t);
    if constexpr (kEmission) Emit(mask, sigma_m, p, at.sigma_a);
    const MF real = hn::And(mask, hn::Lt(hn::Mul(u, own_m), own_t));
    const VF rate = hn::Div(Splat(1.0f), own_t);
    const VF null_rate = hn::Div(Splat(1.0f), channel.Of(null));
    const V3 happens_f = IfThenElse(real, Mul(at.sigma_s, rate), Mul(null, null_rate));
    const V3 happens_p = IfThenElse(real, Mul(sigma_t, rate), Mul(null, null_rate));
    f = IfThenElse(mask, Mul(f, happens_f), f);
    pdf = IfThenElse(mask, Mul(pdf, happens_p), pdf);
    return real;
  }
  HWY_INLINE void Walk(CellWalk& at, WalkRandom& random, VF depth_left) {
    const V3 scale = medium.MajorantScale();
    for (;;) {
      const MF going = hn::AndNot(event, at.IsInside());
      if (hn::AllFalse(DF(), going)) return;
      const V3 sigma_m = Mul(scale, at.Majorant(medium.grid));
      const VF own = channel.Of(sigma_m), room = hn::Sub(at.Exit(), at.t);
      const VF needed = hn::Div(depth_left, own);
      const MF collides = hn::And(going, hn::Lt(needed, room));
      const VF dt = hn::IfThenElse(collides, needed, room);
      Pass(going, sigma_m, dt);
      const MF crosses = hn::AndNot(collides, going);
      depth_left =
          hn::IfThenElse(crosses, hn::NegMulAdd(own, dt, depth_left), depth_left);
      at.Advance(collides, own, dt);
      at.Cross(crosses);
      VF u0, u1;
      random.Next(&u0, &u1);
      if (hn::AllFalse(DF(), collides)) continue;
      event = hn::Or(event, Collide(collides, sigma_m, at.Point(at.t), u0));
      depth_left = hn::IfThenElse(collides, ExponentialOf(u1), depth_left);
    }
  }
};

template <bool kEmission>
HWY_INLINE void TrackBatch(Wave& wave, const GridMedium& medium,
                           const GridEmission* emission, const StoreSlots& slots) {
  const PathColumns& p = wave.path;
  const VF t = Gather(p.t, slots), u = Gather(p.u_medium_1, slots);
  SpectralThroughput path(p, slots);
  const V3 before = path.odds;
  const Channel channel(before, u);
  CellWalk at(medium, Gather3(p.o_x, p.o_y, p.o_z, slots),
              Gather3(p.d_x, p.d_y, p.d_z, slots), t);
  WalkRandom random(wave, slots, 0x1b873593u);
  // Drawn before the walk, because the number of values that the walk draws depends on
  // the other lanes.
  VF behind_0, behind_1;
  random.Next(&behind_0, &behind_1);
  Track<kEmission> track{medium, emission, channel, before};
  track.Walk(at, random, ExponentialOf(Gather(p.u_medium_0, slots)));
  if constexpr (kEmission) {
    const V3 l = Gather3(p.l_r, p.l_g, p.l_b, slots);
    Scatter3(l + Mul(path.beta, track.emitted), p.l_r, p.l_g, p.l_b, slots);
  }
  path.ApplyEvent(track.f, track.pdf);
  path.Store(p, slots);
  Scatter(behind_0, p.u_medium_0, slots);
  Scatter(channel.Redrawn(before, path.odds, u), p.u_medium_1, slots);
  const VI material = hn::Set(DI(), static_cast<int32_t>(medium.medium.material));
  StoreEvent(p, slots, track.event, at.t, material);
}

template <bool kEmission>
void MediumTracking(Wave& wave) {
  const MediumTable& table = *wave.media;
  for (std::size_t i = 0; i < table.media.size(); ++i) {
    if (table.media[i].grid < 0) continue;
    const VI own = hn::Set(DI(), static_cast<int32_t>(i));
    const Queue& mine =
        FilterQueue(wave, wave.queue(QueueId::kActive), [&](const Slots& slots) HWY_ATTR {
          const VI index = Gather(wave.path.medium, slots);
          return hn::RebindMask(DF(), hn::Eq(index, own));
        });
    ForEachBatch(wave, mine, [&](const StoreSlots& slots, MF) HWY_ATTR {
      const GridMedium medium(wave, i, slots);
      if constexpr (kEmission) {
        const GridEmission emission(wave, i, slots);
        TrackBatch<true>(wave, medium, &emission, slots);
      } else {
        TrackBatch<false>(wave, medium, nullptr, slots);
      }
    });
  }
  QueueEvents(wave);
}

Stage MediumTrackingStage() {
  return MediumEventStage(
      "medium_tracking", "samples distances in heterogeneous media",
      Feature::kMediumGrids,
      ByFeature<Feature::kMediumEmission, MediumTracking<true>, MediumTracking<false>>);
}

LANELIGHT_END_KERNELS
