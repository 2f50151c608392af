// Unoccluded shadow rays: adds their radiance. Finished paths: checks the sample, writes
// it to the task's buffer, frees the slot. A sample that is not finite, or negative
// though neither the filter nor the film's view of wavelengths is, is counted by kind and
// written as zero: nothing bad reaches the film, and nothing is hidden.
#include "kernels/simd/each_target-inl.h"

#include "kernels/accumulate/check-inl.h"
#include "kernels/queue/batch-inl.h"
#include "kernels/simd/vec3-inl.h"
#include "kernels/texture/wavelengths-inl.h"
#include "src/scene/compiled/spectra.h"

LANELIGHT_BEGIN_KERNELS

// The planes of one group in the task's buffer.
struct PlaneWriter {
  float* plane;
  std::size_t stride;

  HWY_INLINE PlaneWriter(const Wave& wave, PlaneGroup group)
      : plane(wave.buffer.samples +
              std::size_t(wave.run->planes.First(group)) * wave.buffer.stride),
        stride(wave.buffer.stride) {}

  HWY_INLINE void Store(VF value, VI output) {
    Scatter(value, plane, output);
    plane += stride;
  }
  HWY_INLINE void Store(V3 v, VI output) {
    Store(v.x, output);
    Store(v.y, output);
    Store(v.z, output);
  }
  HWY_INLINE void StoreColumns(std::initializer_list<const float*> columns,
                               const Slots& slots, VI output) {
    for (const float* column : columns) Store(Gather(column, slots), output);
  }
};

// Stores the numbers of a path that control=regression fits to.
HWY_INLINE void StoreNumbers(const Wave& wave, const Slots& slots, VI output) {
  const PathColumns& p = wave.path;
  PlaneWriter numbers(wave, PlaneGroup::kNumbers);
  for (const uint32_t* column : {p.first_film, p.first_bsdf, p.first_light, p.choices}) {
    numbers.Store(hn::BitCast(DF(), Gather(column, slots)), output);
  }
}

HWY_INLINE void StoreGbuffer(const Wave& wave, const Slots& slots, VI output) {
  const PathColumns& p = wave.path;
  PlaneWriter(wave, PlaneGroup::kGbuffer)
      .StoreColumns(
          {p.gb_hit, p.gb_p_x, p.gb_p_y, p.gb_p_z, p.gb_ng_x, p.gb_ng_y, p.gb_ng_z,
           p.gb_ns_x, p.gb_ns_y, p.gb_ns_z, p.gb_uv_0, p.gb_uv_1, p.gb_dz_0, p.gb_dz_1},
          slots, output);
}

// Stores the radiance of a sample for films that keep spectra; exposure does not apply.
HWY_INLINE void StoreRadiance(const Wave& wave, const Slots& slots, MF bad, VI output) {
  const PathColumns& p = wave.path;
  V3 radiance = Gather3(p.l_r, p.l_g, p.l_b, slots);
  if (p.weight != nullptr) radiance = Mul(radiance, Gather(p.weight, slots));
  PlaneWriter(wave, PlaneGroup::kRadiance)
      .Store(IfThenElse(bad, Splat3(0, 0, 0), radiance), output);
  PlaneWriter(wave, PlaneGroup::kTriple)
      .Store(hn::ConvertTo(DF(), Wavelengths(p, slots).triple), output);
}

HWY_INLINE void StoreWeight(const Wave& wave, const Slots& slots, VI output) {
  const float* weight = wave.path.weight;
  PlaneWriter(wave, PlaneGroup::kWeight)
      .Store(weight != nullptr ? Gather(weight, slots) : Splat(1.0f), output);
}

HWY_INLINE MF InBuffer(const Wave& wave, VI output) {
  const DI di;
  const auto below =
      hn::Lt(output, hn::Set(di, static_cast<int32_t>(wave.buffer.stride)));
  return hn::RebindMask(DF(), hn::AndNot(hn::Lt(output, hn::Zero(di)), below));
}

