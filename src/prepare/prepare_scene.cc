#include "src/prepare/prepare_scene.h"

#include "src/prepare/use_strategy.h"

namespace lanelight {

CompiledScene PrepareScene(const SceneDescription& description,
                           const CompileOptions& options) {
  CompiledScene scene = CompileScene(description, options);
  UseStrategy(description.strategy, scene);
  return scene;
}

}  // namespace lanelight
