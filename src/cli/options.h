// Flags that several commands share, the checks of their values, and the defaults that
// help tells: made of the values that flags set, so that both are declared once.
#pragma once

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <string>

#include "src/base/core/value_types.h"
#include "src/render/job/render.h"
#include "src/render/job/setting.h"

namespace lanelight {

/// Returns a validator for a value of this type (src/base/core/value_types.h), read as
/// those of settings are; the text becomes one that CLI11 reads alike.
template <class Type>
CLI::Validator ValueOf(const Type& type) {
  return CLI::Validator(
      [type](std::string& text) {
        try {
          text = type.Write(ReadValue(type, text));
        } catch (const InputError& error) {
          return std::string(error.message());
        }
        return std::string();
      },
      "");
}

/// Returns a validator for a finite number, or an integer, of [low, high]. (CLI::Range
/// accepts "nan", and CLI11 reads a negative or too large seed as 2^64 - 1.)
template <class T>
CLI::Validator ValueFrom(T low, T high) {
  return ValueOf(NumberType<T>{low, high});
}

/// Returns a validator for the name of a file of this kind, so that a swallowed word,
/// such as an input, is not overwritten.
inline auto EndsIn(const std::string& extension) {
  return [extension](const std::string& path) {
    return path.ends_with(extension)
               ? std::string()
               : fmt::format("'{}' does not end in {}", path, extension);
  };
}

/// Adds an option to `command`. `names`: its names, and after a space the type of its
/// value in help texts: "-o,--output FILE", or "SCENE" alone.
template <class T>
CLI::Option* AddOption(CLI::App& command, const std::string& names, T& value,
                       const std::string& meaning) {
  const std::size_t space = names.find(' ');
  CLI::Option* option = command.add_option(names.substr(0, space), value, meaning);
  return option->type_name(space == names.npos ? "" : names.substr(space + 1));
}

/// Returns "Seconds between states; default: 60".
template <class T>
std::string WithDefault(const std::string& meaning, const T& value) {
  return fmt::format("{}; default: {}", meaning, value);
}

struct SceneOptions {
  std::string scene;
  RenderSettings settings;
};

/// Declares the flag of one setting on `command`; `settings` must outlive parsing, and
/// their values are the defaults in help.
CLI::Option* AddSetting(CLI::App& command, const std::string& name,
                        RenderSettings& settings);
/// Declares all settings of that use.
void AddSettings(CLI::App& command, SettingUse use, RenderSettings& settings);

/// Declares the scene, and the settings of commands that read one.
void AddSceneOptions(CLI::App& command, SceneOptions& options);

/// Throws CLI::ValidationError if --time and --spp are given without an error target, of
/// which they are the limits.
void CheckAmountOptions(const RenderSettings& settings);

/// Returns the flags that give these settings, each with a space before it.
std::string FlagsText(const RenderSettings& settings);

/// Returns the text as one word of a shell.
std::string ShellWord(const std::string& text);

struct CheckpointFlags {
  CheckpointSettings settings;
  std::string part;
  CLI::Option* resume_flag = nullptr;
};

/// Declares the flags on `command`; `flags` must outlive parsing.
void AddCheckpointOptions(CLI::App& command, CheckpointFlags& flags);

/// Stores the settings in `targets`, after parsing. Throws CLI::ValidationError for flags
/// that contradict each other, or if no output is given.
void ResolveCheckpoint(const CheckpointFlags& flags, RenderTargets& targets);

/// Reads "3/16". Throws CLI::ValidationError for anything else.
Part ParsePart(const std::string& text);

/// Throws InputError if the job's number of samples is not fixed, which parts need.
void CheckPart(const CheckpointSettings& settings, const Job& job);

}  // namespace lanelight