template <bool kSigned, bool kAov>
void Accumulate(Wave& wave) {
  const PathColumns& p = wave.path;
  // With reuse=block, a sample is an amount of light until its block has been connected.
  const bool is_light = wave.run->planes.Has(PlaneGroup::kWeight);
  const bool keeps_spectra = wave.run->planes.Has(PlaneGroup::kRadiance);
  const VF exposure = Splat(is_light ? 1.0f : wave.run->exposure);
  ForEachBatch(wave, wave.queue(QueueId::kDone),
               [&](const Slots& slots, MF valid) HWY_ATTR {
                 const VI output = Gather(p.output, slots);
                 LL_DCHECK(AllUnder(valid, InBuffer(wave, output)));
                 V3 sample = Mul(Gather3(p.l_r, p.l_g, p.l_b, slots), exposure);
                 if (kSigned && p.wavelength != nullptr && !is_light) {
                   sample = FilmColor(*wave.spectra, sample, {p, slots});
                 }
                 if (p.weight != nullptr && !is_light) {
                   sample = Mul(sample, Gather(p.weight, slots));
                 }
                 const Checked checked = Check<kSigned>(wave.health, sample, valid);
                 PlaneWriter(wave, PlaneGroup::kColor).Store(checked.value, output);
                 if constexpr (kAov) {
                   PlaneWriter(wave, PlaneGroup::kAov)
                       .StoreColumns({p.aov_albedo_r, p.aov_albedo_g, p.aov_albedo_b,
                                      p.aov_n_x, p.aov_n_y, p.aov_n_z, p.aov_depth},
                                     slots, output);
                   if (p.gb_hit != nullptr) StoreGbuffer(wave, slots, output);
                 }
                 if constexpr (kSigned) {
                   if (p.first_bsdf != nullptr) StoreNumbers(wave, slots, output);
                   if (keeps_spectra) StoreRadiance(wave, slots, checked.bad, output);
                 }
                 if (is_light) StoreWeight(wave, slots, output);
                 Push(wave.queue(QueueId::kFree), slots, valid);
               });
}

StageFn ResolveAccumulate(const FeatureSet& features) {
  if (features.HasAny(
          {Feature::kSignedFilter, Feature::kRegressionControl, Feature::kSpectral})) {
    return features.Has(Feature::kAov) ? Accumulate<true, true> : Accumulate<true, false>;
  }
  return features.Has(Feature::kAov) ? Accumulate<false, true> : Accumulate<false, false>;
}

Stage AccumulateStage() {
  return {.name = "accumulate",
          .meaning = "checks finished samples and frees their slots",
          .input = QueueId::kDone,
          .role = StageRole::kAccumulate,
          .reads = fields::kRadiance | fields::kAov | fields::kGbuffer |
                   fields::kFirstNumbers |
                   FieldSet{Field::output, Field::weight, Field::wavelength},
          .resolve = ResolveAccumulate};
}

// A path has at most one shadow ray per bounce.
void Connect(Wave& wave) {
  const PathColumns& p = wave.path;
  ForEachBatch(
      wave, wave.queue(QueueId::kShadow), [&](const StoreSlots& slots, MF) HWY_ATTR {
        const V3 sum =
            Gather3(p.l_r, p.l_g, p.l_b, slots) + Gather3(p.sh_r, p.sh_g, p.sh_b, slots);
        Scatter3(sum, p.l_r, p.l_g, p.l_b, slots);
      });
}

Stage ConnectStage() {
  return {.name = "connect",
          .meaning = "adds the light of unoccluded shadow rays",
          .input = QueueId::kShadow,
          .role = StageRole::kAccumulate,
          .needs = {Feature::kLights, Feature::kScatters},
          .reads = fields::kRadiance | fields::kShadow,
          .writes = fields::kRadiance,
          .resolve = Always<Connect>};
}

LANELIGHT_END_KERNELS
