// Fills the sample-point columns of a queue from a sampler policy.
//
// A policy is a struct with
//   static GroupIndex Group(const PointsParameters&, VU sample)   (group-inl.h)
//   static void Point(const PointsParameters&, VU pixel, GroupIndex, VU key, VU seed,
//                     VF* u0, VF* u1)
// giving a point in [0,1)^2 for a dimension key (src/wavefront/dimensions.h). The two
// coordinates of one key are stratified against each other where the policy stratifies;
// different keys are independent of each other. A scalar dimension takes u0; a policy
// whose u0 alone is less well stratified than one dimension can be has also
//   static VF Number(const PointsParameters&, VU pixel, GroupIndex, VU key, VU seed)
#if defined(LANELIGHT_POINTS_FILL_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef LANELIGHT_POINTS_FILL_INL_H_
#undef LANELIGHT_POINTS_FILL_INL_H_
#else
#define LANELIGHT_POINTS_FILL_INL_H_
#endif

#include "kernels/points/group-inl.h"
#include "src/wavefront/dimensions.h"

HWY_BEFORE_NAMESPACE();
namespace lanelight {
namespace HWY_NAMESPACE {

/// Sample index that the numbers of a dimension come from: the two samples of an
/// antithetic pair share it in the dimensions that the strategy pairs.
HWY_INLINE VU PointSample(const PairParameters& pairs, Dimension dimension, VU sample,
                          VU depth) {
  if (!pairs.Has(dimension)) return sample;
  const VU shared = hn::ShiftRight<1>(sample);
  if (pairs.depths == 0xffffffffu) return shared;
  const DI di;
  const auto paired =
      hn::Lt(hn::BitCast(di, depth), hn::Set(di, static_cast<int32_t>(pairs.depths)));
  return hn::IfThenElse(hn::RebindMask(DU(), paired), shared, sample);
}

/// Copies of a path that has split (`branch` > 0) draw from dimensions of their own.
HWY_INLINE VU KeyOf(const PathColumns& p, Dimension dimension, VU depth, VI slots) {
  const VU key = hn::Add(hn::Mul(depth, SplatU(static_cast<uint32_t>(Dimension::kCount))),
                         SplatU(static_cast<uint32_t>(dimension)));
  if (p.branch == nullptr) return key;
  return hn::Xor(key, hn::ShiftLeft<24>(AsUnsigned(Gather(p.branch, slots))));
}

template <class Policy>
concept HasNumber = requires(const PointsParameters& points, VU v, GroupIndex at) {
  Policy::Number(points, v, at, v, v);
};

/// One dimension of every path in the queue; a scalar one leaves out1 alone.
template <class Policy, bool kScalar = false>
HWY_INLINE void FillDimension(Wave& wave, const Queue& queue, Dimension dimension,
                              float* out0, float* out1) {
  const uint32_t lanes = static_cast<uint32_t>(hn::Lanes(DF()));
  const PathColumns& p = wave.path;
  const RunParameters& run = *wave.run;
  const VU seed = SplatU(run.seed);
  for (uint32_t i = 0; i < queue.size; i += lanes) {
    const VI slots = hn::LoadU(DI(), reinterpret_cast<const int32_t*>(queue.items) + i);
    const VU pixel = AsUnsigned(Gather(p.pixel, slots));
    const VU depth = AsUnsigned(Gather(p.depth, slots));
    const VU sample =
        PointSample(run.pairs, dimension, AsUnsigned(Gather(p.sample, slots)), depth);
    const VU key = KeyOf(p, dimension, depth, slots);
    const GroupIndex at = Policy::Group(run.points, sample);
    VF u0, u1;
    if constexpr (kScalar && HasNumber<Policy>) {
      u0 = Policy::Number(run.points, pixel, at, key, seed);
    } else {
      Policy::Point(run.points, pixel, at, key, seed, &u0, &u1);
    }
    Scatter(u0, out0, slots);
    if constexpr (!kScalar) Scatter(u1, out1, slots);
  }
}

template <class Policy>
HWY_INLINE void FillNumber(Wave& wave, const Queue& queue, Dimension dimension,
                           float* out) {
  FillDimension<Policy, true>(wave, queue, dimension, out, nullptr);
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
  FillNumber<Policy>(wave, queue, Dimension::kLobe, p.u_lobe);
  if (p.u_light_0 != nullptr) {
    FillDimension<Policy>(wave, queue, Dimension::kLight, p.u_light_0, p.u_light_1);
  }
  if (p.u_select != nullptr) {
    FillNumber<Policy>(wave, queue, Dimension::kSelect, p.u_select);
  }
  if (p.u_roulette != nullptr) {
    FillNumber<Policy>(wave, queue, Dimension::kRoulette, p.u_roulette);
  }
  CountBatches(wave, queue);
}

}  // namespace HWY_NAMESPACE
}  // namespace lanelight
HWY_AFTER_NAMESPACE();

#endif
