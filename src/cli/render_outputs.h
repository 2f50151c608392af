// What `render` and `advise` write: the flags that say where to, and what is printed.
#pragma once

#include <CLI/CLI.hpp>
#include <atomic>
#include <string>
#include <vector>

#include "src/cli/progress.h"
#include "src/cli/scene_options.h"
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

/// After parsing: "--png" alone names the file after the EXR. Throws CLI::ValidationError
/// for a word after it that is no PNG: most likely the scene, swallowed.
void ResolveOutputs(RenderOutputs& options, const RenderSettings& settings);

/// CheckOutputPaths() with the scene, and once that is read, with all its files.
void CheckOutputs(const RenderOutputs& options, const std::set<std::string>& inputs);

/// The scene as its flags want it. Throws InputError if one of its files would be written
/// over. Unless `quiet`, notes are printed.
Job OpenScene(const SceneOptions& options, const OutputPaths& outputs, bool quiet);

/// Prints what of the scene file and of the strategy is not used.
void PrintNotes(const Job& job);

/// Prints messages about files. True if there are none.
bool PrintProblems(const std::vector<std::string>& problems);

/// Writes a text to `path`, or with a message to the temporary directory, and then
/// returns false. "-": standard output.
bool SaveOrPrint(const std::string& path, const std::string& text);

/// Shows progress; `stop` ends the render early.
RenderHooks PrintingHooks(ProgressPrinter& progress, const std::atomic<bool>& stop);

/// Prints what a render came to, after `preface`. Returns the exit code.
int PrintRendering(const Rendering& rendering, const Job& job,
                   const RenderOutputs& options, const std::string& preface = "");

}  // namespace lanelight
