// The dimensions of a path's random numbers, by name. A number is a pure function of
// (seed, pixel, sample, key), and a key of dimension, depth and branch.
#pragma once

#include <cstdint>

namespace lanelight {

// Each name is one point of up to four coordinates. Append only: the order is part of
// the golden vectors.
enum class Dimension : std::uint32_t {
  kFilm,      // 2: position in the pixel
  kLens,      // 2: position on the lens
  kBsdf,      // 2: direction
  kLobe,      // 1: choice of lobe
  kRoulette,  // 1: survival
  kLight,     // 2: point on the light
  kSelect,    // 1: choice of light
  kMix,       // 1: choice between mixed materials
  kCoat,      // many: random walk inside a coat (hash counter)
  kCount
};

}  // namespace lanelight
