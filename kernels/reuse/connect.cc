// reuse=block: visibility of pairs, and the light of each pixel of the block
// (kernels/reuse/pairs.cc has the estimator).
#include "kernels/simd/each_target-inl.h"

#include "kernels/accumulate/check-inl.h"
#include "kernels/samplers/wavelength-inl.h"
#include "kernels/reuse/block-inl.h"
#include "kernels/texture/wavelengths-inl.h"

LANELIGHT_BEGIN_KERNELS

void TracePairs(Wave& wave) {
  const Queue& rays = wave.queue(QueueId::kShadow);
  wave.rays_shadow += rays.size;
  for (uint32_t i = 0; i < wave.kernels.num_shadow && rays.size > 0; ++i) {
    wave.kernels.shadow[i](wave);
  }
  float* const visible = wave.block->pairs.visible;
  for (uint32_t i = 0; i < rays.size; ++i) visible[rays.items[i]] = 1;
}

// Sums a row of pairs, whose rays may be those of another row.
HWY_INLINE VF SumOfDensities(const float* pdf_area, const float* visible, uint32_t n) {
  const DF df;
  VF sum = hn::Zero(df);
  for (uint32_t r = 0; r < n; r += static_cast<uint32_t>(hn::Lanes(df))) {
    sum = hn::MulAdd(hn::LoadU(df, visible + r), hn::LoadU(df, pdf_area + r), sum);
  }
  return hn::SumOfLanes(df, sum);
}

// Returns the light that the second vertex sends to all receivers alike; 1 if its pairs
// contain the light.
HWY_INLINE V3 EvenColor(const Wave& wave, const SuffixRow& row) {
  if (row.part != SuffixPart::kEven) return Splat3(1, 1, 1);
  const float* color = ColorOf(wave, row.record);
  const std::size_t stride = wave.buffer.stride;
  return Splat3(color[0], color[stride], color[2 * stride]);
}

// Adds the light of a second vertex to each receiver.
HWY_INLINE void AddRow(const Wave& wave, uint32_t s) {
  const DF df;
  const Block& block = *wave.block;
  const PairColumns& pairs = block.pairs;
  const SuffixRow& row = block.rows[s];
  const uint32_t begin = s * block.num_receivers;
  const float* visible = pairs.visible + row.rays * block.num_receivers;
  const VF sum = SumOfDensities(pairs.pdf_area + begin, visible, block.num_receivers);
  if (hn::GetLane(sum) <= 0) return;
  const V3 color = Mul(EvenColor(wave, row), hn::Div(Splat(row.weight), sum));
  const VF l[3] = {color.x, color.y, color.z};
  const float* f[3] = {pairs.f_r + begin, pairs.f_g + begin, pairs.f_b + begin};
  for (uint32_t r = 0; r < block.num_receivers;
       r += static_cast<uint32_t>(hn::Lanes(df))) {
    const VF seen = hn::LoadU(df, visible + r);
    for (int c = 0; c < 3; ++c) {
      float* to = block.sums[c] + r;
      const VF carried = hn::Mul(hn::Mul(seen, l[c]), hn::LoadU(df, f[c] + r));
      hn::StoreU(hn::Add(hn::LoadU(df, to), carried), df, to);
    }
  }
}

// Restores the light that a sample had before its second vertex, since all light gathered
// after that is shared. (Samples with glossy second vertices have their own light
// already.)
HWY_INLINE void RestoreLight(const Wave& wave) {
  const Block& block = *wave.block;
  const ReuseColumns& second = block.second;
  for (uint32_t i = 0; i < block.size; ++i) {
    const uint32_t r = block.records[i];
    if (second.state[r] != static_cast<uint32_t>(ReuseState::kSecond)) continue;
    float* color = ColorOf(wave, r);
    color[0] = second.before_r[r];
    color[wave.buffer.stride] = second.before_g[r];
    color[2 * wave.buffer.stride] = second.before_b[r];
  }
}

// Converts the complete light of the block to samples.
template <bool kSigned>
HWY_INLINE void FinishSamples(Wave& wave) {
  const DI di;
  const bool spectral = kSigned && wave.run->sampler.by_tile;
  const VU sample = SplatU(wave.work.first_sample + wave.block->sample);
  const Wavelengths wavelengths(
      TileWavelength(*wave.run, SplatU(wave.work.pixels[0]), sample));
  const Block& block = *wave.block;
  const uint32_t lanes = static_cast<uint32_t>(hn::Lanes(di));
  const std::size_t stride = wave.buffer.stride;
  float* const red = wave.buffer.samples + block.sample;
  const float* weights =
      red + std::size_t(wave.run->planes.First(PlaneGroup::kWeight)) * stride;
  const VI first = hn::Set(di, static_cast<int32_t>(block.sample * wave.work.num_pixels));
  const VI samples = hn::Set(di, static_cast<int32_t>(wave.work.samples));
  const VF exposure = Splat(wave.run->exposure);
  for (uint32_t i = 0; i < block.size; i += lanes) {
    const MF valid = hn::FirstN(DF(), block.size - i);
    // Lanes past the end repeat the first.
    const VI loaded = hn::BitCast(di, hn::LoadU(DU(), block.records + i));
    const VI records =
        hn::IfThenElse(hn::RebindMask(di, valid), loaded,
                       hn::Set(di, static_cast<int32_t>(block.records[i])));
    const VI at = hn::Mul(hn::Sub(records, first), samples);
    V3 light = Gather3(red, red + stride, red + 2 * stride, at);
    if (spectral) light = FilmColor(*wave.spectra, light, wavelengths);
    const V3 color = Mul(light, hn::Mul(Gather(weights, at), exposure));
    const V3 value = Check<kSigned>(wave.health, color, valid).value;
    Scatter3(value, red, red + stride, red + 2 * stride, at);
  }
}

template <bool kSigned>
HWY_INLINE void ConnectBlock(Wave& wave) {
  const Block& block = *wave.block;
  for (float* sums : block.sums) {
    for (uint32_t r = 0; r < block.num_receivers; ++r) sums[r] = 0;
  }
  for (uint32_t s = 0; s < block.num_rows; ++s) AddRow(wave, s);
  RestoreLight(wave);
  // Padding repeats the last of its kind: each counts once.
  for (uint32_t r = 0; r < block.num_receivers; ++r) {
    if (r > 0 && block.receivers[r] == block.receivers[r - 1]) continue;
    float* color = ColorOf(wave, block.receivers[r]);
    for (int c = 0; c < 3; ++c) color[c * wave.buffer.stride] += block.sums[c][r];
  }
  FinishSamples<kSigned>(wave);
}

Stage ReuseShadowStage() {
  return {.name = "reuse_shadow",
          .meaning = "traces shadow rays between pairs of a block",
          .input = QueueId::kShadow,
          .role = StageRole::kBlock,
          .needs = {Feature::kReuse, Feature::kScatters},
          .scope = StageScope::kBlock,
          .resolve = Always<TracePairs>};
}

Stage ReuseConnectStage() {
  return {.name = "reuse_connect",
          .meaning = "distributes the light of second vertices to the block",
          .input = QueueId::kScratch,
          .role = StageRole::kBlock,
          .needs = {Feature::kReuse, Feature::kScatters},
          .scope = StageScope::kBlock,
          .resolve = [](const FeatureSet& features) -> StageFn {
            // The film's view of wavelengths may be below 0.
            return features.HasAny({Feature::kSignedFilter, Feature::kSpectral})
                       ? ConnectBlock<true>
                       : ConnectBlock<false>;
          }};
}

LANELIGHT_END_KERNELS
