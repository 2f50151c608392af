#include "src/scene/compile/coat_fit.h"

#include <cstddef>

#include "src/base/core/parallel.h"
#include "src/base/image/upsampling.h"
#include "src/scene/compile/coat_color.h"

namespace lanelight {
namespace {

constexpr std::size_t kNodes = kCoatFitNodes * kCoatFitNodes * kCoatFitNodes;

Rgb ColorOfNode(std::size_t i) {
  constexpr std::size_t n = kCoatFitNodes;
  const auto level = [](std::size_t at) { return at / (n - 1.0); };
  return {level(i % n), level(i / n % n), level(i / n / n)};
}

}  // namespace

std::vector<float> CoatFits::Table(double internal, int bounces) {
  if (bases_.empty()) {
    bases_.resize(kNodes);
    ParallelFor(kNodes,
                [&](std::size_t i) { bases_[i] = ReflectanceOfRgb(ColorOfNode(i)); });
  }
  std::vector<float> table(3 * kNodes);
  ParallelFor(kNodes, [&](std::size_t i) {
    const Rgb rgb = ColorOfNode(i);
    if (rgb.x == rgb.y && rgb.y == rgb.z) return;
    const Rgb change = EffectiveCoatBase(rgb, bases_[i], internal, bounces) - rgb;
    for (int c = 0; c < 3; ++c) table[3 * i + c] = static_cast<float>(change[c]);
  });
  return table;
}

}  // namespace lanelight
