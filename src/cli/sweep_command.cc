// `lanelight sweep SWEEP.toml --out DIR`: a grid of renders, filled by any number of
// processes.
#include <map>
#include <memory>

#include "src/base/core/text_layout.h"
#include "src/cli/commands.h"
#include "src/cli/console.h"
#include "src/cli/exit_codes.h"
#include "src/cli/interrupt.h"
#include "src/cli/options.h"
#include "src/cli/progress.h"
#include "src/measure/sweep/budget.h"
#include "src/measure/sweep/runner.h"
#include "src/render/job/setting.h"

namespace lanelight {
namespace {

struct SweepCommandOptions {
  std::string file, part, budget;
  RenderSettings settings;  // its trees
  SweepOptions sweep;
  bool dry_run = false, quiet = false;
  int pilots = 24;
};

// A line for each message; sweep.csv has them all.
void PrintFailures(const std::vector<CellFailure>& failures) {
  std::vector<std::pair<CellFailure, std::size_t>> lines;  // the first, how many
  std::map<std::string, std::size_t> line_of;
  for (const CellFailure& failure : failures) {
    const auto [entry, is_new] = line_of.try_emplace(failure.message, lines.size());
    if (is_new) lines.emplace_back(failure, 0);
    ++lines[entry->second].second;
  }
  for (const auto& [failure, count] : lines) {
    const std::string more = count > 1 ? fmt::format(" and {} more", count - 1) : "";
    PrintError("failed: " + failure.name + more + ": " + failure.message);
  }
}

void PrintOutcome(const SweepOutcome& o, const SweepOptions& options) {
  PrintFailures(o.failures);
  if (!o.other_cells.empty()) {
    PrintError(
        fmt::format("note: {} directories in {}/cells, e.g. {}, are not part of this "
                    "sweep; they are kept and excluded from the table",
                    o.other_cells.size(), options.out, o.other_cells.front()));
  }
  if (o.without_target > 0) {
    PrintError(
        fmt::format("note: {} cells need SIMD targets that this machine lacks; run the "
                    "sweep on a machine that has them",
                    o.without_target));
  }
  if (o.differing > 0) {
    PrintError(
        fmt::format("warning: the images of {} cells differ from their scene files (see "
                    "the notes in their reports)",
                    o.differing));
  }
  if (o.invalid_samples > 0) {
    PrintError(fmt::format("error: {} samples were invalid and count as zero",
                           o.invalid_samples));
  }
}

void PrintSummary(const SweepOutcome& o, const SweepOptions& options) {
  std::string text = fmt::format("{} of {} cells are done, {} of them by this process",
                                 o.done, o.total, o.rendered);
  if (o.stopped > 0) text += fmt::format("; {} were not needed", o.stopped);
  const std::size_t missing = o.total - o.done - o.stopped - o.failures.size();
  if (missing > 0) text += fmt::format("; {} are missing", missing);
  if (o.elsewhere > 0) text += fmt::format(", {} with other processes", o.elsewhere);
  text += fmt::format("; {} of processor time", DurationText(o.cpu_seconds));
  Print(fmt::format("{0}{1}\n{2}/sweep.csv, {2}/sweep.json, {2}/report.html\n", o.answer,
                    text, options.out));
}

int PrintPlannedCells(const Sweep& sweep, SweepCommandOptions& options) {
  const InterruptGuard interrupt("\nstopping\n");
  Print(PredictionText(
      sweep, Predict(sweep, options.sweep.out, options.pilots, interrupt.stop())));
  return interrupt.stop() ? kExitInterrupted : kExitGood;
}

WorkStep StepOf(const SweepProgress& p) {
  return {(double(p.done) + p.render.fraction) / double(p.total), p.cell->name, 0,
          fmt::format("{} of {}  {}", p.done + 1, p.total, p.cell->name),
          ProgressPrinter::Describe({p.render, {}, {}}, kDescribeAll)};
}

// Gives the cells their times, and tells the user.
void UseBudget(const SweepCommandOptions& options, Sweep& sweep) {
  RenderSettings settings;
  SettingNamed("time").read(settings, options.budget);
  const double seconds = *settings.seconds;
  const BudgetPlan plan =
      PlanBudget(sweep, seconds, options.sweep.part, options.sweep.out);
  if (!options.quiet) Print(BudgetText(plan, seconds) + "\n");
}

int RunSweepCommand(SweepCommandOptions& options) {
  Sweep sweep = ReadSweep(options.file);
  if (!options.budget.empty()) UseBudget(options, sweep);
  if (options.dry_run) return PrintPlannedCells(sweep, options);
  WorkProgress progress(ChooseProgressStyle(options.quiet), "sweep: ");
  const InterruptGuard interrupt(
      "\nstopping: the current cell is discarded; the same command renders it again "
      "(press Ctrl-C again to abort)\n");
  SweepHooks hooks;
  hooks.on_progress = [&](const SweepProgress& p) { progress.Update(StepOf(p)); };
  hooks.on_problem = [&](const std::string& text) { progress.PrintMessage(text); };
  hooks.stop = &interrupt.stop();
  const SweepOutcome outcome = RunSweep(sweep, options.sweep, hooks);
  progress.Finish();
  PrintOutcome(outcome, options.sweep);
  if (!options.quiet) PrintSummary(outcome, options.sweep);
  if (outcome.interrupted) return kExitInterrupted;
  if (!outcome.failures.empty()) return kExitBadInput;
  return outcome.invalid_samples > 0 ? kExitInvalidSamples : kExitGood;
}

void AddSharingOptions(CLI::App& command, SweepCommandOptions& options) {
  AddOption(command, "--part I/N", options.part,
            "Render only every N-th cell, starting at the I-th; processes with different "
            "parts need no locks");
  command.add_flag(
      "--wait", options.sweep.wait,
      "Wait for cells of other processes, and render them if those processes die");
  AddOption(command, "--budget TIME", options.budget,
            "Give all cells the same time, so that one process takes TIME (7200, 2h); "
            "default: the amounts of the grid");
  command.add_flag("--race", options.sweep.race,
                   "Render seed by seed; stop strategies that are clearly less efficient "
                   "than the best, "
                   "and all where more seeds would hardly decide");
  command.add_flag_callback("--resume", [] {}, "Skip finished cells (always on)");
}

}  // namespace

void AddSweepCommand(CLI::App& root, Command& chosen) {
  CLI::App* command =
      root.add_subcommand("sweep", "Render a grid of scenes, strategies and settings");
  auto options = std::make_shared<SweepCommandOptions>();
  AddOption(*command, "SWEEP", options->file, "The grid, a TOML file (docs/sweep.md)")
      ->required();
  AddOption(*command, "--out DIR", options->sweep.out, "Directory of the cells")
      ->required();
  AddSharingOptions(*command, *options);
  CLI::Option* dry =
      command->add_flag("--dry-run", options->dry_run,
                        "Print the cells with predicted time and space, and render none");
  AddOption(
      *command, "--pilots N", options->pilots,
      WithDefault(
          "Maximum number of short renders for the prediction of --dry-run; 0: no times",
          options->pilots))
      ->transform(ValueFrom(0, 100000))
      ->needs(dry);
  command
      ->add_flag("--table-only", options->sweep.table_only,
                 "Write table and page of the finished cells, without rendering")
      ->excludes(dry);
  command->add_flag("--quiet", options->quiet, "Print errors and warnings only");
  command->footer(
      "\nWrites DIR/cells/NAME/image.exr and report.json of every cell, DIR/sweep.csv,\n"
      "DIR/sweep.json and DIR/report.html. Start the same command as often as you like,\n"
      "on any machines that share DIR: each cell is rendered by one process. If a "
      "process\n"
      "dies, others render its cells. Exit code 6: interrupted; start it again.\n"
      "\nExamples:\n"
      "  lanelight sweep sweep.toml --out out --dry-run\n"
      "  lanelight sweep sweep.toml --out out\n"
      "  lanelight sweep sweep.toml --out out --part 2/5");
  command->callback([options, &chosen] {
    if (!options->part.empty()) options->sweep.part = ParsePart(options->part);
    chosen = [options] { return RunSweepCommand(*options); };
  });
}

}  // namespace lanelight
