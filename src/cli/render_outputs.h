// What `render` and `advise` write: the flags that say where to, and the writing.
#pragma once

#include <CLI/CLI.hpp>
#include <atomic>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "src/render/job.h"

namespace lanelight {

struct RenderOutputs {
  std::string exr, png, json, depth = "float";
  double exposure = 0;
  bool want_png = false, quiet = false;
  CLI::Option* png_flag = nullptr;
};

/// Declares the flags on `command`; `options` must outlive parsing. `required`: an image
/// must be named.
void AddOutputOptions(CLI::App& command, RenderOutputs& options, bool required);

/// After parsing: "--png" alone names the file after the EXR. Throws CLI::ValidationError
/// for a word after it that is no PNG: most likely the scene, swallowed.
void ResolvePng(RenderOutputs& options);

/// Throws InputError if an output would overwrite the scene or another one, or cannot be
/// written.
void CheckOutputs(const RenderOutputs& options, const std::string& scene);

/// The same for these paths. Empty ones are left out, and so is "-", standard output.
void CheckOutputPaths(std::vector<std::string> paths, const std::string& scene);

/// Prints what of the scene file and of the strategy is not used.
void PrintNotes(const Job& job);

/// Writes the report where it was asked for. False, with a message, if that failed; it
/// then lies in the temporary directory, so that nothing computed is lost.
bool SaveJson(const RenderOutputs& options, const nlohmann::json& report);

/// Writes a text to `path`, or with a message to the temporary directory, and then
/// returns false. "-": standard output. Empty: nowhere.
bool SaveText(const std::string& path, const std::string& text);

/// What a command has to say in front of the summary, and in the report beside a render's
/// own members.
struct Preface {
  std::string text;
  nlohmann::json members = nlohmann::json::object();
};

/// Renders the job with progress, writes images and report, prints the summary. Returns
/// the exit code. `stop` ends the render early; what is there is written.
int RenderToOutputs(const RenderOutputs& options, const std::string& scene,
                    const Job& job, const std::atomic<bool>& stop,
                    const Preface& preface = {});

}  // namespace lanelight
