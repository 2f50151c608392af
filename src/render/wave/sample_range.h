// The unit of work of a render.
#pragma once

#include <cstddef>
#include <cstdint>

namespace lanelight {

/// Samples [first, end()) of every pixel of one tile.
struct SampleRange {
  std::size_t tile = 0;     // index into the tiles of the run
  std::uint64_t first = 0;  // sample of a pixel, counted over the whole render
  std::uint32_t count = 0;  // samples per pixel

  std::uint64_t end() const { return first + count; }
};

}  // namespace lanelight
