#include "src/wavefront/plan_features.h"

#include "src/core/check.h"
#include "src/core/error.h"
#include "src/path/choice_features.h"
#include "src/prepare/ambient.h"

namespace lanelight {
namespace {

// Rays can meet something. Without (no shape, or none that can be seen) there is nothing
// but the environment.
bool HasSurfaces(const FeatureSet& f) {
  return f.HasAny({Feature::kTriangles, Feature::kSpheres, Feature::kLargeSpheres,
                   Feature::kDisks, Feature::kPlanes});
}

// Only emission seen directly is left: nothing is shaded and no light is sampled.
void RemoveScattering(FeatureSet& f) {
  f.Remove({Feature::kLights, Feature::kManyLights, Feature::kMis, Feature::kRefraction});
  f.Remove({Feature::kTextures, Feature::kUv, Feature::kTangents, Feature::kVertexNormals,
            Feature::kTexturedRoughness, Feature::kMix});
}

// A surface follows directions that are not its own choice.
bool CanGuide(const Strategy& strategy, const FeatureSet& f) {
  FeatureSet kinds;
  for (int k = 0; k < kNumShadeKinds; ++k) {
    const auto kind = static_cast<ShadeKind>(k);
    if (!HasTrait(kind, kSpecularOnly)) kinds.Add(ShadeFeature(kind));
  }
  return strategy.directions != Directions::kUniform && f.HasAny(kinds);
}

bool HasDeltaLights(const FeatureSet& f) {
  return f.HasAny({Feature::kPointLights, Feature::kSpotLights, Feature::kDistantLights});
}

// Lights whose points light-points= chooses, and samples of them.
bool SamplesFlatLights(const FeatureSet& f) {
  return f.Has(Feature::kSampledHittableLights) &&
         f.HasAny({Feature::kTriangleLights, Feature::kRectangleLights});
}

void AddLightSampling(const Strategy& strategy, FeatureSet& f) {
  f.Add(TurnsOn(strategy.directions));
  if (!strategy.SamplesHittableLights()) {
    // Scattered rays count in full, so they carry no density; what is left to sample are
    // the lights that no ray can hit.
    f.Remove(Feature::kMis);
    if (!HasDeltaLights(f)) f.Remove({Feature::kLights, Feature::kManyLights});
  }
  if (f.Has(Feature::kManyLights)) f.Add(TurnsOn(strategy.light_selection));
  if (!f.Has(Feature::kLights)) return;
  if (SamplesFlatLights(f)) f.Add(TurnsOn(strategy.light_points));
  f.Add(TurnsOn(strategy.shadow_roulette));
}

void AddControl(const Strategy& strategy, FeatureSet& f) {
  if (strategy.control == Control::kNone || !f.Has(Feature::kScatters)) return;
  f.Add(TurnsOn(strategy.control));
  if (strategy.control != Control::kRegression && !strategy.coefficient) {
    f.Add(Feature::kControlDifference);
  }
}

[[noreturn]] void Refuse(const std::string& message) {
  throw InputError("strategy: " + message);
}

// Light samples alone must find every direction of at least one environment.
void CheckAmbient(const Strategy& s, const CompiledScene& scene) {
  if (s.directions != Directions::kLight) return;
  for (std::uint32_t index : scene.lights.infinite) {
    const std::int32_t e = scene.lights.lights[index].environment;
    if (e < 0) return;
    if (SamplesEveryDirection(scene.lights.environments[static_cast<std::size_t>(e)]))
      return;
  }
  Refuse(
      "control=ambient with directions=light needs an environment that light samples "
      "find all of; this one has black or very dark directions: use directions=mis");
}

void CheckControl(const Strategy& s, const CompiledScene& scene,
                  const PlanOptions& options) {
  if (s.control == Control::kNone) return;
  const FeatureSet& f = scene.features;
  const std::string name = std::string("control=") + Name(s.control);
  if (options.max_depth == 0) Refuse(name + " needs a maximum depth of at least 1");
  if (s.control == Control::kRegression) return;
  if (!f.HasAny({Feature::kDiffuse, Feature::kDiffuseTransmission})) {
    Refuse(name +
           " works on Lambertian surfaces, and this scene has none; control=regression "
           "works on any");
  }
  if (s.control == Control::kAmbient && !f.Has(Feature::kInfiniteLights)) {
    Refuse("control=ambient needs an environment, and this scene has none" +
           std::string(f.Has(Feature::kAreaLights)
                           ? "; control=analytic is for its area lights"
                           : "; control=regression needs no light of a kind"));
  }
  if (s.control == Control::kAmbient) CheckAmbient(s, scene);
  if (s.control != Control::kAnalytic) return;
  if (!f.Has(Feature::kAreaLights)) {
    Refuse("control=analytic needs emitting shapes, and this scene has none" +
           std::string(f.Has(Feature::kInfiniteLights)
                           ? "; control=ambient is for its environment"
                           : "; control=regression needs no light of a kind"));
  }
  if (!s.SamplesHittableLights()) {
    Refuse(std::string("control=analytic needs samples of the area lights: "
                       "directions=light or mis, not ") +
           Name(s.directions));
  }
}

}  // namespace

FeatureSet PlanFeatures(const CompiledScene& scene, const PlanOptions& options) {
  const Strategy strategy = PlannedStrategy(scene, options);
  FeatureSet f = scene.features;
  if (options.max_depth > 0 && HasSurfaces(f)) {
    f.Add(Feature::kScatters);
    AddLightSampling(strategy, f);
    if (options.max_depth > 1) f.Add(TurnsOn(strategy.roulette));
    if (CanGuide(strategy, f)) f.Add(TurnsOn(strategy.guiding));
    f.Add(TurnsOn(strategy.decide));
  } else {
    RemoveScattering(f);
  }
  if (options.aov) f.Add(Feature::kAov);
  f.Add(TurnsOn(strategy.points));
  f.Add(TurnsOn(strategy.pairs));
  AddControl(strategy, f);
  if (options.training) f.Add(*options.training);
  return f;
}

Strategy PlannedStrategy(const CompiledScene& scene, const PlanOptions& options) {
  Strategy strategy = scene.strategy;
  ApplyStrategy(options.changes, {}, strategy);
  if (options.camera_only) strategy.control = Control::kNone;
  if (!options.training) return strategy;
  if (!options.own_points) strategy.points = Points::kIndependent;
  strategy.pairs = Pairs::kNone;
  strategy.control = Control::kNone;
  return strategy;
}

std::vector<std::string> CheckStrategy(const CompiledScene& scene,
                                       const PlanOptions& options) {
  const Strategy s = PlannedStrategy(scene, options);
  const FeatureSet& f = scene.features;
  CheckControl(s, scene, options);
  std::vector<std::string> notes;
  if (s.light_selection != LightSelection::kPower && !f.Has(Feature::kManyLights)) {
    notes.push_back(std::string("light-selection=") + Name(s.light_selection) +
                    " has no effect: there are no two lights to choose from");
  }
  if (s.light_points != LightPoints::kArea &&
      !SamplesFlatLights(PlanFeatures(scene, options))) {
    notes.push_back(std::string("light-points=") + Name(s.light_points) +
                    " has no effect: no triangle or rectangle that emits is sampled");
  }
  if (s.directions == Directions::kLight && !f.Has(Feature::kLights)) {
    notes.push_back(
        "directions=light: there is no light to sample, only what the camera "
        "sees itself or in mirrors");
  }
  if (s.roulette != Roulette::kThroughput && s.roulette != Roulette::kNone &&
      options.max_depth <= 1) {
    notes.push_back(std::string("roulette=") + Name(s.roulette) +
                    " has no effect: paths end after one scattering event");
  }
  if (s.environment == EnvironmentPoints::kCompensated &&
      !f.Has(Feature::kInfiniteImage)) {
    notes.push_back(
        "environment=compensated has no effect: there is no environment image");
  } else if (s.environment == EnvironmentPoints::kCompensated &&
             s.directions != Directions::kMis) {
    notes.push_back(
        std::string("environment=compensated has no effect with directions=") +
        Name(s.directions) +
        ": only with directions=mis do scattered rays find what light samples "
        "leave out");
  }
  if (s.guiding != Guiding::kNone && s.directions == Directions::kUniform) {
    notes.push_back(std::string("guiding=") + Name(s.guiding) +
                    " has no effect: directions=uniform asks nobody");
  } else if (s.guiding != Guiding::kNone &&
             !PlanFeatures(scene, options).Has(Feature::kGuided)) {
    notes.push_back(std::string("guiding=") + Name(s.guiding) +
                    " has no effect: nothing scatters, or mirrors and clear glass alone");
  }
  if (s.shadow_roulette != ShadowRoulette::kNone &&
      !PlanFeatures(scene, options).Has(Feature::kLights)) {
    notes.push_back("shadow-roulette=contribution has no effect: no light is sampled");
  }
  if (s.pairs == Pairs::kAntithetic && s.paired == Paired::kLight &&
      !PlanFeatures(scene, options).Has(Feature::kLights)) {
    notes.push_back("pairs=antithetic:light has no effect: no light is sampled");
  }
  if (s.control == Control::kRegression && s.points != Points::kIndependent) {
    notes.push_back(std::string("control=regression gains little with points=") +
                    Name(s.points) +
                    ", which integrate polynomials well already: its place is "
                    "points=independent");
  }
  return notes;
}

}  // namespace lanelight
