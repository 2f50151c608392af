#include "src/cli/options.h"

#include <filesystem>
#include <string_view>

#include "src/base/core/error.h"

namespace lanelight {
namespace {

constexpr int kMaxParts = 1 << 20;

}  // namespace

CLI::Option* AddSetting(CLI::App& command, const std::string& name,
                        RenderSettings& settings) {
  const Setting& setting = SettingNamed(name);
  const std::string flag = "--" + name;
  const auto read = [&setting, &settings, flag](const std::string& text) {
    try {
      setting.read(settings, text);
    } catch (const InputError& error) {
      throw CLI::ValidationError(flag, error.message());
    }
  };
  if (setting.form == ValueForm::kFlag) {
    return command.add_flag_callback(flag, [read] { read("true"); }, setting.meaning);
  }
  const bool has_own = setting.otherwise.empty() || setting.IsSet(settings);
  const std::string otherwise =
      has_own ? setting.text(settings).value_or("") : setting.otherwise;
  CLI::Option* option = command.add_option_function<std::string>(
      flag, read,
      otherwise.empty() ? setting.meaning : WithDefault(setting.meaning, otherwise));
  // The one of the two that is declared later excludes the other.
  for (const std::string& other : {std::string(setting.writes), WrittenBy(setting)}) {
    CLI::Option* found =
        other.empty() ? nullptr : command.get_option_no_throw("--" + other);
    if (found != nullptr) option->excludes(found);
  }
  return option->type_name(setting.type);
}

void AddSettings(CLI::App& command, SettingUse use, RenderSettings& settings) {
  for (const Setting& setting : SettingList()) {
    if (setting.Is(use)) AddSetting(command, setting.name, settings);
  }
}

void CheckAmountOptions(const RenderSettings& settings) {
  // Without a target both would say how much to render.
  if (!settings.spp || !settings.seconds || HasTarget(settings)) return;
  throw CLI::ValidationError(
      "--time",
      "--time excludes --spp, except as limits of --target, --target-relmse or "
      "--target-rmse");
}

void AddSceneOptions(CLI::App& command, SceneOptions& options) {
  AddOption(command, "SCENE", options.scene, "Scene file in the text format of pbrt-v4")
      ->required();
  AddSettings(command, kSceneFlag, options.settings);
}

std::string FlagsText(const RenderSettings& settings) {
  std::string text;
  for (const Setting& setting : SettingList()) {
    if (*setting.writes != '\0' || !setting.IsSet(settings)) continue;
    text += std::string(" --") + setting.name;
    if (setting.form == ValueForm::kFlag) continue;
    text += " " + ShellWord(*setting.text(settings));
  }
  return text;
}

std::string ShellWord(const std::string& text) {
  constexpr std::string_view kPlain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=./,:@%";
  if (!text.empty() && text.find_first_not_of(kPlain) == text.npos) return text;
  std::string word = "'";
  for (const char c : text) word += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return word + "'";
}

void AddCheckpointOptions(CLI::App& command, CheckpointFlags& flags) {
  CheckpointSettings& s = flags.settings;
  AddOption(command, "--checkpoint FILE", s.path,
            "Save the state of the render in this file, for --resume")
      ->check([](const std::string& path) {  // an empty variable of a script
        return std::string(path.empty() ? "the name of the file is empty" : "");
      });
  AddOption(command, "--every TIME", s.seconds,
            WithDefault("Time between states", fmt::format("{} s", s.seconds)))
      ->transform(ValueOf(SecondsType{0.01, 1e6}));
  flags.resume_flag = AddOption(command, "--resume [FILE]", s.from,
                                "Resume from this state and update it; bare: resume from "
                                "the --checkpoint file, if it exists")
                          ->expected(0, 1);
  AddOption(
      command, "--watch FILE", s.watch,
      "Also write the current image with every state (.exr or .png; may be given twice)")
      ->allow_extra_args(false)
      ->check([](const std::string& path) {
        const std::filesystem::path extension = std::filesystem::path(path).extension();
        return extension == ".exr" || extension == ".png"
                   ? std::string()
                   : "'" + path + "' does not end in .exr or .png";
      });
  AddOption(command, "--part I/N", flags.part,
            "Render only part I of N into --checkpoint, with --spp and without --output; "
            "`lanelight merge` combines parts");
}

Part ParsePart(const std::string& text) {
  const std::vector<int> v = ParseNumbers<int>(text, '/');
  if (v.size() == 2 && v[0] >= 1 && v[0] <= v[1] && v[1] <= kMaxParts) {
    return {v[0], v[1]};
  }
  throw CLI::ValidationError(
      "--part",
      fmt::format("{} is not I/N with I from 1 to N, and N at most {}, e.g. 3/16",
                  ShownValue(text), kMaxParts));
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
      throw CLI::ValidationError("--part",
                                 "a part is not a whole image: remove --output, and "
                                 "combine the states with `lanelight merge`");
    }
  } else if (targets.exr.empty()) {
    throw CLI::RequiredError("--output");
  }
  settings.exposure = targets.image.exposure;
  targets.checkpoint = settings;
}

void CheckPart(const CheckpointSettings& settings, const Job& job) {
  if (settings.part.count == 1) return;
  if (!job.OpenEnded()) return;
  throw InputError(
      "--part needs a fixed --spp: time and target error apply to the whole image");
}

}  // namespace lanelight
