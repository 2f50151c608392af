// What messages about batches of tiles consist of: values one after the other, and the
// rows of the tiles (src/wavefront/tile_columns.h).
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>

#include "src/core/check.h"
#include "src/image/pixel_rect.h"
#include "src/wavefront/crew.h"
#include "src/wavefront/films.h"

namespace lanelight {

template <class Value>
void Write(const Value& value, std::string& bytes) {
  static_assert(std::is_trivially_copyable_v<Value>);
  bytes.append(reinterpret_cast<const char*>(&value), sizeof(Value));
}

/// Takes the value off the front.
template <class Value>
Value Read(std::string_view& bytes) {
  LL_CHECK_GE(bytes.size(), sizeof(Value));
  Value value;
  std::memcpy(&value, bytes.data(), sizeof(Value));
  bytes.remove_prefix(sizeof(Value));
  return value;
}

/// Before a batch: so many TileRanges follow, then the rows of those that have samples.
struct WorkHead {
  RoundWork round;
  std::uint64_t ranges = 0;
};

/// Before the answer: of each range the samples per pixel (64 bits), and its rows.
struct DoneHead {
  RunCounts counts;
  std::uint64_t ranges = 0;
  double seconds = 0;  // of all threads together
  bool interrupted = false;
};

/// The pixels of films.
inline PixelRect WindowOf(const Films& films) {
  const FilmAccumulator& film = films.film();
  return {film.x0(), film.y0(), film.x0() + film.width(), film.y0() + film.height()};
}

}  // namespace lanelight
