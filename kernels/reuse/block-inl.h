// Records of a task (src/vocabulary/path/block.h) by lane, and the members of a block:
// first vertices by kind of material, and second vertices that carry light and survive
// roulette.
#ifndef LANELIGHT_REUSE_BLOCK_INL_H_
#define LANELIGHT_REUSE_BLOCK_INL_H_

#include "kernels/queue/batch-inl.h"
#include "kernels/simd/vec3-inl.h"
#include "src/scene/compiled/materials.h"
#include "src/vocabulary/path/sent.h"

LANELIGHT_BEGIN_KERNELS

HWY_INLINE void StoreAt(V3 v, float* x, float* y, float* z, uint32_t at) {
  hn::StoreU(v.x, DF(), x + at);
  hn::StoreU(v.y, DF(), y + at);
  hn::StoreU(v.z, DF(), z + at);
}

HWY_INLINE VI StateLanes(ReuseState state) {
  return hn::Set(DI(), static_cast<int32_t>(state));
}

/// Returns the records of samples from their places in the task's buffer. There the
/// samples of a pixel are neighbours; records of a block are. Exact below 2^21 samples.
HWY_INLINE VI RecordOf(const TileWork& work, VI output) {
  const DI di;
  const VI samples = hn::Set(di, static_cast<int32_t>(work.samples));
  const VF middle = hn::Add(hn::ConvertTo(DF(), output), Splat(0.5f));
  const VF per_pixel = Splat(1.0f / static_cast<float>(work.samples));
  const VI place = hn::ConvertTo(di, hn::Mul(middle, per_pixel));  // towards 0
  const VI sample = hn::Sub(output, hn::Mul(place, samples));
  return hn::Add(hn::Mul(sample, hn::Set(di, static_cast<int32_t>(work.num_pixels))),
                 place);
}

// Receivers of a kind; behind the valid ones there is padding.
struct KindRange {
  uint32_t begin, end, valid;
};

// Appends the members whose first vertex is of this kind, padded by the last of them.
HWY_INLINE uint32_t ListReceivers(Block& block, const MaterialTable& materials,
                                  uint32_t kind) {
  const uint32_t lanes = static_cast<uint32_t>(hn::Lanes(DF()));
  const uint32_t begin = block.num_receivers;
  uint32_t n = begin;
  for (uint32_t i = 0; i < block.size; ++i) {
    const uint32_t r = block.records[i];
    if (block.second.state[r] == static_cast<uint32_t>(ReuseState::kNoVertex)) continue;
    if (static_cast<uint32_t>(materials.kind[block.first->path.material[r]]) != kind) {
      continue;
    }
    block.receivers[n++] = r;
  }
  const uint32_t valid = n - begin;
  for (; n % lanes != 0; ++n) block.receivers[n] = block.receivers[n - 1];
  block.num_receivers = n;
  return valid;
}

// Roulette on second vertices, in proportion to what they send below
// Block::certainly_kept: dim ones cost as many shadow rays as bright ones. Any
// probability above 0 leaves the estimator unbiased, whatever it depends on. One number
// decides for the block (systematic sampling), so that the number of survivors is close
// to its expectation.
struct SuffixRoulette {
  float whole, sum;  // sum of the probabilities below 1 so far, from u on

  explicit SuffixRoulette(float u) : whole(0), sum(u) {}
  bool Survives(float q) {
    if (q >= 1) return true;
    sum += q;
    if (sum - whole < 1) return false;
    whole += 1;
    return true;
  }
};

HWY_INLINE void ListSuffixes(const Wave& wave) {
  Block& block = *wave.block;
  SuffixRoulette roulette(block.u);
  block.num_suffixes = 0;
  for (uint32_t i = 0; i < block.size; ++i) {
    const uint32_t r = block.records[i];
    const float maximum = MaxSent(wave, r);
    if (!(maximum > 0)) continue;
    const float q = HWY_MIN(1.0f, maximum / block.certainly_kept);
    if (!roulette.Survives(q)) continue;
    SuffixRow& row = block.rows[block.num_suffixes];
    row = {r, block.num_suffixes++, 1 / q, SuffixPart::kEven};
  }
  block.num_rows = block.num_suffixes;
}

LANELIGHT_END_KERNELS

#endif
