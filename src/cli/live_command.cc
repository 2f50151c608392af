// `lanelight live SCENE`: a page in a browser that renders, compares and explains.
#include <memory>

#include "src/cli/commands.h"
#include "src/cli/console.h"
#include "src/cli/exit_codes.h"
#include "src/cli/interrupt.h"
#include "src/cli/options.h"
#include "src/cli/render_outputs.h"
#include "src/measure/live/server.h"

namespace lanelight {
namespace {

struct LiveCommandOptions {
  SceneOptions scene;
  std::uint16_t port = 0;
};

// The strategy and how much is rendered are added by the page.
std::string CommandLine(const SceneOptions& options) {
  RenderSettings settings = options.settings;
  settings.strategy = {};
  settings.sampler.reset();
  return "lanelight render " + ShellWord(options.scene) + FlagsText(settings);
}

int Live(const LiveCommandOptions& options) {
  const live::LiveScene live_scene(options.scene.scene, options.scene.settings);
  PrintNotes(live_scene.job);
  live::Server server(live_scene, CommandLine(options.scene), options.port);
  const InterruptGuard interrupt(
      "\nstopping: closing the pages (press Ctrl-C again to abort)\n");
  Print(server.address() + "\n");
  FlushOutput();
  server.Run(interrupt.stop());
  Print("the live server has stopped\n");
  return kExitGood;
}

}  // namespace

void AddLiveCommand(CLI::App& root, Command& chosen) {
  CLI::App* command = root.add_subcommand(
      "live", "Render in a browser: move the camera, compare strategies as they render");
  auto options = std::make_shared<LiveCommandOptions>();
  AddOption(*command, "--port N", options->port,
            WithDefault("Port on 127.0.0.1; 0: any free port", options->port))
      ->check(ValueFrom<std::uint32_t>(0, 65535).description(""));
  AddSceneOptions(*command, options->scene);
  command->footer(
      "\nPrints the address of the page and serves it until Ctrl-C. The address has\n"
      "a secret in it, and only browsers on this machine can reach it (docs/live.md).\n"
      "\nExamples:\n"
      "  lanelight live scene.pbrt\n"
      "  lanelight live scene.pbrt --resolution 640x360 --port 8080");
  command->callback(
      [options, &chosen] { chosen = [options] { return Live(*options); }; });
}

}  // namespace lanelight
