// The flags that `render` and `plan` share: which scene, and what overrides it.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "src/render/settings.h"

namespace lanelight {

struct SceneOptions {
  std::string scene;
  RenderSettings settings;
  int threads = 0;     // 0: all cores
  std::string target;  // empty: the best available
};

/// Declares the flags on `command`; `options` must outlive parsing.
void AddSceneOptions(CLI::App& command, SceneOptions& options);

}  // namespace lanelight
