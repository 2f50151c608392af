// What samples of a task have gathered, by record (src/vocabulary/path/block.h).
#pragma once

#include <algorithm>

#include "src/vocabulary/path/block.h"
#include "src/vocabulary/path/wave.h"

namespace lanelight {

/// The colour planes of the sample of a record, `wave.buffer.stride` apart.
inline float* ColorOf(const Wave& wave, std::uint32_t record) {
  const std::uint32_t place = record - wave.block->sample * wave.work.num_pixels;
  return wave.buffer.samples + place * wave.work.samples + wave.block->sample;
}

/// The brightest channel of what a second vertex has for others, as its own path gets it;
/// 0 if nothing.
inline float MostSent(const Wave& wave, std::uint32_t record) {
  const Block& block = *wave.block;
  const std::uint32_t state = block.second.state[record];
  if (!Serves(state)) return 0;
  if (ServesGlossily(state)) return block.glossy.sent[record];
  const float* color = ColorOf(wave, record);
  const std::size_t stride = wave.buffer.stride;
  return std::max({color[0], color[stride], color[2 * stride]});
}

}  // namespace lanelight
