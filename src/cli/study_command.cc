// `lanelight study SCENE... --out DIR`: which strategy gives the least error for the
// time.
#include <cmath>
#include <memory>

#include "src/base/core/error.h"
#include "src/cli/commands.h"
#include "src/cli/console.h"
#include "src/cli/exit_codes.h"
#include "src/cli/interrupt.h"
#include "src/cli/options.h"
#include "src/cli/progress.h"
#include "src/cli/texts.h"
#include "src/measure/study/study.h"

namespace lanelight {
namespace {

struct StudyCommandOptions {
  StudyOptions study;
  bool quiet = false;
};

void CheckCombination(const StudyOptions& study) {
  if (study.scenes.size() > 1 && study.paper) {
    throw CLI::ValidationError("--paper", "works with one scene only");
  }
  if (study.scenes.size() > 1 && !study.references.empty()) {
    throw CLI::ValidationError("--reference", "works with one scene only");
  }
  try {
    StudyStrategies(study, {});
  } catch (const InputError& error) {
    throw CLI::ValidationError("--strategies", error.message());
  }
}

// " 37 %  cornell-box: mis, 64 spp, repetition 3  2 min 03 s left"; a line for each
// twentieth.
WorkStep StepOf(const StudyProgress& p) {
  std::string text =
      fmt::format("{:3.0f} %  {}: {}", std::floor(100 * p.fraction), p.scene, p.what);
  if (p.fraction > 0.01) text += fmt::format("  {} left", DurationText(p.seconds_left));
  return {p.fraction, p.scene, int(20 * p.fraction), text};
}

int RunStudyCommand(StudyCommandOptions& options) {
  CheckCombination(options.study);
  WorkProgress progress(ChooseProgressStyle(options.quiet), "study ");
  const InterruptGuard interrupt(
      "\nstopping: the report covers the finished renders; --resume continues (press "
      "Ctrl-C again to abort)\n",
      options.study.settings.threads);
  StudyHooks hooks;
  hooks.on_progress = [&](const StudyProgress& p) { progress.Update(StepOf(p)); };
  hooks.on_problem = [&](const std::string& text) { progress.PrintMessage(text); };
  hooks.stop = &interrupt.stop();
  const std::vector<SceneStudy> studies = Study(options.study, hooks);
  progress.Finish();

  bool good = true, interrupted = false;
  for (const SceneStudy& study : studies) {
    if (!options.quiet) Print(StudySummary(study, options.study));
    good &= study.runs.error.empty();
    interrupted |= study.runs.interrupted;
    for (const StrategyRuns& s : study.runs.strategies) {
      good &= s.status != RunStatus::kFailed;
    }
  }
  if (!options.quiet) {
    Print(fmt::format("\n{0}/report.html, {0}/study.json, {0}/study.csv\n",
                      options.study.out));
  }
  if (interrupted) return kExitInterrupted;
  return good ? kExitGood : kExitBadInput;
}

// The same type as the flag of `render`.
constexpr PercentErrorType kTargetInPercent{1e-4, 1e8};

void AddMeasureOptions(CLI::App& command, StudyCommandOptions& options) {
  StudyOptions& s = options.study;
  CLI::Option* list =
      AddOption(command, "--strategies LIST", s.strategies,
                "'A;B;...': presets, key=value,... (changes of the default), "
                "'default', or 'scene' (its own); the first is the baseline; "
                "default: the paper's presets, 'default' and 'scene'")
          ->delimiter(';')
          ->allow_extra_args(false)
          ->transform(CLI::Validator(
              [](std::string& text) {
                CLI::detail::trim(text);
                return std::string();
              },
              ""));
  command.add_flag("--all", s.all_strategies, "All choices of all keys, and the presets")
      ->excludes(list);
  CLI::Option* spp =
      AddOption(command, "--spp N,...", s.spp,
                "Samples per pixel, e.g. 1,4,16,64; default: powers of two up to "
                "what the baseline renders in a second, and at least to 64 or to an "
                "error of 10 %")
          ->delimiter(',')
          ->transform(ValueOf(CountType{1, kMaxSpp}));
  AddOption(command, "--budget TIME", s.budget,
            "Render for equal wall times instead: each strategy takes as many samples as "
            "fit; results are compared by processor time")
      ->transform(ValueOf(SecondsType{1e-3, 1e6}))
      ->excludes(spp);
  AddOption(command, "--repetitions R", s.repetitions,
            "Independent renders per strategy and sample count; default: enough for "
            "--confidence")
      ->transform(ValueFrom(1, 10000));
  AddOption(command, "--confidence C", s.confidence,
            WithDefault("Confidence of all intervals", s.confidence))
      ->transform(ValueFrom(0.5, 0.9999));
  AddOption(command, "--reference FILE", s.references,
            "Converged image; several independent ones measure their own noise; "
            "default: rendered")
      ->allow_extra_args(false);
  CLI::Option* percent =
      command
          .add_option_function<std::string>(
              "--target",
              [&s](const std::string& text) {
                s.target_relmse = ReadValue(kTargetInPercent, text);
              },
              "Measure the time to this error (root of the relative MSE) in percent; 1% "
              "is "
              "--target-relmse 0.0001; default: what the baseline reaches")
          ->check(ValueOf(kTargetInPercent))
          ->type_name("X%");
  AddOption(command, "--target-relmse X", s.target_relmse,
            "Measure the time to this relative MSE; default: what the baseline "
            "reaches")
      ->transform(ValueFrom(1e-30, 1e30))
      ->excludes(percent);
}

}  // namespace

void AddStudyCommand(CLI::App& root, Command& chosen) {
  CLI::App* command = root.add_subcommand(
      "study", "Measure which sampling strategy is the most efficient");
  auto options = std::make_shared<StudyCommandOptions>();
  AddOption(*command, "SCENE", options->study.scenes, "Scene files")->required();
  AddOption(*command, "--out DIR", options->study.out, "Directory for report and data")
      ->required();
  AddMeasureOptions(*command, *options);
  command->add_flag("--resume", options->study.resume,
                    "Continue the study in DIR; finished renders are kept");
  command->add_flag("--paper", options->study.paper,
                    "Write DIR/index.html too: the founding paper's figures on one page");
  AddSettings(*command, kStudyFlag, options->study.settings);
  command->add_flag("--quiet", options->quiet, "No progress and no summary");
  command->footer(
      "\nWrites DIR/report.html, study.json, study.csv (docs/study.md) and EXR images.\n"
      "Ctrl-C reports what is finished; --resume continues from there.\n"
      "\nExamples:\n"
      "  lanelight study box.pbrt --out box --resolution 200x200\n"
      "  lanelight study a.pbrt b.pbrt --out ab --strategies 'default;points=halton'\n"
      "  lanelight study a.pbrt --out a --all --budget 2 --reference a1.exr");
  command->callback(
      [options, &chosen] { chosen = [options] { return RunStudyCommand(*options); }; });
}

}  // namespace lanelight
