// `lanelight profile SCENE`: where the time of a render goes, stage by stage.
#include <algorithm>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "src/base/core/json_text.h"
#include "src/base/core/stopwatch.h"
#include "src/cli/commands.h"
#include "src/cli/console.h"
#include "src/cli/exit_codes.h"
#include "src/cli/interrupt.h"
#include "src/cli/options.h"
#include "src/cli/progress.h"
#include "src/cli/render_outputs.h"
#include "src/cli/texts.h"
#include "src/measure/profile/profile_page.h"
#include "src/render/job/profile_report.h"
#include "src/render/job/saving.h"

namespace lanelight {
namespace {

struct ProfileCommandOptions {
  SceneOptions scene;
  std::string json, csv, html, trace, against;
  double tolerance = 0.05;
  std::size_t trace_events = std::size_t{1} << 17;
  int repeats = 0;  // 0: one, or kProfileRepeats with `against`
  bool quiet = false, verbose = false;
};

constexpr const char* kProfileInterruptText =
    "\nstopping: finishing the samples in flight, then printing what was measured (once "
    "more to abort)\n";

struct Measurements {
  std::vector<RunResult> results;
  std::optional<FilmAccumulator> film;  // of the first
  std::vector<TaskCost> tasks;          // of the first, with `html`
};

// Renders the job as often as asked, the first time with a trace. A repeat that `stop`
// cuts short is left out, unless it is the first.
Measurements Measure(const ProfileCommandOptions& options, const Job& job,
                     const std::atomic<bool>& stop) {
  ProgressPrinter progress(ChooseProgressStyle(options.quiet));
  const Stopwatch watch;
  Measurements out;
  for (int i = 0; i < options.repeats && (i == 0 || !stop); ++i) {
    RunOptions run = RunOptionsOf(job);
    run.stop = &stop;
    run.on_progress = [&](Progress p) {
      p.fraction = (i + p.fraction) / options.repeats;
      p.seconds = watch.Seconds();
      progress.Update({p, {}, {}});
    };
    run.profiling.counters = run.profiling.bounces = true;
    if (i == 0 && !(options.trace.empty() && options.html.empty())) {
      run.profiling.trace_events = options.trace_events;
    }
    if (i == 0 && !options.html.empty()) {
      run.on_task = [&out](const PixelRect& tile, const RunCounts& counts) {
        out.tasks.push_back({tile, double(counts.samples), counts.cpu_seconds});
      };
    }
    FilmAccumulator film = MakeFilm(job);
    RunResult result = Run(job.scene, job.plan, run, film);
    if (i > 0 && result.stopped_early) break;
    out.results.push_back(std::move(result));
    if (i == 0) out.film = std::move(film);
  }
  progress.Finish();
  return out;
}

bool SaveTrace(const ProfileCommandOptions& options, const Job& job,
               const RunResult& result) {
  if (options.trace.empty()) return true;
  const std::uint64_t dropped = DroppedEvents(result.trace);
  if (dropped > 0) {
    PrintError(
        fmt::format("note: the trace lacks its last {} events: --trace-events {} "
                    "per thread was not enough",
                    dropped, options.trace_events));
  }
  return SaveOrPrint(options.trace,
                     TraceText(result, job.plan.options.target.lanes(),
                               "lanelight profile " + options.scene.scene));
}

// Prints the comparison and returns its exit code.
int PrintComparison(const ProfileCommandOptions& options,
                    const ProfileComparison& comparison) {
  constexpr std::size_t kMaxChanges = 12;
  if (options.json != "-") {
    Print("\n" + ComparisonText(comparison, options.tolerance,
                                options.verbose ? comparison.changes.size() : kMaxChanges,
                                TerminalColumns(Stream::kOutput)));
  }
  if (!comparison.problems.empty()) return kExitNotComparable;
  return comparison.IsSlower() ? kExitSlower : kExitGood;
}

int Profile(ProfileCommandOptions options) {
  const OutputPaths outputs = {{options.json, options.csv, options.html, options.trace}};
  CheckOutputPaths(outputs, {options.against});
  nlohmann::json before;
  if (!options.against.empty()) before = ReadProfile(options.against);
  if (options.repeats == 0) options.repeats = before.is_null() ? 1 : kProfileRepeats;
  const Job job = OpenScene(options.scene, outputs, options.quiet);
  const Peaks peaks = MeasurePeaks(job.plan.options.target, true);
  const InterruptGuard interrupt(kProfileInterruptText, job.settings.threads);
  const Measurements measured = Measure(options, job, interrupt.stop());
  const RunResult& first = measured.results.front();
  const ProfileReport report = MakeProfileReport(measured.results, peaks);
  if (options.json != "-") {
    Print(ProfileText(report, job, first, options.scene.scene, options.verbose));
  }
  bool good = SaveTrace(options, job, first);
  const nlohmann::json json = ToJson(report, job, first);
  int code = kExitGood;
  ProfilePageInput page = {std::filesystem::path(options.scene.scene).filename(),
                           ProfileAnswer(report, job, first), measured.tasks,
                           *measured.film, first};
  if (!before.is_null()) {
    page.against = std::filesystem::path(options.against).filename();
    page.comparison = FromJsonOf(options.against, [&] {
      return CompareProfiles(before, json, options.tolerance);
    });
    page.verdict = VerdictText(page.comparison, options.tolerance);
    code = PrintComparison(options, page.comparison);
  }
  if (!options.html.empty()) good &= SaveOrPrint(options.html, ProfilePage(json, page));
  if (!options.json.empty()) good &= SaveOrPrint(options.json, DumpJson(json, 2) + "\n");
  if (!options.csv.empty()) good &= SaveOrPrint(options.csv, ProfileCsv(json));
  return good ? code : kExitBadInput;
}

void AddProfileOptions(CLI::App& command, ProfileCommandOptions& options) {
  AddSettings(command, kAmountFlag, options.scene.settings);
  // The same default as for `render`, so that the profile is of the same program.
  options.scene.settings.decision = DefaultDecision::kIfLong;
  AddOption(command, "--repeat N", options.repeats,
            WithDefault("Renders to measure; times are medians, with 95 % intervals from "
                        "6 renders on",
                        "1, with --against 6"))
      ->transform(ValueFrom(1, 1000));
  AddOption(command, "--json FILE", options.json,
            "Write the profile as JSON ('-': print it)");
  AddOption(command, "--csv FILE", options.csv, "Write one line per stage");
  AddOption(command, "--html FILE", options.html,
            "Write an HTML page with plots of the profile, and of its differences from "
            "--against")
      ->check(EndsIn(".html"));
  AddOption(command, "--trace FILE", options.trace,
            "Write every stage call as a trace for ui.perfetto.dev")
      ->check([](const std::string& path) {
        return path == "-" ? std::string("a trace goes to a file, not to '-'") : "";
      });
  AddOption(command, "--trace-events N", options.trace_events,
            WithDefault("Maximum number of stage calls that a thread records for --trace "
                        "and --html",
                        options.trace_events))
      ->transform(ValueFrom(std::size_t{1}, std::size_t{1} << 26));
  AddOption(
      command, "--against FILE", options.against,
      "Compare with this JSON of an earlier profile, stage by stage, by processor time; "
      "exit with 9 if one is significantly slower, with 10 if they cannot be compared");
  AddOption(command, "--tolerance X", options.tolerance,
            WithDefault("Fraction by which a stage may be slower", options.tolerance))
      ->transform(ValueFrom(0.0, 1.0));
  command.add_flag("-v,--verbose", options.verbose,
                   "Print all stages and columns, bounces, materials and the machine");
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
      "  lanelight profile scene.pbrt --spp 4 --trace trace.json -v\n"
      "  lanelight profile scene.pbrt --repeat 10 --json before.json\n"
      "  lanelight profile scene.pbrt --repeat 10 --against before.json --html p.html");
  command->callback([options, &chosen] {
    CheckAmountOptions(options->scene.settings);
    chosen = [options] { return Profile(*options); };
  });
}

}  // namespace lanelight
