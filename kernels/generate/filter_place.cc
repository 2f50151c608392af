// pixel-samples=shared: keeps where in the pixel filter the samples of a tile lie, for
// their weights (src/render/wave/shared_samples.h).
#include "kernels/simd/each_target-inl.h"

#include "kernels/generate/camera-inl.h"

LANELIGHT_BEGIN_KERNELS

template <bool kBox>
void StoreFilterPlace(Wave& wave) {
  const CompiledFilter& filter = *wave.filter;
  const PathColumns& p = wave.path;
  const auto place_of = [](const AlignedVector<float>& cdf, VF u) HWY_ATTR {
    if constexpr (kBox) {
      return hn::Mul(u, Splat(static_cast<float>(CompiledFilter::kSize)));
    } else {
      return SampleFilterAxis(cdf.data(), u).at;
    }
  };
  float* const x = wave.work.filter_places;
  float* const y = x + wave.work.samples;
  const VI first = hn::Set(DI(), static_cast<int32_t>(wave.work.first_sample));
  // Samples of all pixels have the same places: those of one are enough.
  const VI pixel = hn::Set(DI(), static_cast<int32_t>(wave.work.pixels[0]));
  ForEachBatch(wave, wave.queue(QueueId::kCamera), [&](const Slots& slots, MF) HWY_ATTR {
    if (hn::AllFalse(DI(), hn::Eq(Gather(p.pixel, slots), pixel))) return;
    const VI sample = hn::Sub(Gather(p.sample, slots), first);
    Scatter(place_of(filter.x_cdf, Gather(p.u_film_0, slots)), x, sample);
    Scatter(place_of(filter.y_cdf, Gather(p.u_film_1, slots)), y, sample);
  });
}

Stage FilterPlaceStage() {
  return {
      .name = "filter_place",
      .meaning = "keeps where samples lie in the pixel filter",
      .input = QueueId::kCamera,
      .role = StageRole::kSampling,
      .needs = {Feature::kSharedPixelSamples},
      .reads = {Field::pixel, Field::sample, Field::u_film_0, Field::u_film_1},
      .resolve =
          ByFeature<Feature::kFiltered, StoreFilterPlace<false>, StoreFilterPlace<true>>};
}

LANELIGHT_END_KERNELS
