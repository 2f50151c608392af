#include "src/scene/prepare/prepared_scene.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "src/base/core/alias_table.h"
#include "src/base/core/pi.h"
#include "src/scene/compile/compile.h"
#include "src/scene/compile/environment.h"
#include "src/scene/compiled/lights.h"
#include "src/scene/compiled/scene.h"
#include "src/scene/description/description.h"
#include "src/scene/prepare/light_bounds.h"
#include "src/scene/prepare/light_emission.h"

namespace lanelight {

namespace {

// Relative probabilities; zero for lights that the strategy leaves to scattered rays.
std::vector<double> SelectionWeights(const Strategy& strategy,
                                     const CompiledScene& scene) {
  const LightTable& table = scene.lights;
  std::vector<double> weights(table.lights.size(), 0.0);
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const LightRecord& light = table.lights[i];
    const bool hittable = !IsUnseen(scene, light) &&
                          !HasTrait(static_cast<LightShape>(light.shape), kDeltaLight);
    if (hittable && !strategy.SamplesHittableLights()) continue;
    weights[i] =
        strategy.light_selection == LightSelection::kUniform ? 1.0 : table.power[i];
  }
  return weights;
}

bool ScattersEvenly(const MediumTable& table) {
  return std::ranges::any_of(
      table.media, [](const MediumRecord& m) { return m.grid < 0 && m.scatters != 0; });
}

LightAnchor AnchorOf(const Geometry& geometry, const LightRecord& light) {
  constexpr float kNowhere = std::numeric_limits<float>::infinity();
  if (!HasPlace(light)) return {{kNowhere, kNowhere, kNowhere}, 0};
  const Vec3d p = BoundsOf(geometry, light).Center();
  return {{static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)}, 0};
}

void SetAnchors(const CompiledScene& scene, LightChances& chances) {
  AliasTable table = BuildAliasTable(scene.lights.power);
  for (std::size_t i = 0; i < table.size(); ++i) {
    chances.anchors.push_back(AnchorOf(scene.geometry, scene.lights.lights[i]));
    chances.anchors.back().keep = table.q[i];
  }
  chances.anchor_alias = std::move(table.alias);
}

// Returns the share of texels with equal solid angles.
double FractionOf(const Environment& environment) {
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
double FractionOf(const CompiledScene& scene, const LightRecord& light) {
  const bool is_ball = static_cast<LightShape>(light.shape) == LightShape::kSphere;
  const Vec3d middle = BoundsOf(scene.geometry, light).Center();
  const double square = std::max(1.0, Dot(middle, middle));
  return std::min(1.0, light.area / (is_ball ? 4 : 2) / (4 * kPi * square));
}

// Returns 0 for lights without extent, which all strategies sample.
double Share(const CompiledScene& scene, const LightRecord& light) {
  const auto shape = static_cast<LightShape>(light.shape);
  if (HasTrait(shape, kDeltaLight)) return 0;
  if (HasTrait(shape, kEmittingShape)) return FractionOf(scene, light);
  if (light.environment < 0) return 1;
  return FractionOf(
      scene.lights.environments[static_cast<std::size_t>(light.environment)]);
}

}  // namespace

bool HasAnchors(const Strategy& strategy, const CompiledScene& scene) {
  const auto& lights = scene.lights.lights;
  return strategy.distances == Distances::kEquiangular && ScattersEvenly(scene.media) &&
         std::ranges::any_of(lights, HasPlace);
}

bool CompensatesEnvironment(const Strategy& strategy) {
  return strategy.environment == EnvironmentPoints::kCompensated &&
         strategy.directions == Directions::kMis;
}

LightChances MakeLightChances(const CompiledScene& scene, const Strategy& strategy) {
  LightChances chances;
  for (const Environment& environment : scene.lights.environments) {
    chances.environments.push_back(CompensatesEnvironment(strategy)
                                       ? MakeEnvironmentTable(true, environment)
                                       : environment.table);
  }
  if (HasAnchors(strategy, scene)) SetAnchors(scene, chances);
  const bool asked = strategy.light_paths != LightPaths::kNone;
  if (asked || strategy.decide == Decide::kPilot) {
    chances.emission = MakeLightEmission(scene);
    // A trial run does not change what the image converges to.
    chances.emission.delta_caustics = asked;
  }
  const std::vector<double> weights = SelectionWeights(strategy, scene);
  chances.pmf.resize(weights.size());
  if (std::ranges::none_of(weights, [](double w) { return w > 0; })) {
    return chances;
  }
  if (strategy.light_selection == LightSelection::kTree && weights.size() > 1) {
    chances.tree = BuildLightTree(scene.geometry, scene.lights.lights, weights);
    for (const std::uint32_t far : chances.tree.far) {
      chances.pmf[far] = chances.tree.pmf_far;
    }
  } else {
    AliasTable table = BuildAliasTable(weights);
    chances.pmf = std::move(table.probability);
    chances.alias_q = std::move(table.q);
    chances.alias = std::move(table.alias);
  }
  return chances;
}

PreparedScene WithStrategy(PreparedScene scene, const Strategy& strategy) {
  scene.strategy = strategy;
  scene.chances =
      std::make_shared<const LightChances>(MakeLightChances(*scene.compiled, strategy));
  return scene;
}

SceneParts PreparedScene::Parts() const {
  return PartsOf(*compiled, *view, chances.get());
}
const FeatureSet& PreparedScene::features() const { return compiled->features; }
double PreparedScene::scale() const { return compiled->scale; }
Transport PreparedScene::transport() const {
  return compiled->integrator.transport.value_or(Transport::kRgb);
}
const std::vector<Note>& PreparedScene::notes() const { return compiled->notes; }

PreparedScene PrepareScene(const SceneDescription& description) {
  return PrepareScene(description, {});
}

PreparedScene PrepareScene(const SceneDescription& description,
                           const CompileOptions& options) {
  PreparedScene scene;
  scene.compiled =
      std::make_shared<const CompiledScene>(CompileScene(description, options));
  scene.view = {scene.compiled, &scene.compiled->view};
  return WithStrategy(std::move(scene), description.strategy);
}

double ChanceOfLight(const PreparedScene& scene) {
  const Directions directions = scene.strategy.directions;
  if (directions != Directions::kBsdf && directions != Directions::kUniform) return 1;
  const CompiledScene& compiled = *scene.compiled;
  double power = 0, squares = 0;
  for (std::size_t i = 0; i < compiled.lights.lights.size(); ++i) {
    const double fraction = Share(compiled, compiled.lights.lights[i]);
    const double p = fraction > 0 ? compiled.lights.power[i] : 0;
    power += p;
    if (p > 0) squares += p * p / fraction;
  }
  return squares > 0 ? std::min(1.0, power * power / squares) : 1;
}

}  // namespace lanelight
