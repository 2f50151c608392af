// A scene that can be rendered: what is compiled once, seen in some way, with a strategy.
#pragma once

#include <memory>

#include "src/scene/compile/compile.h"
#include "src/vocabulary/path/wave.h"

namespace lanelight {

/// Cheap to copy: copies share all that is large, and nothing of that ever changes. So
/// one scene can be rendered with several strategies and views at the same time.
struct PreparedScene {
  std::shared_ptr<const CompiledScene> compiled;
  CompiledView view;
  Strategy strategy;
  std::shared_ptr<const LightChances> chances;  // of the strategy

  /// For kernels. Refers to this object.
  SceneParts Parts() const { return {compiled.get(), &view, chances.get()}; }
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

/// The same scene and view, prepared for a strategy.
PreparedScene WithStrategy(PreparedScene scene, const Strategy& strategy);

/// Compiles the scene and prepares it for the strategy of the description. Throws
/// InputError as CompileScene does.
PreparedScene PrepareScene(const SceneDescription& description,
                           const CompileOptions& options = {});

}  // namespace lanelight
