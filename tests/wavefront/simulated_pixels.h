// Films of simulated samples whose true values are known, shared out as by a render with
// allocation=error.
#pragma once

#include <functional>
#include <random>
#include <vector>

#include "src/wavefront/allocation.h"

namespace lanelight::test {

/// A sample of the pixel (x, y).
using DrawSample = std::function<float(int x, int y, std::mt19937_64& random)>;

inline constexpr SampleGroups kReplicated = {1, true};

/// Adds `count` grey samples of one pixel.
inline void AddDrawn(FilmAccumulator& film, int x, int y, std::uint64_t count,
                     const DrawSample& draw, std::mt19937_64& random) {
  std::vector<float> values(count);
  for (float& v : values) v = draw(x, y, random);
  const float* const planes[] = {values.data(), values.data(), values.data()};
  film.AddSamples(x, y, planes, static_cast<std::uint32_t>(count));
}

template <class Do>
void ForPixels(const FilmAccumulator& film, Do&& body) {
  for (int y = film.y0(); y < film.y0() + film.height(); ++y) {
    for (int x = film.x0(); x < film.x0() + film.width(); ++x) body(x, y);
  }
}

/// After the pilot.
inline FilmAccumulator Pilot(int width, int height, const DrawSample& draw,
                             std::mt19937_64& random) {
  FilmAccumulator film(0, 0, width, height, kReplicated, Auxiliary::kNone);
  ForPixels(film,
            [&](int x, int y) { AddDrawn(film, x, y, kAllocationPilot, draw, random); });
  return film;
}

/// Weights by pixel, of a film after its pilot.
using Weigh = std::function<std::vector<double>(const FilmAccumulator& film)>;

/// A whole image of `mean` samples per pixel.
inline FilmAccumulator Simulate(int width, int height, std::uint64_t mean,
                                const DrawSample& draw, const Weigh& weigh,
                                std::mt19937_64& random) {
  FilmAccumulator film = Pilot(width, height, draw, random);
  const std::vector<double> weights = weigh(film);
  ForPixels(film, [&](int x, int y) {
    Share share;
    share.weight = weights[static_cast<std::size_t>(y * width + x)];
    share.turn = kReplicates;
    AddDrawn(film, x, y, share.Samples(mean) - kAllocationPilot, draw, random);
  });
  return film;
}

}  // namespace lanelight::test
