// The outputs of `render`: the flags that name them, and what is printed.
#pragma once

#include <CLI/CLI.hpp>
#include <atomic>
#include <string>
#include <vector>

#include "src/cli/options.h"
#include "src/cli/progress.h"
#include "src/render/job/render.h"
#include "src/render/job/saving.h"

namespace lanelight {

struct RenderOutputs {
  RenderTargets targets;
  bool quiet = false, verbose = false;
  CLI::Option* png_flag = nullptr;
};

/// Declares the flags on `command`; `options` and `settings` must outlive parsing.
void AddOutputOptions(CLI::App& command, RenderOutputs& options,
                      RenderSettings& settings);

/// Names the file of a bare "--png" after the EXR, after parsing. Throws
/// CLI::ValidationError for a word after it that is no PNG, most likely the scene.
void ResolveOutputs(RenderOutputs& options, const RenderSettings& settings);

/// Calls CheckOutputPaths() with the scene, and once that is read with all its files.
void CheckOutputs(const RenderOutputs& options, const std::set<std::string>& inputs);

/// Prepares the scene with its flags. Throws InputError if an output would overwrite one
/// of its files. Prints notes unless `quiet`.
Job OpenScene(const SceneOptions& options, const OutputPaths& outputs, bool quiet);

/// Prints notes on the scene file and the strategy.
void PrintNotes(const Job& job);

/// Prints messages about files. Returns whether there are none.
bool PrintProblems(const std::vector<std::string>& problems);

/// Writes a text to `path`, or to standard output for "-". If that fails, prints a
/// message, writes it to the temporary directory, and returns false.
bool SaveOrPrint(const std::string& path, const std::string& text);

/// Returns hooks that show progress; `stop` ends the render early.
RenderHooks PrintingHooks(ProgressPrinter& progress, const std::atomic<bool>& stop);

/// Prints the result of a render. Returns the exit code.
int PrintRendering(const Rendering& rendering, const Job& job,
                   const RenderOutputs& options);

}  // namespace lanelight
