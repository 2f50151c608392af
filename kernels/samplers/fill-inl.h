// Fills the sample-point columns of a queue from a sampler policy.
//
// A policy is a struct with
//   static GroupIndex Group(const SamplerParameters&, VU sample)   (group-inl.h)
//   static void Point(const PointKey&, VF* u0, VF* u1)
// giving a point in [0,1)^2 for a dimension key (src/vocabulary/path/dimensions.h). The
// two coordinates of one key are stratified against each other where the policy
// stratifies; different keys are independent of each other. A scalar dimension takes u0;
// a policy whose u0 alone is less well stratified than one dimension can be has also
//   static VF Number(const PointKey&)
#ifndef LANELIGHT_SAMPLERS_FILL_INL_H_
#define LANELIGHT_SAMPLERS_FILL_INL_H_

#include "kernels/samplers/group-inl.h"
#include "kernels/samplers/wavelength-inl.h"
#include "kernels/queue/batch-inl.h"

LANELIGHT_BEGIN_KERNELS

template <class Policy>
concept HasNumber = requires(PointKey of) { Policy::Number(of); };

/// One batch of paths that draw numbers.
struct Drawer {
  const StoreSlots& slots;
  VU pixel, sample, key;  // key: of dimension 0 at this depth and branch
};

/// Pairs and splitting change which numbers a path draws; without them none of their
/// instructions are executed.
template <bool kPlain>
LANELIGHT_INLINE Drawer MakeDrawer(const PathColumns& p, const StoreSlots& slots) {
  const VU depth = AsUnsigned(Gather(p.depth, slots));
  const VU key = kPlain ? FirstKey(depth) : FirstKey(p, depth, slots);
  return {slots, AsUnsigned(Gather(p.pixel, slots)), AsUnsigned(Gather(p.sample, slots)),
          key};
}

/// Sample index that the numbers of a dimension come from: the two samples of an
/// antithetic pair share it, but for wavelengths and the choice of a light candidate.
LANELIGHT_INLINE VU PairedSample(bool pairs, Dimension dimension, VU sample) {
  if (!pairs) return sample;
  const bool unpaired =
      dimension == Dimension::kWavelength || dimension == Dimension::kCandidate;
  return unpaired ? UnpairedSample(sample) : hn::ShiftRight<1>(sample);
}

/// Draws one dimension of one batch, unless the plan has no column for it. A scalar one
/// has one column.
template <class Policy, bool kPlain, bool kScalar>
LANELIGHT_INLINE void Draw(const RunParameters& run, const Drawer& drawer,
                           Dimension dimension, float* out0, float* out1 = nullptr) {
  if (out0 == nullptr) return;
  const VU key = hn::Add(drawer.key, SplatU(static_cast<uint32_t>(dimension)));
  const VU sample =
      kPlain ? drawer.sample : PairedSample(run.pairs, dimension, drawer.sample);
  const GroupIndex at = Policy::Group(run.sampler, sample);
  const PointKey of = {drawer.pixel, at, key, SplatU(run.seed)};
  VF u0, u1;
  if constexpr (kScalar && HasNumber<Policy>) {
    u0 = Policy::Number(of);
  } else {
    Policy::Point(of, &u0, &u1);
  }
  Scatter(u0, out0, drawer.slots);
  if constexpr (!kScalar) Scatter(u1, out1, drawer.slots);
}

template <class Policy, bool kPlain>
LANELIGHT_INLINE void FillWavelength(const RunParameters& run, const Drawer& drawer,
                                     const PathColumns& p) {
  if (run.sampler.by_tile) {
    const VF number = TileWavelength(run, drawer.pixel, drawer.sample);
    Scatter(number, p.wavelength, drawer.slots);
  } else if (run.sampler.group_shift > 0 && !run.features.Has(Feature::kDispersion)) {
    const VF number = PixelWavelength(run, drawer.pixel, drawer.sample);
    Scatter(number, p.wavelength, drawer.slots);
  } else {
    Draw<Policy, kPlain, true>(run, drawer, Dimension::kWavelength, p.wavelength);
  }
}

template <class Policy, bool kPlain>
LANELIGHT_INLINE void FillCameraBatches(Wave& wave) {
  const PathColumns p = wave.path;
  const RunParameters run = *wave.run;
  const bool by_tile = run.features.Has(Feature::kSharedPixelSamples);
  ForEachBatch(
      wave, wave.queue(QueueId::kCamera), [&](const StoreSlots& slots, MF) HWY_ATTR {
        const Drawer drawer = MakeDrawer<kPlain>(p, slots);
        Drawer film = drawer;
        if (by_tile) film.pixel = SplatU(wave.work.tile_pixel);
        Draw<Policy, kPlain, false>(run, film, Dimension::kFilm, p.u_film_0, p.u_film_1);
        Draw<Policy, kPlain, false>(run, drawer, Dimension::kLens, p.u_lens_0,
                                    p.u_lens_1);
        Draw<Policy, kPlain, true>(run, drawer, Dimension::kTime, p.time);
        Draw<Policy, kPlain, false>(run, drawer, Dimension::kCameraMedium, p.u_medium_0,
                                    p.u_medium_1);
        if (p.wavelength != nullptr) FillWavelength<Policy, kPlain>(run, drawer, p);
      });
}

template <class Policy, bool kPlain>
LANELIGHT_INLINE void FillBounceBatches(Wave& wave) {
  const PathColumns p = wave.path;
  const RunParameters run = *wave.run;
  ForEachBatch(
      wave, wave.queue(QueueId::kVertex), [&](const StoreSlots& slots, MF) HWY_ATTR {
        const Drawer drawer = MakeDrawer<kPlain>(p, slots);
        Draw<Policy, kPlain, false>(run, drawer, Dimension::kBsdf, p.u_bsdf_0,
                                    p.u_bsdf_1);
        Draw<Policy, kPlain, true>(run, drawer, Dimension::kLobe, p.u_lobe);
        Draw<Policy, kPlain, false>(run, drawer, Dimension::kLight, p.u_light_0,
                                    p.u_light_1);
        Draw<Policy, kPlain, true>(run, drawer, Dimension::kSelect, p.u_select);
        Draw<Policy, kPlain, true>(run, drawer, Dimension::kRoulette, p.u_roulette);
        Draw<Policy, kPlain, true>(run, drawer, Dimension::kCandidate, p.u_candidate);
        Draw<Policy, kPlain, false>(run, drawer, Dimension::kMedium, p.u_medium_0,
                                    p.u_medium_1);
      });
}

LANELIGHT_INLINE bool IsUnpaired(const Wave& wave) {
  return !wave.run->pairs && wave.path.branch == nullptr;
}

template <class Policy>
LANELIGHT_INLINE void FillCamera(Wave& wave) {
  IsUnpaired(wave) ? FillCameraBatches<Policy, true>(wave)
                   : FillCameraBatches<Policy, false>(wave);
}

template <class Policy>
LANELIGHT_INLINE void FillBounce(Wave& wave) {
  IsUnpaired(wave) ? FillBounceBatches<Policy, true>(wave)
                   : FillBounceBatches<Policy, false>(wave);
}

LANELIGHT_END_KERNELS

#endif
