// Repetitions of a render that never happened: a known image, known noise, known bias.
#pragma once

#include <cmath>
#include <functional>
#include <numbers>

#include "src/measure/study/cell_store.h"
#include "src/measure/study/reference.h"
#include "tests/reference/random.h"

namespace lanelight {

inline double Normal(reference::Random& random) {
  return std::sqrt(-2 * std::log(random.Uniform())) *
         std::cos(2 * std::numbers::pi * random.Uniform());
}

/// Pixel i of the truth: from dark to bright, colours unlike each other.
inline std::vector<Rgb> Truth(std::size_t pixels) {
  std::vector<Rgb> image;
  for (std::size_t i = 0; i < pixels; ++i) {
    const double level = 0.05 + 2 * double(i) / double(pixels);
    image.push_back({level, 0.8 * level, 1.2 * level});
  }
  return image;
}

/// Truth times (1 + deviation x normal noise), the same noise in all channels.
inline std::vector<Rgb> Noisy(const std::vector<Rgb>& truth, double deviation,
                              reference::Random& random) {
  std::vector<Rgb> image;
  for (const Rgb& c : truth) image.push_back(c * (1 + deviation * Normal(random)));
  return image;
}

/// A reference with noise of its own, which it knows.
inline Reference NoisyReference(int width, int height, double deviation,
                                reference::Random& random) {
  const std::vector<Rgb> truth = Truth(static_cast<std::size_t>(width) * height);
  Reference r;
  r.width = width;
  r.height = height;
  r.mean = Noisy(truth, deviation, random);
  for (const Rgb& c : truth) r.variance.push_back(c * c * (deviation * deviation));
  return r;
}

/// `change` is done to each image before it is measured.
inline Cells Simulate(const Reference& reference, int repetitions, double deviation,
                      reference::Random& random,
                      const std::function<void(std::vector<Rgb>&)>& change = {}) {
  const std::vector<Rgb> truth = Truth(reference.mean.size());
  Cells cells;
  cells.moments = Moments(truth.size());
  for (int r = 0; r < repetitions; ++r) {
    std::vector<Rgb> image = Noisy(truth, deviation, random);
    if (change) change(image);
    Measurement m;
    m.seed = static_cast<std::uint64_t>(r);
    m.samples = truth.size();
    m.cpu_seconds = m.wall_seconds = 1;
    MeasureErrors(image, reference, m);
    cells.moments.Add(image);
    cells.repetitions.push_back(m);
    if (r == 0) cells.first = image;
  }
  return cells;
}

}  // namespace lanelight
