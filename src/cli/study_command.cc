// `lanelight study SCENE... --out DIR`: which strategy gives the least error for the
// time.
#include <cmath>
#include <memory>

#include "src/base/core/error.h"
#include "src/cli/commands.h"
#include "src/cli/console.h"
#include "src/cli/defaults.h"
#include "src/cli/exit_codes.h"
#include "src/cli/interrupt.h"
#include "src/cli/scene_options.h"
#include "src/cli/study_summary.h"
#include "src/cli/validators.h"
#include "src/cli/work_progress.h"
#include "src/measure/study/study.h"

namespace lanelight {
namespace {

struct StudyCommandOptions {
  StudyOptions study;
  bool quiet = false;
};

void CheckCombination(const StudyOptions& study) {
  if (study.scenes.size() > 1 && study.paper) {
    throw CLI::ValidationError("--paper", "is a page of one scene only");
  }
  if (study.scenes.size() > 1 && !study.references.empty()) {
    throw CLI::ValidationError("--reference", "goes with one scene only");
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
  return {p.fraction, p.scene, static_cast<int>(20 * p.fraction), text};
}

int RunStudyCommand(StudyCommandOptions& options) {
  CheckCombination(options.study);
  WorkProgress progress(ChooseProgressStyle(options.quiet), "study ");
  const InterruptGuard interrupt(
      "\nstopping: the report will be of what is finished; --resume goes on (once more "
      "to "
      "abort)\n",
      options.study.settings.threads);
  StudyHooks hooks;
  hooks.on_progress = [&](const StudyProgress& p) { progress.Update(StepOf(p)); };
  hooks.on_problem = [&](const std::string& text) { progress.Say(text); };
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

// As the flag of a render is.
constexpr PercentErrorType kTargetInPercent{1e-4, 1e8};

void AddMeasureOptions(CLI::App& command, StudyCommandOptions& options) {
  StudyOptions& s = options.study;
  CLI::Option* list =
      command
          .add_option("--strategies", s.strategies,
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
              ""))
          ->type_name("LIST");
  command
      .add_flag("--all", s.all_strategies, "Every choice of every key, and the presets")
      ->excludes(list);
  CLI::Option* spp =
      command
          .add_option(
              "--spp", s.spp,
              "Samples per pixel, e.g. 1,4,16,64; default: powers of two up to "
              "what the baseline renders in a second, and at least to 64 or to an "
              "error of 10 %")
          ->delimiter(',')
          ->transform(ValueOf(CountType{1, kMaxSpp}))
          ->type_name("N,...");
  command
      .add_option(
          "--budget", s.budget,
          "Render for equal times instead, of the wall clock: each strategy takes "
          "up to so many samples as it can; compared by processor time")
      ->transform(ValueOf(SecondsType{1e-3, 1e6}))
      ->type_name("TIME")
      ->excludes(spp);
  command
      .add_option("--repetitions", s.repetitions,
                  "Independent renders of each; default: enough for the confidence")
      ->transform(ValueFrom(1, 10000))
      ->type_name("R");
  command
      .add_option("--confidence", s.confidence,
                  WithDefault("Of all intervals", s.confidence))
      ->transform(ValueFrom(0.5, 0.9999))
      ->type_name("C");
  command
      .add_option("--reference", s.references,
                  "Converged image; several independent ones measure their own noise; "
                  "default: rendered")
      ->allow_extra_args(false)
      ->type_name("FILE");
  CLI::Option* percent =
      command
          .add_option_function<std::string>(
              "--target",
              [&s](const std::string& text) {
                s.target_relmse = ReadValue(kTargetInPercent, text);
              },
              "The same as the root of the relative MSE in percent: 1% is 0.0001; "
              "default: what the baseline reaches")
          ->check(ValueOf(kTargetInPercent))
          ->type_name("X%");
  command
      .add_option("--target-relmse", s.target_relmse,
                  "Measure the time to this relative MSE; default: what the baseline "
                  "reaches")
      ->transform(ValueFrom(1e-30, 1e30))
      ->type_name("X")
      ->excludes(percent);
}

}  // namespace

void AddStudyCommand(CLI::App& root, Command& chosen) {
  CLI::App* command = root.add_subcommand(
      "study", "Measure which strategy gives the least error for the time");
  auto options = std::make_shared<StudyCommandOptions>();
  command->add_option("SCENE", options->study.scenes, "Scene files")
      ->required()
      ->type_name("");
  command->add_option("--out", options->study.out, "Directory for report and data")
      ->required()
      ->type_name("DIR");
  AddMeasureOptions(*command, *options);
  command->add_flag("--resume", options->study.resume,
                    "Continue the study in DIR; what is finished is not done again");
  command->add_flag("--paper", options->study.paper,
                    "Write DIR/index.html too: the founding paper's figures on one page");
  AddSettings(*command, kStudyFlag, options->study.settings);
  command->add_flag("--quiet", options->quiet, "Print errors only");
  command->footer(
      "\nWrites DIR/report.html, study.json, study.csv (docs/study.md) and EXR images.\n"
      "Ctrl-C reports what is finished; --resume goes on from there.\n"
      "\nExamples:\n"
      "  lanelight study box.pbrt --out box --resolution 200x200\n"
      "  lanelight study a.pbrt b.pbrt --out ab --strategies 'default;points=pmj02' "
      "--spp "
      "4,16,64\n"
      "  lanelight study a.pbrt --out a --all --budget 2 --reference a1.exr --reference "
      "a2.exr");
  command->callback(
      [options, &chosen] { chosen = [options] { return RunStudyCommand(*options); }; });
}

}  // namespace lanelight
