// `lanelight stress [CASE...]`: takes the renderer to its limits and says where they are.
#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include "kernels/simd/target.h"
#include "src/base/core/json_text.h"
#include "src/cli/commands.h"
#include "src/cli/console.h"
#include "src/cli/exit_codes.h"
#include "src/cli/interrupt.h"
#include "src/cli/options.h"
#include "src/cli/progress.h"
#include "src/cli/render_outputs.h"
#include "src/cli/texts.h"
#include "src/measure/stress/cases/cases.h"
#include "src/measure/stress/select.h"
#include "src/measure/stress/stress_json.h"
#include "src/measure/stress/suite.h"

namespace lanelight {
namespace {

struct StressCommandOptions {
  std::vector<std::string> words, targets;
  stress::SuiteOptions suite;
  std::string out, json;
  RenderSettings settings;  // its seed and threads
  bool list = false, quiet = false;
};

constexpr const char* kStressInterruptText =
    "\nstopping: finishing the current point, then writing the results so far (press "
    "Ctrl-C again to abort)\n";

std::vector<stress::Case> Selected(const StressCommandOptions& options) {
  try {
    return stress::SelectCases(stress::AllCases(), options.words);
  } catch (const InputError& error) {
    throw CLI::ValidationError("CASE", error.message());
  }
}

std::vector<std::string> TargetsOf(const std::vector<std::string>& words) {
  const bool all = std::ranges::find(words, "all") != words.end();
  return all ? AvailableTargets() : words;
}

// "3 of 40  sizes unit of length 1e-15 (AVX2)"
WorkStep StepOf(const stress::SuiteProgress& p) {
  std::string where = " (" + p.target + ")";
  if (std::isfinite(p.parameter)) {
    where = fmt::format(" {} {:g}{}", p.now->axis.name, p.parameter, where);
  }
  return {double(p.done) / double(p.total), p.now->name, 0,
          fmt::format("{} of {}  {}", p.done + 1, p.total, p.now->name), where};
}

stress::SuiteResult Measure(const std::vector<stress::Case>& cases,
                            const StressCommandOptions& options) {
  WorkProgress progress(ChooseProgressStyle(options.quiet), "stress: ");
  const InterruptGuard interrupt(kStressInterruptText, options.settings.threads);
  stress::SuiteHooks hooks;
  hooks.on_progress = [&](const stress::SuiteProgress& p) { progress.Update(StepOf(p)); };
  hooks.stop = &interrupt.stop();
  stress::SuiteResult result = stress::RunSuite(cases, options.suite, hooks);
  progress.Finish();
  return result;
}

bool Save(const stress::SuiteResult& result, const StressCommandOptions& options) {
  if (!options.out.empty()) stress::WriteResults(result, options.out);
  if (options.json.empty()) return true;
  return SaveOrPrint(options.json, DumpJson(stress::ToJson(result), 1) + "\n");
}

int RunStressCommand(StressCommandOptions& options) {
  const std::vector<stress::Case> cases = Selected(options);
  if (options.list) {
    Print(StressList(cases));
    return kExitGood;
  }
  OutputPaths outputs = {{options.json}};
  if (!options.out.empty()) {
    stress::MakeResultsFolder(options.out);
    outputs.files.insert(outputs.files.end(),
                         {options.out + "/stress.json", options.out + "/report.html"});
  }
  CheckOutputPaths(outputs, {});
  options.suite.targets = TargetsOf(options.targets);
  options.suite.threads = options.settings.threads;
  options.suite.effort.seed = *options.settings.seed;
  const stress::SuiteResult result = Measure(cases, options);
  if (options.json != "-") Print(StressTable(result));
  if (!Save(result, options)) return kExitBadInput;
  if (!options.out.empty() && !options.quiet && options.json != "-") {
    Print(options.out + "/stress.json, " + options.out + "/report.html\n");
  }
  return ExitCodeOf(result);
}

void AddStressOptions(CLI::App& command, StressCommandOptions& options) {
  AddOption(command, "CASE TEXT", options.words,
            WithDefault("Cases, groups, or patterns of them ('ggx-*')", "all"));
  command.add_flag("--list", options.list,
                   "Print all cases with their parameter and expected result");
  command.add_flag("--full", options.suite.effort.full,
                   "Measure all values of each map, with more samples (slow)");
  AddOption(command, "--out DIR", options.out, "Write stress.json and report.html there");
  AddOption(command, "--json FILE", options.json, "Write stress.json ('-': print it)");
  CLI::Validator target = ValueOf(TargetType(AvailableTargets()));
  AddOption(command, "--simd NAME", options.targets,
            WithDefault("SIMD targets (see `lanelight info`), or all of this machine",
                        "the best available"))
      ->transform(CLI::Validator(
          [target](std::string& text) {
            return text == "all" ? std::string() : target(text);
          },
          ""))
      ->delimiter(',');
  options.settings.seed = options.suite.effort.seed;
  AddSetting(command, "seed", options.settings);
  AddSetting(command, "threads", options.settings);
  command.add_flag("--quiet", options.quiet, "No progress");
}

}  // namespace

void AddStressCommand(CLI::App& root, Command& chosen) {
  CLI::App* command =
      root.add_subcommand("stress", "Measure the numerical limits of the renderer");
  auto options = std::make_shared<StressCommandOptions>();
  AddStressOptions(*command, *options);
  command->footer(
      "\nPrints a row per case: for the point of the supported range nearest to "
      "failing,\nthe expected value, the measured value with its interval, and by how "
      "many standard\nerrors (z) it exceeds its tolerance; then the first failure "
      "outside the supported\nrange (docs/stress.md). Ctrl-C finishes the current point "
      "and prints the "
      "results\n"
      "so far. Exit code 7: a case failed.\n"
      "\nExamples:\n"
      "  lanelight stress\n"
      "  lanelight stress 'ggx-*' lights --simd all --out stress\n"
      "  lanelight stress --full --out stress-full");
  command->callback(
      [options, &chosen] { chosen = [options] { return RunStressCommand(*options); }; });
}

}  // namespace lanelight
