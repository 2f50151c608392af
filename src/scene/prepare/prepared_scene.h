// A scene that can be rendered: what is compiled once, seen in some way, with a strategy.
#pragma once

#include <memory>
#include <vector>

#include "src/vocabulary/path/features.h"
#include "src/vocabulary/path/scene_kinds.h"
#include "src/vocabulary/path/scene_parts.h"
#include "src/vocabulary/strategy/strategy.h"

namespace lanelight {

struct CompileOptions;    // src/scene/compile/compile.h
struct CompiledScene;     // src/scene/compiled/scene.h
struct CompiledView;      // src/scene/compiled/view.h
struct LightChances;      // src/scene/compiled/lights.h
struct Note;              // src/scene/description/note.h
struct SceneDescription;  // src/scene/description/description.h

/// Cheap to copy: copies share all that is large, and nothing of that ever changes. So
/// one scene can be rendered with several strategies and views at the same time.
struct PreparedScene {
  std::shared_ptr<const CompiledScene> compiled;
  std::shared_ptr<const CompiledView> view;
  Strategy strategy;
  std::shared_ptr<const LightChances> chances;  // of the strategy

  /// Returns the data for kernels, which refer to this object.
  SceneParts Parts() const;

  // Data of the compiled scene, for callers that do not include it.
  const FeatureSet& features() const;
  double scale() const;  // scene units per world unit
  Transport transport() const;
  const std::vector<Note>& notes() const;
};

/// environment=compensated has an effect: what light samples leave out, scattered rays
/// must find with their full weight, as with directions=mis.
bool CompensatesEnvironment(const Strategy& strategy);

/// distances=equiangular finds points in some medium by the angle around a light: the
/// medium is the same everywhere and scatters, and a light is sampled that has a place.
bool HasAnchors(const Strategy& strategy, const CompiledScene& scene);

/// Cheap next to compiling the scene. Tables of environment images that are not
/// compensated are the scene's own.
LightChances MakeLightChances(const CompiledScene& scene, const Strategy& strategy);

/// Returns the same scene and view, prepared for a strategy.
PreparedScene WithStrategy(PreparedScene scene, const Strategy& strategy);

/// Compiles the scene and prepares it for the strategy of the description. Throws
/// InputError as CompileScene does.
PreparedScene PrepareScene(const SceneDescription& description,
                           const CompileOptions& options);
PreparedScene PrepareScene(const SceneDescription& description);

struct PreparedScene;  // src/scene/prepare/prepared_scene.h

/// Returns the probability that a direction meets a lamp, if directions ignore lights
/// (directions=bsdf, uniform): 1 / sum p^2 / s over lights that can be hit. p is a
/// light's share of the power, s the share of all directions that it fills as seen from
/// the middle of the scene. N directions are then worth N times this many hits of one
/// lamp. Returns 1 for other strategies, and if no light can be hit.
double ChanceOfLight(const PreparedScene& scene);

}  // namespace lanelight
