// Fills the sample-point columns of a queue from a sampler policy.
//
// A policy is a struct with
//   static void Point(const RunParameters&, VU pixel, VU sample, VU key, VF* u0, VF* u1)
// giving a point in [0,1)^2 for a dimension key (src/wavefront/dimensions.h). The two
// coordinates of one key are stratified against each other where the policy stratifies;
// different keys are independent of each other.
#if defined(LANELIGHT_POINTS_FILL_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef LANELIGHT_POINTS_FILL_INL_H_
#undef LANELIGHT_POINTS_FILL_INL_H_
#else
#define LANELIGHT_POINTS_FILL_INL_H_
#endif

#include "kernels/simd/rng-inl.h"
#include "src/wavefront/dimensions.h"

HWY_BEFORE_NAMESPACE();
namespace lanelight {
namespace HWY_NAMESPACE {

/// One dimension of every path in the queue. `out1` may be null (a scalar dimension).
template <class Policy>
HWY_INLINE void FillDimension(Wave& wave, const Queue& queue, Dimension dimension,
                              float* out0, float* out1) {
  const uint32_t lanes = static_cast<uint32_t>(hn::Lanes(DF()));
  const VU count = SplatU(static_cast<uint32_t>(Dimension::kCount));
  const VU offset = SplatU(static_cast<uint32_t>(dimension));
  for (uint32_t i = 0; i < queue.size; i += lanes) {
    const VI slots = hn::LoadU(DI(), reinterpret_cast<const int32_t*>(queue.items) + i);
    const VU pixel = AsUnsigned(Gather(wave.path.pixel, slots));
    const VU sample = AsUnsigned(Gather(wave.path.sample, slots));
    const VU depth = AsUnsigned(Gather(wave.path.depth, slots));
    VF u0, u1;
    Policy::Point(*wave.run, pixel, sample, hn::Add(hn::Mul(depth, count), offset), &u0,
                  &u1);
    Scatter(u0, out0, slots);
    if (out1 != nullptr) Scatter(u1, out1, slots);
  }
}

template <class Policy>
HWY_INLINE void FillCamera(Wave& wave) {
  const Queue& queue = wave.queue(QueueId::kCamera);
  PadTail(queue);
  const PathColumns& p = wave.path;
  FillDimension<Policy>(wave, queue, Dimension::kFilm, p.u_film_0, p.u_film_1);
  if (p.u_lens_0 != nullptr) {
    FillDimension<Policy>(wave, queue, Dimension::kLens, p.u_lens_0, p.u_lens_1);
  }
  CountBatches(wave, queue);
}

template <class Policy>
HWY_INLINE void FillBounce(Wave& wave) {
  const Queue& queue = wave.queue(QueueId::kSurface);
  PadTail(queue);
  const PathColumns& p = wave.path;
  FillDimension<Policy>(wave, queue, Dimension::kBsdf, p.u_bsdf_0, p.u_bsdf_1);
  FillDimension<Policy>(wave, queue, Dimension::kLobe, p.u_lobe, nullptr);
  if (p.u_light_0 != nullptr) {
    FillDimension<Policy>(wave, queue, Dimension::kLight, p.u_light_0, p.u_light_1);
  }
  if (p.u_select != nullptr) {
    FillDimension<Policy>(wave, queue, Dimension::kSelect, p.u_select, nullptr);
  }
  if (p.u_roulette != nullptr) {
    FillDimension<Policy>(wave, queue, Dimension::kRoulette, p.u_roulette, nullptr);
  }
  CountBatches(wave, queue);
}

}  // namespace HWY_NAMESPACE
}  // namespace lanelight
HWY_AFTER_NAMESPACE();

#endif
