// `lanelight plan SCENE` prints the stages that a render of this scene would run; with -v
// also features, fields, and all that is omitted.
#include <memory>
#include <nlohmann/json.hpp>

#include "kernels/simd/target.h"
#include "src/base/core/json_text.h"
#include "src/cli/commands.h"
#include "src/cli/console.h"
#include "src/cli/exit_codes.h"
#include "src/cli/options.h"
#include "src/cli/texts.h"
#include "src/render/job/job.h"
#include "src/render/job/loaded_scene.h"
#include "src/render/job/machine_json.h"
#include "src/render/job/report.h"
#include "src/scene/description/note.h"
#include "src/scene/prepare/parameters.h"

namespace lanelight {
namespace {

struct PlanCommandOptions {
  SceneOptions scene;
  bool json = false, verbose = false;
};

// A line of a list of what has names.
std::string NamedRow(const std::string& name, const std::string& text) {
  return FactRow("  " + name, text, 24);
}

std::string Features(const FeatureSet& features) {
  std::string text;
  for (int i = 0; i < int(Feature::kCount); ++i) {
    const auto feature = static_cast<Feature>(i);
    if (!features.Has(feature)) continue;
    text += NamedRow(FeatureName(feature), FeatureMeaning(feature));
  }
  return text;
}

std::string StagesOf(const Phase& phase) {
  std::string text;
  for (std::size_t i = 0; i < phase.stages.size(); ++i) {
    const Stage& s = phase.stages[i].stage;
    const bool repeated = i >= phase.first_repeated && i < phase.last_repeated;
    text += NamedRow(
        s.name, std::string(s.meaning) + (repeated ? ", once for each candidate" : ""));
  }
  return text;
}

// Phases on camera rays have stages of the paths, whose meaning has been said.
std::string NamesOf(const Phase& phase) {
  std::string names;
  for (const PlannedStage& s : phase.stages) {
    names += std::string(names.empty() ? "" : " ") + s.stage.name;
  }
  return FactRow("", names, 1);
}

std::string Stages(const Plan& plan) {
  std::string text;
  for (const Phase& phase : plan.phases) {
    const bool again = phase.in_waves && phase.id != PhaseId::kPaths;
    text += fmt::format("{}stages of {} ({}), in order:\n", text.empty() ? "" : "\n",
                        InfoOf(phase.id).meaning, phase.stages.size());
    text += again ? NamesOf(phase) : StagesOf(phase);
  }
  return text;
}

std::string OmittedStages(const Plan& plan) {
  std::string text = fmt::format("omitted stages ({}):\n", plan.omitted.size());
  for (const OmittedStage& s : plan.omitted) {
    text += NamedRow(s.stage.name, s.reason);
  }
  return text;
}

// "needed by: vertex normals, ...": any one of them makes the column live.
std::string NeededBy(Field field) {
  std::string text;
  const FeatureSet needs = FieldFeatures(field);
  for (int i = 0; i < int(Feature::kCount); ++i) {
    const auto feature = static_cast<Feature>(i);
    if (!needs.Has(feature)) continue;
    text += (text.empty() ? "" : ", ") + WithoutFeature(feature);
  }
  return text;
}

std::string Fields(const Plan& plan) {
  std::string text = fmt::format("fields ({}), {} bytes per path:\n",
                                 plan.live_fields.size(), plan.bytes_per_path);
  for (Field f : plan.live_fields) {
    text += FactRow(fmt::format("  {:<22} {:<4}", FieldName(f), FieldType(f)),
                    FieldMeaning(f), 29);
  }
  text += fmt::format("\nomitted fields ({}):\n", plan.absent_fields.size());
  for (Field f : plan.absent_fields) {
    text += NamedRow(FieldName(f), NeededBy(f));
  }
  return text;
}

std::string Notes(const Plan& plan) {
  std::string text;
  for (const std::string& note : plan.notes) text += "note: " + note + "\n";
  return text.empty() ? text : text + "\n";
}

// Names the strategy, as far as a plan determines it.
std::string StrategyWords(const Job& job) {
  const Strategy& strategy = job.scene.strategy;
  const std::string text = ToText(strategy);
  if (strategy.decide != Decide::kPilot) return text;
  return text +
         "; decide=pilot: a short trial run before the image may choose another roulette "
         "or reuse; `render` prints the choice";
}

// Everything that runs comes last.
std::string Details(const Plan& plan) {
  return OmittedStages(plan) + "\n" + Fields(plan) +
         "\nfeatures of scene and options:\n" + Features(plan.features) + "\n";
}

std::string Text(const Job& job, const std::string& scene, bool verbose) {
  const Plan& plan = job.plan;
  return fmt::format("plan of {}\n\n", scene) +
         fmt::format("target     {} ({} lanes)\n", plan.options.target.name(),
                     plan.options.target.lanes()) +
         fmt::format("wavefront  {} paths x {} bytes = {:.0f} KiB per thread\n",
                     plan.wavefront, plan.bytes_per_path,
                     double(plan.wavefront) * double(plan.bytes_per_path) / 1024) +
         fmt::format("max depth  {}\n", plan.options.max_depth) +
         SummaryRow("strategy", StrategyWords(job)) +
         SummaryRow("transport", TransportText(job)) +
         SummaryRow("points", PointsText(job.scene.strategy, job.spp)) + "\n" +
         Notes(plan) + (verbose ? Details(plan) : "") + Stages(plan) +
         (verbose ? ""
                  : fmt::format("\n{} stages and {} fields are omitted; -v lists them\n",
                                plan.omitted.size(), plan.absent_fields.size())) +
         DiffersRow(job.loaded->description.notes);
}

std::string JsonText(const Job& job, const std::string& scene) {
  nlohmann::json out = {
      {"schema", kReportSchema},
      {"scene", scene},
      {"target", TargetJson(job.plan.options.target)},
      {"machine", ToJson(ThisMachine())},
      {"plan", ToJson(job.plan)},
      {"differs", CountImageChanges(job.loaded->description.notes) > 0}};
  return DumpJson(out, 2) + "\n";
}

int PrintPlan(const PlanCommandOptions& options) {
  const SceneOptions& scene = options.scene;
  RenderSettings settings = scene.settings;
  settings.decision = DefaultDecision::kIfLong;  // as `render` has it
  const Job job = PrepareJob(scene.scene, settings);
  Print(options.json ? JsonText(job, scene.scene)
                     : Text(job, scene.scene, options.verbose));
  return kExitGood;
}

}  // namespace

void AddPlanCommand(CLI::App& root, Command& chosen) {
  CLI::App* command = root.add_subcommand("plan", "Print the stages that a scene needs");
  auto options = std::make_shared<PlanCommandOptions>();
  AddSettings(*command, kAmountFlag, options->scene.settings);
  AddSceneOptions(*command, options->scene);
  command->add_flag("-v,--verbose", options->verbose,
                    "Also print features, fields, and omitted stages with reasons");
  command->add_flag("--json", options->json, "Print JSON");
  command->footer("\nExample:\n  lanelight plan scenes/glass.pbrt --max-depth 1");
  command->callback(
      [options, &chosen] { chosen = [options] { return PrintPlan(*options); }; });
}

}  // namespace lanelight
