// Radiance gathered by the samples of a task, by record (src/vocabulary/path/block.h).
#pragma once

#include <algorithm>

#include "src/vocabulary/path/block.h"
#include "src/vocabulary/path/wave.h"

namespace lanelight {

/// Returns the colour planes of a record's sample, `wave.buffer.stride` apart.
inline float* ColorOf(const Wave& wave, std::uint32_t record) {
  const std::uint32_t place = record - wave.block->sample * wave.work.num_pixels;
  return wave.buffer.samples + place * wave.work.samples + wave.block->sample;
}

/// Returns the largest channel of the radiance that a second vertex offers to other
/// paths; 0 if it offers none.
inline float MaxSent(const Wave& wave, std::uint32_t record) {
  const Block& block = *wave.block;
  const std::uint32_t state = block.second.state[record];
  if (!IsReusable(state)) return 0;
  if (IsReusableGlossy(state)) return block.glossy.sent[record];
  const float* color = ColorOf(wave, record);
  const std::size_t stride = wave.buffer.stride;
  return std::max({color[0], color[stride], color[2 * stride]});
}

}  // namespace lanelight
