// `lanelight merge STATE... -o OUT.exr`: one image of the states of parts.
#include <memory>
#include <optional>

#include "src/base/core/error.h"
#include "src/base/core/json_text.h"
#include "src/base/core/parallel.h"
#include "src/cli/commands.h"
#include "src/cli/console.h"
#include "src/cli/exit_codes.h"
#include "src/cli/options.h"
#include "src/cli/render_outputs.h"
#include "src/cli/texts.h"
#include "src/render/job/checkpoint.h"
#include "src/render/job/machine_json.h"
#include "src/render/job/merge.h"
#include "src/render/job/render.h"
#include "src/render/job/saving.h"

namespace lanelight {
namespace {

struct MergeOptions {
  std::vector<std::string> states;
  RenderOutputs outputs;
  std::string state;  // to write
  bool partial = false;
  RenderSettings settings;  // of images, and threads
};

std::string MissingText(const MergedRender& merged) {
  return fmt::format("{} of {} pixels are in none of the states", merged.missing,
                     merged.window.pixels());
}

void CheckComplete(const MergedRender& merged, bool partial) {
  if (partial) return;
  if (merged.missing > 0) {
    throw InputError(MissingText(merged) +
                     ": add the missing parts, or use --partial for an incomplete image");
  }
  if (merged.minimum == merged.maximum) return;
  throw InputError(
      fmt::format("pixels have {} to {} samples, since parts were interrupted: resume "
                  "these, or use --partial for an incomplete image",
                  merged.minimum, merged.maximum));
}

int Merge(const MergeOptions& options) {
  const ThreadLimit threads(options.settings.threads);
  const RenderTargets& targets = options.outputs.targets;
  CheckOutputPaths({{targets.exr, targets.png, targets.json, options.state}},
                   {options.states.begin(), options.states.end()});
  std::optional<StateLock> lock;
  if (!options.state.empty()) lock.emplace(options.state, PrintWarning);
  MergedRender merged = MergeStates(options.states);
  CheckComplete(merged, options.partial);
  if (!options.state.empty()) WriteMergedState(merged, options.state);
  merged.film->FitControl();
  Rendering rendering;
  rendering.report.scene = merged.head.at("scene");
  rendering.report.half = targets.image.half;
  rendering.report.result = ResultOf(merged);
  nlohmann::json members = nlohmann::json::object();
  members["merged"] = {{"states", options.states.size()},
                       {"missing_pixels", merged.missing},
                       {"seeds", merged.seeds},
                       {"machines", ToJson(merged.machines)}};
  const FilmAccumulator& film = *merged.film;
  const RenderFacts facts = {merged.identity,
                             merged.head,
                             merged.head.at("scale"),
                             merged.identity.value("color_space", std::string("srgb")),
                             std::uint64_t(film.width()) * std::uint64_t(film.height()),
                             options.partial};
  WriteRendering(film, facts, targets, members, rendering);
  const bool success = PrintProblems(rendering.problems);
  if (targets.json == "-") {
    Print(DumpJson(rendering.json, 2) + "\n");
  } else if (!options.outputs.quiet) {
    Print(MergeSummaryText(rendering.report, merged, options.outputs.verbose));
  }
  if (rendering.report.black) PrintError(fmt::format("warning: {}", kNoLight));
  if (rendering.report.result.health.Total() > 0) return kExitInvalidSamples;
  return success ? kExitGood : kExitBadInput;
}

}  // namespace

void AddMergeCommand(CLI::App& root, Command& chosen) {
  CLI::App* command =
      root.add_subcommand("merge", "Combine states of parts, or of different seeds");
  auto options = std::make_shared<MergeOptions>();
  AddOption(*command, "STATES", options->states, "States of `render --checkpoint`")
      ->required();
  AddOutputOptions(*command, options->outputs, options->settings);
  AddOption(*command, "--state FILE", options->state, "Write the merged state too");
  command->add_flag("--partial", options->partial,
                    "Pixels may be missing or have fewer samples");
  AddSetting(*command, "threads", options->settings);
  command->footer(
      "\nExamples:\n"
      "  lanelight merge part-*.state -o out.exr --json out.json\n"
      "  lanelight merge part-*.state --partial -o so-far.exr\n"
      "  lanelight merge seed-1.state seed-2.state -o both.exr");
  command->callback([options, &chosen] {
    ResolveOutputs(options->outputs, options->settings);
    // An image of interrupted parts is what the command asks for.
    options->outputs.targets.keeps_others = false;
    if (options->outputs.targets.exr.empty() && options->state.empty()) {
      throw CLI::RequiredError("--output or --state");
    }
    chosen = [options] { return Merge(*options); };
  });
}

}  // namespace lanelight
