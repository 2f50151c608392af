// Samples distances in homogeneous media: to a scattering event, or to the surface.
//   density     of scattering at d: sigma_t exp(-sigma_t d), of the channel drawn; of
//               reaching the surface: exp(-sigma_t t)
//   estimator   sigma_s T / mean density over channels, and T / mean density
//               (medium-inl.h)
//   unbiased    a channel that scatters has sigma_t > 0, so its distances are drawn
//   variance    none from T if all channels are equal
//   absorbers   sigma_s = 0: there are no events, and T is the weight
//   distances=equiangular  half of the first points of a path by the angle around a light
//   emission    what the medium emits along the ray is known in closed form, and added
//   interfaces  the remaining optical depth is again exponential: the number is reused
//   source      Novak et al. 2018, "Monte Carlo Methods for Volumetric Light Transport
//               Simulation"; Wilkie et al. 2014 (spectral sampling)
#include "kernels/simd/each_target-inl.h"

#include "hwy/contrib/math/math-inl.h"

#include "kernels/media/equiangular-inl.h"
#include "kernels/media/event-inl.h"
#include "kernels/queue/batch-inl.h"

LANELIGHT_BEGIN_KERNELS

// The integral of emission T over a length.
HWY_INLINE V3 EmittedOver(V3 emission, V3 sigma_t, VF length) {
  const auto one = [&](VF e, VF sigma) HWY_ATTR {
    const VF depth = hn::Mul(sigma, length);
    // (1 - exp(-x)) / x cancels for small x, where its series is used.
    const VF series =
        hn::MulAdd(depth, hn::MulAdd(depth, Splat(1.0f / 6), Splat(-0.5f)), Splat(1.0f));
    const VF thick = hn::Div(hn::Sub(Splat(1.0f), Transmittance(sigma, length)), sigma);
    const VF thin = hn::Mul(length, series);
    const VF path = hn::IfThenElse(hn::Lt(depth, Splat(0.01f)), thin, thick);
    return hn::IfThenElseZero(hn::Gt(e, hn::Zero(DF())), hn::Mul(e, path));
  };
  return {one(emission.x, sigma_t.x), one(emission.y, sigma_t.y),
          one(emission.z, sigma_t.z)};
}

HWY_INLINE void AddEmission(const Wave& wave, const StoreSlots& slots, V3 beta,
                            const Media& medium, VF length) {
  const PathColumns& p = wave.path;
  const V3 emitted =
      EmittedOver(medium.Emission(wave, slots), medium.SigmaT(wave, slots), length);
  const V3 l = Gather3(p.l_r, p.l_g, p.l_b, slots);
  Scatter3(l + Mul(beta, emitted), p.l_r, p.l_g, p.l_b, slots);
}

// The parts of the walk that a scene and a strategy need.
template <bool interfaces, bool emission, bool equiangular>
struct Needs {
  static constexpr bool kInterfaces = interfaces, kEmission = emission,
                        kEquiangular = equiangular;
};

template <class Needs>
HWY_INLINE void Walk(Wave& wave, const StoreSlots& slots) {
  const DF df;
  const PathColumns& p = wave.path;
  const Media medium(*wave.media, Gather(p.medium, slots));
  const V3 sigma_t = medium.SigmaT(wave, slots);
  const VF t = Gather(p.t, slots), u = Gather(p.u_medium_1, slots);
  const VF u_distance = Gather(p.u_medium_0, slots);
  const VF keep = hn::Sub(Splat(1.0f), u_distance);
  SpectralThroughput path(p, slots);
  const V3 before = path.odds;
  const Channel channel(before, u);
  const VF drawn = channel.Of(sigma_t);
  const VF far = Splat(std::numeric_limits<float>::infinity());
  const MF samples = medium.Scatters();
  const MF can = hn::And(samples, hn::Gt(drawn, hn::Zero(df)));
  VF d = hn::IfThenElse(can, hn::Div(hn::Neg(hn::Log(df, keep)), drawn), far);
  const MF event = hn::Lt(d, t);
  if constexpr (Needs::kEmission) AddEmission(wave, slots, path.beta, medium, t);
  V3 left, found;  // transmittance, and the densities of an event after it
  const auto reach = [&]() HWY_ATTR {
    left = Transmittance(sigma_t, hn::Min(d, t));
    found = Mul(left, sigma_t);
  };
  if constexpr (Needs::kEquiangular) {
    const EquiangularHalf half(wave, slots, drawn, t);
    d = hn::IfThenElse(event, half.Sample(drawn, t, u_distance), d);
    reach();
    found = half.Density(found, sigma_t, t, d);
  } else {
    reach();
  }
  V3 sigma_s = medium.SigmaS(wave, slots);
  const V3 one = Splat3(1, 1, 1);
  if (p.inside_r != nullptr) {
    const V3 albedo = Gather3(p.inside_r, p.inside_g, p.inside_b, slots);
    sigma_s = IfThenElse(medium.IsTextured(), Mul(sigma_t, albedo), sigma_s);
  }
  // Absorbers let all rays reach the surface.
  const V3 passes = IfThenElse(samples, left, one);
  path.ApplyEvent(IfThenElse(event, Mul(left, sigma_s), left),
                  IfThenElse(event, found, passes));
  path.Store(p, slots);
  if constexpr (Needs::kInterfaces) {
    const VF unused = hn::Div(keep, channel.Of(passes));
    Scatter(hn::Max(hn::Sub(Splat(1.0f), unused), hn::Zero(df)), p.u_medium_0, slots);
    Scatter(channel.Redrawn(before, path.odds, u), p.u_medium_1, slots);
  }
  StoreEvent(p, slots, event, d, medium.I(offsetof(MediumRecord, material)));
}

template <class Needs>
void MediumDistance(Wave& wave) {
  const PathColumns& p = wave.path;
  const bool grids = !wave.media->grids.empty();
  const Queue& mine =
      FilterQueue(wave, wave.queue(QueueId::kActive), [&](const Slots& slots) HWY_ATTR {
        const VI index = Gather(p.medium, slots);
        const MF inside = IsInMedium(index);
        return grids ? hn::AndNot(Media(*wave.media, index).Varies(), inside) : inside;
      });
  ForEachBatch(wave, mine,
               [&](const StoreSlots& slots, MF) HWY_ATTR { Walk<Needs>(wave, slots); });
  QueueEvents(wave);
}

StageFn ResolveMediumDistance(const FeatureSet& features) {
  const auto by = [&](Feature feature, const auto& kernel) -> StageFn {
    return features.Has(feature) ? kernel(std::true_type()) : kernel(std::false_type());
  };
  return by(Feature::kInterfaces, [&](auto interfaces) {
    return by(Feature::kMediumEmission, [&](auto emission) {
      return by(Feature::kEquiangularDistances, [&](auto equiangular) -> StageFn {
        return MediumDistance<
            Needs<decltype(interfaces)::value, decltype(emission)::value,
                  decltype(equiangular)::value>>;
      });
    });
  });
}

Stage MediumDistanceStage() {
  return MediumEventStage("medium_distance", "samples distances in homogeneous media",
                          Feature::kMedia, ResolveMediumDistance);
}

LANELIGHT_END_KERNELS
