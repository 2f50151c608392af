// pairs=antithetic: samples 2k and 2k+1 of a pixel share their random numbers; these
// stages reflect those of the second one. The points stages have given both the same
// numbers (PairedSample in kernels/samplers/fill-inl.h).
//   estimator   1/(2N) sum (f(u) + f(u')): u' = 1 - u per coordinate, or u + 1/2 for
//               azimuths. Wavelengths and choices of light candidates are independent
//   unbiased    u' is as uniform as u
//   variance    (1 + rho) sigma^2 / (2N) for N pairs, rho the correlation of f(u) and
//               f(u'). 0 if f is linear in the reflected numbers, less if f is monotonic
//               in them, more if it is symmetric about the middle (at worst twice)
//   dependence  a pair is one observation
//   cost        a few instructions per number; half of the hashes could be spared
//   source      Hammersley and Morton 1956; the paper's equation 6
#include "kernels/simd/each_target-inl.h"

#include "kernels/queue/batch-inl.h"
#include "kernels/simd/vec3-inl.h"

LANELIGHT_BEGIN_KERNELS

// 1 - u on the grid of 24 bits that sample points live on: a permutation of the grid, so
// exactly as uniform, and never 1.
HWY_INLINE VF Reflected(VF u) { return hn::Sub(Splat(1.0f - 0x1p-24f), u); }
// u + 1/2, modulo 1.
HWY_INLINE VF RotatedByHalfTurn(VF u) {
  const VF half = Splat(0.5f);
  return hn::Add(u, hn::IfThenElse(hn::Lt(u, half), half, Splat(-0.5f)));
}

enum class Reflection { kReflect, kRotate };

// Reflects one column for the odd samples of the queue.
template <Reflection kHow>
HWY_INLINE void ReflectColumn(Wave& wave, const Queue& queue, float* column) {
  if (column == nullptr) return;
  const DI di;
  const PathColumns& p = wave.path;
  const VI one = hn::Set(di, 1);
  const uint32_t lanes = static_cast<uint32_t>(hn::Lanes(DF()));
  for (uint32_t i = 0; i < queue.size; i += lanes) {
    const VI slots = hn::LoadU(di, reinterpret_cast<const int32_t*>(queue.items) + i);
    const auto odd = hn::Eq(hn::And(Gather(p.sample, slots), one), one);
    const MF reflect = hn::RebindMask(DF(), odd);
    const VF u = Gather(column, slots);
    const VF other = kHow == Reflection::kRotate ? RotatedByHalfTurn(u) : Reflected(u);
    Scatter(hn::IfThenElse(reflect, other, u), column, slots);
  }
}

HWY_INLINE void ReflectPoint(Wave& wave, const Queue& queue, float* u0, float* u1) {
  ReflectColumn<Reflection::kReflect>(wave, queue, u0);
  ReflectColumn<Reflection::kReflect>(wave, queue, u1);
}

void AntitheticCamera(Wave& wave) {
  const Queue& queue = wave.queue(QueueId::kCamera);
  const PathColumns& p = wave.path;
  PadTail(queue);
  ReflectPoint(wave, queue, p.u_film_0, p.u_film_1);
  // Both coordinates of the concentric map reflected: the opposite point of the lens.
  ReflectPoint(wave, queue, p.u_lens_0, p.u_lens_1);
  ReflectPoint(wave, queue, p.time, nullptr);
  ReflectPoint(wave, queue, p.u_medium_0, p.u_medium_1);
  CountBatches(wave, queue);
}

void AntitheticBounce(Wave& wave) {
  const Queue& queue = wave.queue(QueueId::kVertex);
  const PathColumns& p = wave.path;
  PadTail(queue);
  // u_bsdf_1 is the azimuth of the lobes of visible normals and of uniform directions; in
  // the concentric map of the cosine lobe a half turn of it is a quarter turn or a
  // mirror.
  ReflectColumn<Reflection::kReflect>(wave, queue, p.u_bsdf_0);
  ReflectColumn<Reflection::kRotate>(wave, queue, p.u_bsdf_1);
  ReflectPoint(wave, queue, p.u_lobe, nullptr);
  ReflectPoint(wave, queue, p.u_select, nullptr);
  ReflectPoint(wave, queue, p.u_light_0, p.u_light_1);
  ReflectPoint(wave, queue, p.u_roulette, nullptr);
  ReflectPoint(wave, queue, p.u_medium_0, p.u_medium_1);
  CountBatches(wave, queue);
}

Stage AntitheticCameraStage() {
  const FieldSet points = {Field::u_film_0,  Field::u_film_1, Field::u_lens_0,
                           Field::u_lens_1,  Field::time,     Field::u_medium_0,
                           Field::u_medium_1};
  return {.name = "antithetic_camera",
          .meaning = "reflects film, lens and time points of odd samples",
          .input = QueueId::kCamera,
          .role = StageRole::kSampling,
          .needs = {Feature::kAntitheticPairs},
          .reads = points | FieldSet{Field::sample},
          .writes = points,
          .resolve = Always<AntitheticCamera>};
}
Stage AntitheticBounceStage() {
  return {.name = "antithetic_bounce",
          .meaning = "reflects the points of a bounce of odd samples",
          .input = QueueId::kVertex,
          .role = StageRole::kSampling,
          .needs = {Feature::kAntitheticPairs, Feature::kScatters},
          .reads = fields::kBounceNumbers | FieldSet{Field::sample},
          .writes = fields::kBounceNumbers,
          .resolve = Always<AntitheticBounce>};
}

LANELIGHT_END_KERNELS
