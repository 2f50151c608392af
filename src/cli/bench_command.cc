// `lanelight bench [SCENE...]`: how fast this machine renders, and whether another
// program or machine is faster.
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "kernels/simd/target.h"
#include "src/base/core/json_text.h"
#include "src/base/core/parallel.h"
#include "src/cli/commands.h"
#include "src/cli/console.h"
#include "src/cli/exit_codes.h"
#include "src/cli/interrupt.h"
#include "src/cli/options.h"
#include "src/cli/render_outputs.h"
#include "src/measure/report/page.h"
#include "src/measure/throughput/throughput.h"
#include "src/measure/throughput/throughput_comparison.h"
#include "src/render/job/saving.h"

namespace lanelight {
namespace {

struct BenchCommandOptions {
  ThroughputOptions bench;
  std::string json, csv, markdown, html, against, folder;
  double tolerance = kTolerance;
  bool all_targets = false, quiet = false, list = false, measure = true;
  bool has_time = false;  // --time is given
};

void Complete(BenchCommandOptions& options) {
  ThroughputOptions& bench = options.bench;
  if (bench.scenes.empty()) {
    for (const BenchScene& scene : BenchScenes()) bench.scenes.push_back(scene.name);
  }
  if (options.all_targets) bench.targets = AvailableTargets();
  if (bench.targets.empty()) bench.targets = {SimdTarget().name()};
  if (bench.threads.empty()) {
    bench.threads = {1};
    if (MaxThreads() > 1) bench.threads.push_back(MaxThreads());
  }
}

// Refuses a --time that is too short for the work, which is fixed so that results can be
// compared.
bool IsTooShort(const BenchCommandOptions& options, const BenchProgress& p) {
  if (!options.has_time || p.scene > 0 || p.minimum <= options.bench.seconds) {
    return false;
  }
  constexpr double kMargin = 1.2;  // renders of the next run may be slower
  PrintError(fmt::format(
      "error: --time is too short: {} renders of each row take about {:.0f} s on this "
      "machine; use --time {:.0f}, fewer --threads, or fewer samples with --spp (then "
      "rates cannot be compared with stored results)",
      kMinRepeats, std::ceil(p.minimum), std::ceil(kMargin * p.minimum)));
  return true;
}

void PrintBenchProgress(const BenchCommandOptions& options, const BenchProgress& p) {
  const std::vector<std::string>& scenes = options.bench.scenes;
  PrintError(fmt::format("measuring {} ({} of {}), {} left", scenes[p.scene], p.scene + 1,
                         scenes.size(),
                         p.maximum < 1.2 * p.minimum + 1
                             ? fmt::format("about {:.0f} s", std::ceil(p.maximum))
                             : fmt::format("{:.0f} to {:.0f} s", p.minimum, p.maximum)));
}

// Returns nothing if --time is too short.
std::optional<std::vector<ThroughputRow>> MeasureRows(
    const BenchCommandOptions& options) {
  const InterruptGuard interrupt(
      "\nstopping: what was measured so far is printed (press Ctrl-C again to abort)\n");
  bool is_too_short = false;
  auto rows =
      MeasureThroughput(options.bench, interrupt.stop(), [&](const BenchProgress& p) {
        is_too_short = IsTooShort(options, p);
        if (!is_too_short && !options.quiet) PrintBenchProgress(options, p);
        return !is_too_short;
      });
  if (is_too_short) return std::nullopt;
  return rows;
}

// Returns the results that --list prints, that of --against first.
std::vector<KnownThroughput> Listed(const BenchCommandOptions& options,
                                    const std::optional<KnownThroughput>& before) {
  if (!options.list) return {};
  std::vector<KnownThroughput> results = ListedResults(options.folder);
  if (!before) return results;
  std::erase_if(results, [&](const auto& known) { return known.name == before->name; });
  results.insert(results.begin(), *before);
  return results;
}

int Bench(BenchCommandOptions options) {
  Complete(options);
  const OutputPaths outputs = {
      {options.json, options.csv, options.markdown, options.html}};
  CheckOutputPaths(outputs, {options.against});
  std::optional<KnownThroughput> before;
  if (!options.against.empty()) before = ReadThroughput(options.against);
  const std::size_t columns = TerminalColumns(Stream::kOutput);
  std::vector<KnownThroughput> listed = Listed(options, before);
  if (!options.measure) {
    Print(ListText(listed, 0, columns));
    return kExitGood;
  }
  const std::optional<std::vector<ThroughputRow>> measured = MeasureRows(options);
  if (!measured) return kExitUsage;
  const std::vector<ThroughputRow>& rows = *measured;
  const nlohmann::json json = ToJson(rows, options.bench.within);
  if (options.json != "-") {
    Print(ThroughputText(rows, options.bench.within, {false, columns}));
  }
  bool success = true;
  const auto save = [&](const std::string& path, const std::string& text) {
    if (!path.empty()) success &= SaveOrPrint(path, text);
  };
  save(options.json, DumpJson(json, 1) + "\n");
  save(options.csv, ThroughputCsv(rows));
  save(options.markdown, ThroughputText(rows, options.bench.within, {true}));
  if (!options.html.empty()) save(options.html, ReportPage(PageKind::kBench, json));
  if (!success) return kExitBadInput;
  KnownThroughput now = ThroughputFromJson(json);
  now.name = "this run";
  if (options.list && options.json != "-") {
    listed.insert(listed.begin(), now);
    Print("\n" + ListText(listed, 1, columns));
  }
  if (!before) return kExitGood;
  const RateComparison comparison = CompareRates(*before, now);
  if (options.json != "-") {
    Print("\n" + ComparisonText(comparison, *before, options.tolerance, columns));
  }
  switch (comparison.Judge(options.tolerance)) {
    case RateComparison::Verdict::kNotSlower:
      return kExitGood;
    case RateComparison::Verdict::kSlower:
      return kExitSlower;
    case RateComparison::Verdict::kNotComparable:
      break;
  }
  return kExitNotComparable;
}

void AddBenchOptions(CLI::App& command, BenchCommandOptions& options) {
  ThroughputOptions& bench = options.bench;
  AddOption(command, "SCENE", bench.scenes, "Scene files; default: five built-in scenes");
  AddSetting(command, "resolution", bench.settings);
  AddSetting(command, "crop", bench.settings);
  AddSetting(command, "spp", bench.settings)
      ->description(WithDefault(
          "Samples per pixel of a render",
          fmt::format("fixed for each built-in scene, {} for scene files", kFileSpp)));
  AddSetting(command, "strategy", bench.settings);
  AddSetting(command, "sampler", bench.settings);
  AddOption(command, "--threads T,...", bench.threads,
            WithDefault("Numbers of threads, one row each", "1, and all cores"))
      ->delimiter(',')
      ->transform(ValueFrom(1, kMaxThreads));
  CLI::Option* targets =
      AddOption(command, "--simd NAME,...", bench.targets,
                WithDefault("SIMD targets, one row each", "the best available"))
          ->delimiter(',')
          ->transform(ValueOf(TargetType(AvailableTargets())));
  command.add_flag("--all-targets", options.all_targets, "Measure all SIMD targets")
      ->excludes(targets);
  AddOption(command, "--within X", bench.within,
            WithDefault("Repeat until each median's interval is within this fraction",
                        bench.within))
      ->transform(ValueFrom(1e-4, 1.0));
  AddOption(command, "--time TIME", bench.seconds,
            WithDefault("Maximum wall time of all rows together; six renders of each row "
                        "have to fit, which take about 40 s for the built-in scenes",
                        bench.seconds))
      ->transform(ValueOf(SecondsType{0.01, 1e6}));
}

void AddBenchOutputs(CLI::App& command, BenchCommandOptions& options) {
  AddOption(command, "--json FILE", options.json,
            "Write all numbers as JSON ('-': print it)");
  AddOption(command, "--csv FILE", options.csv, "Write one line per row");
  AddOption(command, "--markdown FILE", options.markdown, "Write the tables in Markdown");
  AddOption(command, "--html FILE", options.html,
            "Write an HTML page with plots of all rows")
      ->check(EndsIn(".html"));
  AddOption(command, "--against FILE", options.against,
            "Compare with this JSON of an earlier run and print all ratios; exit with 9 "
            "if a row is significantly slower, with 10 if they cannot be compared");
  AddOption(command, "--tolerance X", options.tolerance,
            WithDefault("Fraction by which a row may be slower", options.tolerance))
      ->transform(ValueFrom(0.0, 1.0));
  AddOption(command, "--list [DIR|FILE]", options.folder,
            "Print stored results beside each other, or those in DIR, or FILE beside the "
            "stored ones; measure only if scenes or other "
            "options are given; default: the results in the program")
      ->expected(0, 1);
  command.add_flag("--quiet", options.quiet, "No progress");
}

}  // namespace

void AddBenchCommand(CLI::App& root, Command& chosen) {
  CLI::App* command = root.add_subcommand(
      "bench", "Measure how many samples and rays this machine renders per second");
  auto options = std::make_shared<BenchCommandOptions>();
  AddBenchOptions(*command, *options);
  AddBenchOutputs(*command, *options);
  command->footer(
      "\nRows are measured in turns, so a slow phase of the machine affects all rows.\n"
      "docs/bench.md says what the columns mean, and which scenes these are.\n"
      "\nExamples:\n"
      "  lanelight bench --json today.json --html today.html\n"
      "  lanelight bench --against yesterday.json --tolerance 0.05\n"
      "  lanelight bench --list\n"
      "  lanelight bench scene.pbrt --threads 1,2,4,8 --all-targets");
  command->callback([command, options, &chosen] {
    options->list = command->count("--list") > 0;
    options->has_time = command->count("--time") > 0;
    options->measure = !options->list;
    for (const CLI::Option* option : command->get_options()) {
      const std::string name = option->get_name();
      options->measure |= option->count() > 0 && name != "--list" && name != "--against";
    }
    chosen = [options] { return Bench(*options); };
  });
}

}  // namespace lanelight
