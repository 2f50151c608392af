// The flags that several commands share: which scene, and what overrides it.
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

/// Declare flags on `command`; what they are stored in must outlive parsing.
void AddWindowOptions(CLI::App& command, RenderSettings& settings);
void AddStrategyOptions(CLI::App& command, RenderSettings& settings);
void AddSeedOption(CLI::App& command, RenderSettings& settings);
void AddThreadsOption(CLI::App& command, int& threads);
void AddTransportOptions(CLI::App& command, RenderSettings& settings);
/// What is waited for is printed, unless folder.on_wait is set otherwise.
void AddBuildCacheOptions(CLI::App& command, TreeFolder& folder);
void AddExecutionOptions(CLI::App& command, SceneOptions& options);

/// These, the scene itself, the strategy and --aov.
void AddSceneOptions(CLI::App& command, SceneOptions& options);

/// The flags of AddSceneOptions and the seed that give these options, each with a space
/// before it; without scene and strategy.
std::string FlagsText(const SceneOptions& options);

/// The text as one word of a shell.
std::string ShellWord(const std::string& text);

}  // namespace lanelight
