#include "src/cli/scene_options.h"

#include <string_view>

#include "src/cli/defaults.h"

namespace lanelight {

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
  // Of the two the one that is declared later names the other.
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
  command.add_option("SCENE", options.scene, "Scene file in the text format of pbrt-v4")
      ->required()
      ->type_name("");
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

}  // namespace lanelight
