#include "src/scene/prepare/chance_of_light.h"

#include <algorithm>
#include <cmath>

#include "src/base/core/pi.h"
#include "src/scene/prepare/light_bounds.h"
#include "src/scene/prepare/prepared_scene.h"

namespace lanelight {
namespace {

// Returns the share of texels with equal solid angles.
double ShareOf(const Environment& environment) {
  double sum = 0, squares = 0;
  for (std::size_t i = 0; i + 2 < environment.rgb.size(); i += 3) {
    double light = 0;
    for (std::size_t c = 0; c < 3; ++c) light += double(environment.rgb[i + c]);
    sum += light;
    squares += light * light;
  }
  return squares > 0 ? sum * sum / (squares * double(environment.rgb.size() / 3)) : 1;
}

// Flat shapes are seen at half their area on average, balls at a quarter. The scene's
// half diagonal is between 1 and 2: nothing in it is seen from much nearer.
double ShareOf(const CompiledScene& scene, const LightRecord& light) {
  const bool is_ball = static_cast<LightShape>(light.shape) == LightShape::kSphere;
  const Vec3d middle = BoundsOf(scene.geometry, light).Center();
  const double square = std::max(1.0, Dot(middle, middle));
  return std::min(1.0, light.area / (is_ball ? 4 : 2) / (4 * kPi * square));
}

// 0 where nothing can meet it: such lights are sampled by all strategies.
double Share(const CompiledScene& scene, const LightRecord& light) {
  const auto shape = static_cast<LightShape>(light.shape);
  if (HasTrait(shape, kDeltaLight)) return 0;
  if (HasTrait(shape, kEmittingShape)) return ShareOf(scene, light);
  if (light.environment < 0) return 1;
  return ShareOf(scene.lights.environments[static_cast<std::size_t>(light.environment)]);
}

}  // namespace

double ChanceOfLight(const PreparedScene& scene) {
  const Directions directions = scene.strategy.directions;
  if (directions != Directions::kBsdf && directions != Directions::kUniform) return 1;
  const CompiledScene& compiled = *scene.compiled;
  double power = 0, squares = 0;
  for (std::size_t i = 0; i < compiled.lights.lights.size(); ++i) {
    const double share = Share(compiled, compiled.lights.lights[i]);
    const double p = share > 0 ? compiled.lights.power[i] : 0;
    power += p;
    if (p > 0) squares += p * p / share;
  }
  return squares > 0 ? std::min(1.0, power * power / squares) : 1;
}

}  // namespace lanelight
