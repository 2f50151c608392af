// The flags of `render` that keep its state: --checkpoint, --every, --resume, --watch and
// --part.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "src/render/job/render.h"

namespace lanelight {

struct CheckpointFlags {
  CheckpointSettings settings;
  std::string part;
  CLI::Option* resume_flag = nullptr;
};

/// Declares the flags on `command`; `flags` must outlive parsing.
void AddCheckpointOptions(CLI::App& command, CheckpointFlags& flags);

/// After parsing: puts the settings into `targets`. Throws CLI::ValidationError for flags
/// that do not go together, or if nothing says where results go.
void ResolveCheckpoint(const CheckpointFlags& flags, RenderTargets& targets);

/// "3/16". Throws CLI::ValidationError for anything else.
Part ParsePart(const std::string& text);

/// Throws InputError if a part of this job says nothing of the whole: its number of
/// samples must be known.
void CheckPart(const CheckpointSettings& settings, const Job& job);

}  // namespace lanelight
