// What `render` and `advise` write: the flags that say where to, and what is printed.
#pragma once

#include <CLI/CLI.hpp>
#include <atomic>
#include <string>
#include <vector>

#include "src/cli/progress.h"
#include "src/render/render.h"

namespace lanelight {

struct RenderOutputs {
  RenderTargets targets;
  std::string depth = "float";
  bool quiet = false;
  CLI::Option* png_flag = nullptr;
};

/// Declares the flags on `command`; `options` must outlive parsing. `required`: an image
/// must be named.
void AddOutputOptions(CLI::App& command, RenderOutputs& options, bool required);

/// After parsing: "--png" alone names the file after the EXR. Throws CLI::ValidationError
/// for a word after it that is no PNG: most likely the scene, swallowed.
void ResolveOutputs(RenderOutputs& options);

/// CheckOutputPaths() with the scene, and once that is read, with all its files.
void CheckOutputs(const RenderOutputs& options, const std::set<std::string>& inputs);

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
