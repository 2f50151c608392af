#include "src/cli/checkpoint_options.h"

#include <filesystem>

#include "src/base/core/error.h"
#include "src/cli/defaults.h"
#include "src/cli/validators.h"

namespace lanelight {
namespace {

constexpr int kMostParts = 1 << 20;

// An empty variable of a script would mean that nothing is kept.
std::string NamesFile(const std::string& path) {
  return path.empty() ? "the name of the file is empty" : "";
}

}  // namespace

void AddCheckpointOptions(CLI::App& command, CheckpointFlags& flags) {
  CheckpointSettings& s = flags.settings;
  command
      .add_option("--checkpoint", s.path,
                  "Keep the state of the render in this file, to go on from")
      ->check(NamesFile)
      ->type_name("FILE");
  command
      .add_option("--every", s.seconds,
                  WithDefault("Time between states", fmt::format("{} s", s.seconds)))
      ->transform(ValueOf(SecondsType{0.01, 1e6}))
      ->type_name("TIME");
  flags.resume_flag =
      command
          .add_option("--resume", s.from,
                      "Go on from this state, and keep it; bare: from that of "
                      "--checkpoint, if it is there")
          ->expected(0, 1)
          ->type_name("[FILE]");
  command
      .add_option("--watch", s.watch,
                  "Write the image so far with every state (.exr or .png; may be given "
                  "twice)")
      ->allow_extra_args(false)
      ->check([](const std::string& path) {
        const std::filesystem::path extension = std::filesystem::path(path).extension();
        return extension == ".exr" || extension == ".png"
                   ? std::string()
                   : "'" + path + "' does not end in .exr or .png";
      })
      ->type_name("FILE");
  command
      .add_option("--part", flags.part,
                  "Render only part I of N, into --checkpoint; `lanelight merge` puts "
                  "parts together")
      ->type_name("I/N");
}

Part ParsePart(const std::string& text) {
  const std::vector<int> v = ParseNumbers<int>(text, '/');
  if (v.size() == 2 && v[0] >= 1 && v[0] <= v[1] && v[1] <= kMostParts) {
    return {v[0], v[1]};
  }
  throw CLI::ValidationError(
      "--part",
      fmt::format("{} is not I/N with I from 1 to N, and N at most {}, e.g. 3/16",
                  ShownValue(text), kMostParts));
}

void ResolveCheckpoint(const CheckpointFlags& flags, RenderTargets& targets) {
  CheckpointSettings settings = flags.settings;
  if (flags.resume_flag->count() > 0) {
    const bool bare = settings.from.empty();
    settings.resume = bare ? Resume::kIfAny : Resume::kMust;
    if (bare && settings.path.empty()) {
      throw CLI::ValidationError(
          "--resume",
          "--resume FILE, or --resume with --checkpoint FILE (SCENE must not "
          "follow a bare --resume)");
    }
    if (settings.path.empty()) settings.path = settings.from;
  }
  if (!flags.part.empty()) {
    settings.part = ParsePart(flags.part);
    if (settings.path.empty()) {
      throw CLI::ValidationError("--part",
                                 "--part needs --checkpoint FILE for its state");
    }
    if (!targets.exr.empty() || !targets.png.empty()) {
      throw CLI::ValidationError(
          "--part",
          "a part is no image: leave out --output, and put the states together "
          "with `lanelight merge`");
    }
  } else if (targets.exr.empty()) {
    throw CLI::RequiredError("--output");
  }
  settings.exposure = targets.image.exposure;
  targets.checkpoint = settings;
}

void CheckPart(const CheckpointSettings& settings, const Job& job) {
  if (settings.part.count == 1 || !job.OpenEnded()) return;
  throw InputError(
      "--part needs a fixed number of samples, --spp: a time or a target error is one of "
      "the whole image");
}

}  // namespace lanelight
