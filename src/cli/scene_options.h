// The flags that several commands share: which scene, and the settings that override it.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "src/render/job/setting.h"

namespace lanelight {

struct SceneOptions {
  std::string scene;
  RenderSettings settings;
};

/// Declares the flag of one setting on `command`; `settings` must outlive parsing. What
/// they have already is the default that help tells.
CLI::Option* AddSetting(CLI::App& command, const std::string& name,
                        RenderSettings& settings);
/// All settings of that use, in their order.
void AddSettings(CLI::App& command, SettingUse use, RenderSettings& settings);

/// The scene itself, and the settings of commands that read one.
void AddSceneOptions(CLI::App& command, SceneOptions& options);

/// Throws CLI::ValidationError if --time and --spp both say how much to render: that
/// needs an error target, of which they are the limits.
void CheckAmountOptions(const RenderSettings& settings);

/// The flags that give these settings, each with a space before it.
std::string FlagsText(const RenderSettings& settings);

/// The text as one word of a shell.
std::string ShellWord(const std::string& text);

}  // namespace lanelight
