// `lanelight profile SCENE`: where the time of a render goes, stage by stage.
#include <memory>
#include <nlohmann/json.hpp>

#include "src/base/core/json_text.h"
#include "src/cli/commands.h"
#include "src/cli/console.h"
#include "src/cli/exit_codes.h"
#include "src/cli/interrupt.h"
#include "src/cli/options.h"
#include "src/cli/progress.h"
#include "src/cli/render_outputs.h"
#include "src/cli/texts.h"
#include "src/render/job/profile_report.h"
#include "src/render/job/saving.h"

namespace lanelight {
namespace {

struct ProfileCommandOptions {
  SceneOptions scene;
  std::string json, trace;
  std::size_t trace_events = std::size_t{1} << 17;
  bool quiet = false;
};

constexpr const char* kProfileInterruptText =
    "\nstopping: finishing the samples in flight, then printing what was measured (once "
    "more to abort)\n";

RunResult Measure(const ProfileCommandOptions& options, const Job& job,
                  const std::atomic<bool>& stop) {
  ProgressPrinter progress(ChooseProgressStyle(options.quiet));
  RunOptions run = RunOptionsOf(job);
  run.stop = &stop;
  run.on_progress = [&](const Progress& p) { progress.Update({p, {}, {}}); };
  run.profiling.counters = true;
  if (!options.trace.empty()) run.profiling.trace_events = options.trace_events;
  FilmAccumulator film = MakeFilm(job);
  const RunResult result = Run(job.scene, job.plan, run, film);
  progress.Finish();
  return result;
}

bool SaveTrace(const ProfileCommandOptions& options, const RunResult& result) {
  if (options.trace.empty()) return true;
  const std::uint64_t dropped = DroppedEvents(result.trace);
  if (dropped > 0) {
    PrintError(
        fmt::format("note: the trace lacks its last {} events: --trace-events {} "
                    "per thread was not enough",
                    dropped, options.trace_events));
  }
  return SaveOrPrint(options.trace,
                     TraceText(result, "lanelight profile " + options.scene.scene));
}

int Profile(const ProfileCommandOptions& options) {
  const Job job =
      OpenScene(options.scene, {{options.json, options.trace}}, options.quiet);
  const Peaks peaks = MeasurePeaks(job.plan.options.target, true);
  const InterruptGuard interrupt(kProfileInterruptText, job.settings.threads);
  const RunResult result = Measure(options, job, interrupt.stop());
  const ProfileReport report = MakeProfileReport(result, peaks);
  if (options.json != "-") Print(ProfileText(report, job, result, options.scene.scene));
  bool good = SaveTrace(options, result);
  if (!options.json.empty()) {
    good &= SaveOrPrint(options.json, DumpJson(ToJson(report, job, result), 2) + "\n");
  }
  return good ? kExitGood : kExitBadInput;
}

void AddProfileOptions(CLI::App& command, ProfileCommandOptions& options) {
  AddSettings(command, kAmountFlag, options.scene.settings);
  // The same default as for `render`, so that the profile is of the same program.
  options.scene.settings.decision = DefaultDecision::kIfLong;
  AddOption(command, "--json FILE", options.json,
            "Write the profile as JSON ('-': print it)");
  AddOption(command, "--trace FILE", options.trace,
            "Write every stage call as a trace for ui.perfetto.dev")
      ->check([](const std::string& path) {
        return path == "-" ? std::string("a trace goes to a file, not to '-'") : "";
      });
  AddOption(command, "--trace-events N", options.trace_events,
            WithDefault("Maximum number of stage calls that a thread records",
                        options.trace_events))
      ->transform(ValueFrom(std::size_t{1}, std::size_t{1} << 26));
  command.add_flag("--quiet", options.quiet, "No progress and no notes");
}

}  // namespace

void AddProfileCommand(CLI::App& root, Command& chosen) {
  CLI::App* command = root.add_subcommand(
      "profile", "Render a scene and print where the time goes, stage by stage");
  auto options = std::make_shared<ProfileCommandOptions>();
  AddProfileOptions(*command, *options);
  AddSceneOptions(*command, options->scene);
  command->footer(
      "\nRenders what `lanelight render` renders with the same arguments, its trial run\n"
      "included; the image is not kept. Ctrl-C prints what was measured so far; a\n"
      "second one aborts. docs/profile.md says what the columns mean.\n"
      "\nExamples:\n"
      "  lanelight profile scene.pbrt --threads 1\n"
      "  lanelight profile scene.pbrt --spp 4 --trace trace.json --json profile.json");
  command->callback([options, &chosen] {
    CheckAmountOptions(options->scene.settings);
    chosen = [options] { return Profile(*options); };
  });
}

}  // namespace lanelight
