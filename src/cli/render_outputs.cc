#include "src/cli/render_outputs.h"

#include <filesystem>

#include "src/base/core/json_text.h"
#include "src/cli/console.h"
#include "src/cli/exit_codes.h"
#include "src/cli/texts.h"
#include "src/render/job/loaded_scene.h"
#include "src/render/job/partial_outputs.h"
#include "src/scene/description/note.h"

namespace lanelight {
namespace {

namespace fs = std::filesystem;

// Returns whether the image took the time that it should, and is as good as it should be.
int CheckAmount(const RenderReport& report, const Job& job, bool quiet) {
  const RunResult& r = report.result;
  if (!quiet && job.seconds > 0 && r.seconds > 1.05 * job.seconds &&
      r.samples <= 2 * job.window.pixels() && report.unsampled_pixels == 0) {
    PrintError(
        fmt::format("note: --time {}: one sample per pixel takes longer ({}); use a "
                    "lower --resolution",
                    job.seconds, DurationText(r.seconds)));
  }
  if (!job.target.Any() || Reached(job.target, report.error)) return kExitGood;
  std::string error = PercentText(report.error);
  if (report.error.available && report.error.why != kNoLight) {
    error += ", " + ErrorText(report.error);
  }
  const std::string limit = r.stop_reason == StopReason::kInterrupted ? "interruption"
                            : r.stop_reason == StopReason::kTime      ? "--time"
                                                                      : "--spp";
  const double spp = double(r.samples) / double(job.window.pixels());
  PrintError(
      r.stop_reason == StopReason::kHopeless
          ? fmt::format("error: the target was not reached and more samples will not "
                        "help: stopped after {:.0f} samples per pixel, {:.0f}x the "
                        "estimated need; error {}",
                        spp, kHopelessFactor, error)
          : fmt::format(
                "error: the target was not reached before the limit ({}); error {}",
                limit, error));
  return kExitTargetMissed;
}

// Says where the results are that are not in the files asked for.
void PrintPartial(const RenderReport& report, const Job& job,
                  const RenderOutputs& options) {
  const std::string& requested = options.targets.exr;
  std::string text =
      report.has_holes ? "error: " + report.error.why : "error: the render ended early";
  if (report.unsampled_pixels == job.window.pixels()) {
    text = "error: the render was stopped before its first sample: no image is written";
  } else if (!report.exr.empty()) {
    text += "; the partial image is '" + report.exr + "'";
  } else if (!options.targets.json.empty()) {
    text += "; the report is '" +
            PartialPath(options.targets.json, report.partial_number) + "'";
  }
  if (report.has_holes && report.result.stop_reason != StopReason::kInterrupted) {
    text += fmt::format("; paths there may not end (the maximum depth is {})",
                        job.plan.options.max_depth);
  }
  std::error_code ignored;
  if (!requested.empty() && fs::exists(requested, ignored)) {
    text += "; '" + requested + "' is unchanged";
  }
  PrintError(text);
}

// Warns unless the summary does so in its last line.
int CheckImageChanges(const Job& job, const RenderOutputs& options) {
  const std::string text = ImageChangesText(job.loaded->description.notes);
  if (text.empty()) return kExitGood;
  if (options.quiet || options.targets.json == "-") PrintError("warning: " + text);
  return kExitImageDiffers;
}

}  // namespace

void AddOutputOptions(CLI::App& command, RenderOutputs& options,
                      RenderSettings& settings) {
  AddOption(command, "-o,--output FILE", options.targets.exr,
            "Write the image to this file (.exr)")
      ->check([](const std::string& path) {
        return fs::path(path).extension() == ".exr"
                   ? std::string()
                   : "'" + path + "' does not end in .exr (for a PNG add --png FILE)";
      });
  options.png_flag = AddOption(command, "--png [FILE]", options.targets.png,
                               "Write a PNG too; named after the EXR if bare")
                         ->expected(0, 1);
  AddSettings(command, kImageFlag, settings);
  AddOption(command, "--json FILE", options.targets.json,
            "Write the results as JSON ('-': print them)");
  CLI::Option* verbose =
      command.add_flag("-v,--verbose", options.verbose,
                       "Also print strategy, machine, times and the cost of each stage");
  command.add_flag("--quiet", options.quiet, "Print errors and warnings only")
      ->excludes(verbose);
}

void ResolveOutputs(RenderOutputs& options, const RenderSettings& settings) {
  RenderTargets& targets = options.targets;
  targets.image = settings.image;
  if (options.png_flag->count() == 0) return;
  if (targets.png.empty()) targets.png = fs::path(targets.exr).replace_extension(".png");
  if (fs::path(targets.png).extension() == ".png") return;
  throw CLI::ValidationError("--png",
                             "'" + targets.png +
                                 "' does not end in .png (SCENE must not follow a "
                                 "bare --png)");
}

void CheckOutputs(const RenderOutputs& options, const std::set<std::string>& inputs) {
  const RenderTargets& t = options.targets;
  OutputPaths outputs = {{t.exr, t.png, t.json}};
  outputs.files.insert(outputs.files.end(), t.checkpoint.watch.begin(),
                       t.checkpoint.watch.end());
  // Only the render that resumes from a state may overwrite it.
  if (!t.checkpoint.from.empty()) CheckOutputPaths(outputs, {t.checkpoint.from});
  outputs.files.push_back(t.checkpoint.path);
  CheckOutputPaths(outputs, inputs);
}

Job OpenScene(const SceneOptions& options, const OutputPaths& outputs, bool quiet) {
  CheckOutputPaths(outputs, {options.scene});
  Job job = PrepareJob(options.scene, options.settings);
  CheckOutputPaths(outputs, job.loaded->files);
  if (!quiet) PrintNotes(job);
  return job;
}

void PrintNotes(const Job& job) {
  for (const std::string& line : NoteLines(job.loaded->description.notes))
    PrintError(line);
  for (const std::string& note : job.plan.notes) PrintError("note: " + note);
}

bool PrintProblems(const std::vector<std::string>& problems) {
  for (const std::string& problem : problems) PrintError(problem);
  return problems.empty();
}

bool SaveOrPrint(const std::string& path, const std::string& text) {
  if (path == "-") {
    Print(text);
    return true;
  }
  ResultWriter writer;
  writer.SaveText(path, text);
  return PrintProblems(writer.problems());
}

int PrintRendering(const Rendering& rendering, const Job& job,
                   const RenderOutputs& options) {
  const RenderReport& report = rendering.report;
  const std::string kept =
      rendering.is_checkpoint_saved ? options.targets.checkpoint.path : std::string();
  const bool good = PrintProblems(rendering.problems);
  if (options.targets.json == "-") {
    Print(DumpJson(rendering.json, 2) + "\n");
  } else if (!options.quiet && (!report.has_holes || report.result.samples > 0)) {
    Print(SummaryText(report, job, {options.verbose, kept}));
  }
  if (good && report.partial_number > 0) PrintPartial(report, job, options);
  if (report.result.health.Total() > 0) {
    PrintError(fmt::format("error: {} samples were invalid and count as zero",
                           report.result.health.Total()));
    return kExitInvalidSamples;
  }
  if (!report.has_holes && report.black) PrintError(fmt::format("warning: {}", kNoLight));
  const CheckpointSettings& checkpoint = options.targets.checkpoint;
  if (!checkpoint.path.empty() && !rendering.is_checkpoint_saved) {
    PrintError("error: the last state could not be written to '" + checkpoint.path + "'");
    return kExitBadInput;
  }
  if (!good) return kExitBadInput;
  if (!checkpoint.path.empty() && report.result.stopped_early) {
    PrintError("interrupted: continue with --resume '" + checkpoint.path + "'");
    return kExitInterrupted;
  }
  if (report.has_holes) return kExitInterrupted;
  const int code = CheckAmount(report, job, options.quiet);
  if (report.partial_number > 0) return kExitInterrupted;
  return code == kExitGood ? CheckImageChanges(job, options) : code;
}

RenderHooks PrintingHooks(ProgressPrinter& progress, const std::atomic<bool>& stop) {
  RenderHooks hooks;
  if (progress.Shows()) {
    hooks.on_progress = [&](const RenderProgress& p) { progress.Update(p); };
    hooks.reports_error = true;
    hooks.on_training = [&] {
      progress.PrintMessage("trial run: choosing a strategy for this scene",
                            /*always=*/true);
    };
  }
  hooks.on_rendered = [&] { progress.Finish(); };
  hooks.on_problem = [&](const std::string& problem) {  // rendering goes on
    progress.Interrupt([&] { PrintWarning(problem); });
  };
  hooks.stop = &stop;
  return hooks;
}

}  // namespace lanelight
