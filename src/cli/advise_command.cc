// `lanelight advise SCENE --time S`: which strategy pays on this scene, and the render
// with it.
#include <memory>
#include <nlohmann/json.hpp>

#include "src/base/core/json_text.h"
#include "src/base/core/text_layout.h"
#include "src/base/stat/values.h"
#include "src/cli/commands.h"
#include "src/cli/console.h"
#include "src/cli/exit_codes.h"
#include "src/cli/interrupt.h"
#include "src/cli/options.h"
#include "src/cli/progress.h"
#include "src/cli/render_outputs.h"
#include "src/measure/advise/advise.h"
#include "src/render/job/machine_json.h"
#include "src/render/job/report.h"

namespace lanelight {
namespace {

struct AdviseCommandOptions {
  SceneOptions scene;
  RenderOutputs outputs;
  double pilot = 0;  // seconds; 0: a share of the time
};

// "skipped    a, b: the trial ran out of time; --pilot 2 would".
std::string SkippedText(const Advice& advice) {
  std::string skipped;
  for (const AdvisedCandidate& c : advice.candidates) {
    if (c.status != CandidateStatus::kSkipped) continue;
    skipped += (skipped.empty() ? "" : ", ") + c.changes;
  }
  if (skipped.empty()) return "";
  return SummaryRow("skipped",
                    fmt::format("{}: {}; use --pilot {:.2g}s to try all", skipped,
                                advice.interrupted ? "the trial was interrupted"
                                                   : "the trial ran out of time",
                                advice.seconds_to_try));
}

std::string AdviceText(const Advice& advice) {
  std::vector<std::vector<std::string>> lines = {
      {"change", "efficiency (90 %)", "status", "reason"}};
  for (const AdvisedCandidate& c : advice.candidates) {
    if (c.status == CandidateStatus::kSkipped) continue;
    const std::string changes = c.changes.empty()           ? "(the default)"
                                : c.meaning == kOwnStrategy ? "(the scene's own)"
                                                            : c.changes;
    const std::string efficiency = c.samples == 0 ? ""
                                   : IsUncertain(c.efficiency)
                                       ? "too few samples"
                                       : EstimateText(c.efficiency);
    lines.push_back({changes, efficiency, Name(c.status), c.reason});
  }
  return TextTable(lines, {TerminalColumns(Stream::kOutput), 1, 3}) + "\n" +
         SkippedText(advice) + SummaryRow("tried", kTriedByAdvice) +
         SummaryRow("advice", advice.why) +
         SummaryRow("strategy", ToText(advice.chosen)) +
         SummaryRow("trial", fmt::format("{}, {}rays", DurationText(advice.pilot_seconds),
                                         CountText(double(advice.rays))));
}

// The command that renders as the advice says.
std::string RenderCommand(const AdviseCommandOptions& options, const Advice& advice) {
  RenderSettings settings = options.scene.settings;
  settings.sampler.reset();  // which the strategy says
  settings.strategy.text = ToText(advice.chosen);
  return fmt::format("lanelight render {} -o FILE.exr{}", ShellWord(options.scene.scene),
                     FlagsText(settings));
}

int PrintAdvice(const AdviseCommandOptions& options, const Advice& advice) {
  if (!options.outputs.quiet && options.outputs.targets.json != "-") {
    Print(AdviceText(advice) + "render     " + RenderCommand(options, advice) + "\n");
  }
  const nlohmann::json report = {{"schema", kReportSchema},
                                 {"scene", options.scene.scene},
                                 {"machine", ToJson(ThisMachine())},
                                 {"advice", ToJson(advice)}};
  const std::string& json = options.outputs.targets.json;
  if (json.empty()) return kExitGood;
  return SaveOrPrint(json, DumpJson(report, 2) + "\n") ? kExitGood : kExitBadInput;
}

int RunAdvise(const AdviseCommandOptions& options) {
  const RenderTargets& targets = options.outputs.targets;
  const Job job = OpenScene(options.scene, {{targets.exr, targets.png, targets.json}},
                            options.outputs.quiet);
  const InterruptGuard interrupt(kStoppingMessage, job.settings.threads);
  AdviceOptions advise;
  advise.seconds = *options.scene.settings.seconds;
  advise.pilot = options.pilot;
  if (advise.pilot > advise.seconds) {
    throw InputError(fmt::format(
        "--pilot: {} is longer than --time {}, which is for trial and render together",
        DurationText(advise.pilot), DurationText(advise.seconds)));
  }
  advise.stop = &interrupt.stop();
  const Advice advice = Advise(job, advise);
  if (options.outputs.targets.exr.empty()) return PrintAdvice(options, advice);
  ProgressPrinter progress(ChooseProgressStyle(options.outputs.quiet));
  RenderHooks hooks = PrintingHooks(progress, interrupt.stop());
  hooks.members = {{"advice", ToJson(advice)}};
  const Job advised = WithAdvice(job, advice, advise);
  const Rendering rendering =
      RenderToFiles(advised, options.scene.scene, options.outputs.targets, hooks);
  return PrintRendering(rendering, advised, options.outputs, AdviceText(advice) + "\n");
}

}  // namespace

void AddAdviseCommand(CLI::App& root, Command& chosen) {
  CLI::App* command = root.add_subcommand(
      "advise", "Find the most efficient strategy, and render with it");
  auto options = std::make_shared<AdviseCommandOptions>();
  AddSetting(*command, "time", options->scene.settings)
      ->required()
      ->description("Wall time for trial and render together: 90 (seconds), 5m");
  AddOption(*command, "--pilot TIME", options->pilot,
            "Time of the trial of strategies, of 8 million rays each; default: 3 "
            "% of --time")
      ->transform(ValueOf(SecondsType{1e-3, 1e9}));
  AddSetting(*command, "seed", options->scene.settings);
  AddOutputOptions(*command, options->outputs, options->scene.settings);
  AddSceneOptions(*command, options->scene);
  command->footer(
      "\nTries the scene's own strategy (or --strategy), and changes of the default in\n"
      "roulette, light selection and path reuse; not samplers or other keys,\n"
      "which `lanelight study` compares. All are tried on the same pixels and "
      "compared\nby variance times counted work, so the advice is reproducible for a "
      "scene, its\nsettings and --seed. A change is advised only if\n"
      "it is significantly better in the trial (95 %); the printed intervals are wider,\n"
      "since they include the uncertainty of costs and of the pixels that were not "
      "tried. Without "
      "-o the\ncommand prints the advice and renders no image.\n"
      "\nExamples:\n"
      "  lanelight advise scene.pbrt --time 60\n"
      "  lanelight advise scene.pbrt --time 60 -o out.exr --json advice.json");
  command->callback([options, &chosen] {
    if (options->outputs.targets.exr.empty() && options->outputs.png_flag->count() > 0) {
      throw CLI::ValidationError("--png", "needs an image: name it with -o FILE.exr");
    }
    ResolveOutputs(options->outputs, options->scene.settings);
    chosen = [options] { return RunAdvise(*options); };
  });
}

}  // namespace lanelight
