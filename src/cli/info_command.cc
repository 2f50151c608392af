// `lanelight info`: what this build uses on this machine, or what an image says of
// itself.
#include <CLI/Version.hpp>
#include <memory>
#include <nlohmann/json.hpp>

#include "kernels/simd/target.h"
#include "src/base/core/json_text.h"
#include "src/base/core/parallel.h"
#include "src/cli/commands.h"
#include "src/cli/console.h"
#include "src/cli/exit_codes.h"
#include "src/cli/options.h"
#include "src/cli/texts.h"
#include "src/render/job/machine_json.h"
#include "src/render/job/memory.h"
#include "src/render/job/report.h"
#include "src/scene/parse/parse.h"

namespace lanelight {
namespace {

struct InfoOptions {
  RenderSettings settings;
  std::string image;
  bool json = false, format = false;
};

std::vector<std::pair<std::string, std::string>> Versions() {
  auto versions = LibraryVersions();
  versions.emplace_back("cli11", CLI11_VERSION);
  return versions;
}

std::string Text(const RenderSettings& settings) {
  const SimdTarget target(settings.target);
  std::string text =
      fmt::format("{:<14} {}\n", "machine", MachineText(ThisMachine())) +
      fmt::format("{:<14} {}\n", "target", TargetText(target.name())) +
      fmt::format("{:<14} {}\n", "lanes", target.lanes()) +
      fmt::format("{:<14} {}\n", "available", fmt::join(AvailableTargets(), ", ")) +
      fmt::format("{:<14} {}\n", "threads", ThreadCount(settings.threads)) +
      fmt::format("{:<14} {:.1f} GiB\n", "memory", double(PhysicalMemory()) / (1 << 30));
  for (const auto& [name, version] : Versions()) {
    text += fmt::format("{:<14} {}\n", name, version);
  }
  return text;
}

std::string JsonText(const RenderSettings& settings) {
  nlohmann::json out = {{"schema", kReportSchema},
                        {"target", TargetJson(SimdTarget(settings.target))},
                        {"machine", ToJson(ThisMachine())},
                        {"threads", ThreadCount(settings.threads)},
                        {"memory", PhysicalMemory()}};
  for (const auto& [name, version] : Versions()) out["versions"][name] = version;
  return DumpJson(out, 2) + "\n";
}

int PrintImageInfo(const InfoOptions& options) {
  nlohmann::json info = ImageInfoJson(options.image);
  info["schema"] = kReportSchema;
  Print(options.json ? DumpJson(info, 2) + "\n" : ImageInfoText(info));
  return kExitGood;
}

}  // namespace

void AddInfoCommand(CLI::App& root, Command& chosen) {
  CLI::App* command = root.add_subcommand(
      "info", "Print machine, SIMD target and versions, or the metadata of an image");
  auto options = std::make_shared<InfoOptions>();
  AddOption(*command, "IMAGE", options->image,
            "Print the metadata of this file: size, channels, error, samples, strategy, "
            "scene, settings; default: print machine and build");
  AddSetting(*command, "simd", options->settings)
      ->description(WithDefault("SIMD target to show", "the best available"));
  AddSetting(*command, "threads", options->settings);
  command->add_flag("--json", options->json, "Print JSON");
  command->add_flag(
      "--format", options->format,
      "Print how every pbrt-v4 directive and parameter is supported, as Markdown");
  command->footer(
      "\nExamples:\n  lanelight info --simd AVX2\n"
      "  lanelight info out.exr\n"
      "  lanelight info --format");
  command->callback([options, &chosen] {
    chosen = [options] {
      if (!options->image.empty()) return PrintImageInfo(*options);
      if (options->format) {
        Print(std::string(FormatDocument()));
        return int(kExitGood);
      }
      const RenderSettings& settings = options->settings;
      Print(options->json ? JsonText(settings) : Text(settings));
      return int(kExitGood);
    };
  });
}

}  // namespace lanelight
