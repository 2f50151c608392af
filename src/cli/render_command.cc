// `lanelight render SCENE`: the flags, and the render from start to end.
#include <memory>

#include "src/cli/commands.h"
#include "src/cli/exit_codes.h"
#include "src/cli/interrupt.h"
#include "src/cli/options.h"
#include "src/cli/render_outputs.h"
#include "src/render/job/display.h"
#include "src/render/job/loaded_scene.h"

namespace lanelight {
namespace {

struct RenderCommandOptions {
  SceneOptions scene;
  RenderOutputs outputs;
  CheckpointFlags checkpoint;
};

// Long renders decide by a trial run by default; resumed ones keep their decision. Ranks
// use the leader's, which has the state.
DefaultDecision DecisionFor(const RenderCommandOptions& options, RankGroup& group) {
  DefaultDecision decision = DefaultDecision::kIfLong;
  if (group.is_leader()) {
    if (const auto began = DecisionOfState(options.outputs.targets.checkpoint)) {
      decision =
          *began == Decide::kPilot ? DefaultDecision::kAlways : DefaultDecision::kNever;
    }
  }
  const std::string leaders = group.Share(std::to_string(int(decision)));
  return static_cast<DefaultDecision>(std::stoi(leaders));
}

// Renders on a rank that is not the leader.
int Serve(const RenderCommandOptions& options, const RenderSettings& settings,
          RankGroup& group) {
  const Job job = PrepareJob(options.scene.scene, settings);
  const InterruptGuard interrupt("", settings.threads);
  ServeRender(job, group, &interrupt.stop());
  return kExitGood;
}

int Render(const RenderCommandOptions& options, RankGroup& group) {
  if (group.is_leader()) CheckOutputs(options.outputs, {options.scene.scene});
  RenderSettings settings = options.scene.settings;
  settings.decision = DecisionFor(options, group);
  if (!group.is_leader()) return Serve(options, settings, group);
  ProgressPrinter progress(ChooseProgressStyle(options.outputs.quiet));
  progress.PrintMessage("reading " + options.scene.scene + " and building its BVH",
                        /*always=*/false);
  const Job job = PrepareJob(options.scene.scene, settings);
  progress.Interrupt([&] {
    if (!options.outputs.quiet) PrintNotes(job);
  });
  CheckOutputs(options.outputs, job.loaded->files);
  CheckPart(options.outputs.targets.checkpoint, job);
  const bool keeps = !options.outputs.targets.checkpoint.path.empty();
  const InterruptGuard interrupt(keeps ? kKeepingMessage : kStoppingMessage,
                                 settings.threads);
  RenderHooks hooks = PrintingHooks(progress, interrupt.stop());
  if (group.ranks() > 1) hooks.group = &group;
  const Rendering rendering =
      RenderToFiles(job, options.scene.scene, options.outputs.targets, hooks);
  return PrintRendering(rendering, job, options.outputs);
}

}  // namespace

void AddRenderCommand(CLI::App& root, RankGroup& group, Command& chosen) {
  CLI::App* command = root.add_subcommand("render", "Render a scene to an OpenEXR image");
  auto options = std::make_shared<RenderCommandOptions>();
  AddSettings(*command, kAmountFlag, options->scene.settings);
  AddOutputOptions(*command, options->outputs, options->scene.settings);
  command->get_option("--output")
      ->description("Write the image to this file (.exr); required without --part");
  AddCheckpointOptions(*command, options->checkpoint);
  command
      ->add_option_function<std::string>(
          "--display-server",
          [options](const std::string& text) {
            options->outputs.targets.display = ReadValue(kDisplayEndpoint, text);
          },
          "Send the current image to tev (or a compatible viewer) at this address; "
          "default: none; default port: 14158")
      ->check(ValueOf(kDisplayEndpoint))
      ->type_name("HOST[:PORT]");
  AddSceneOptions(*command, options->scene);
  command->footer(
      "\nFlags override the scene file. Ctrl-C finishes the samples in flight, and "
      "writes the\n"
      "image, and the state with --checkpoint; a second one aborts.\n"
      "\nExamples:\n"
      "  lanelight render scene.pbrt -o out.exr --spp 256 --png\n"
      "  lanelight render scene.pbrt -o out.exr --time 1m --resolution 640x360\n"
      "  lanelight render scene.pbrt -o out.exr --target 1% --time 10m\n"
      "  lanelight render scene.pbrt -o part.exr --crop 100,100,200,150 --aov\n"
      "  lanelight render scene.pbrt -o out.exr --spp 65536 --checkpoint out.state "
      "--resume\n"
      "  lanelight render scene.pbrt --spp 4096 --part 3/16 --checkpoint part-3.state");
  command->callback([options, &group, &chosen] {
    ResolveOutputs(options->outputs, options->scene.settings);
    CheckAmountOptions(options->scene.settings);
    ResolveCheckpoint(options->checkpoint, options->outputs.targets);
    chosen = [options, &group] { return Render(*options, group); };
  });
}

}  // namespace lanelight
