// Loops over pixels, row by row from the top.
#pragma once

#include "src/base/image/pixel_rect.h"
#include "src/render/films/accumulator.h"

namespace lanelight {

/// Calls visit(x, y) for every pixel.
template <class Visit>
void ForEachPixel(const PixelRect& rect, const Visit& visit) {
  for (int y = rect.y0; y < rect.y1; ++y) {
    for (int x = rect.x0; x < rect.x1; ++x) visit(x, y);
  }
}

inline PixelRect WindowOf(const FilmAccumulator& film) {
  return {film.x0(), film.y0(), film.x0() + film.width(), film.y0() + film.height()};
}
template <class Visit>
void ForEachPixel(const FilmAccumulator& film, const Visit& visit) {
  ForEachPixel(WindowOf(film), visit);
}

/// Pixels of the film that have a sample.
inline std::uint64_t SampledPixels(const FilmAccumulator& film) {
  std::uint64_t count = 0;
  ForEachPixel(film, [&](int x, int y) { count += film.Samples(x, y) > 0; });
  return count;
}

}  // namespace lanelight
