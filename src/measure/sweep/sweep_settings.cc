#include "src/measure/sweep/sweep_settings.h"

#include "src/base/core/source_location.h"
#include "src/base/core/suggest.h"

namespace lanelight {
namespace {

// The setting that [settings] may have under this key.
const Setting& SettingOf(const std::string& key, const SourceLocation& where) {
  if (SweepAxisOf(key)) {
    throw InputError(where, fmt::format("{} is an axis: put it into [grid], with one "
                                        "value if it is the same for all cells",
                                        key));
  }
  std::vector<std::string> known;
  for (const Setting& setting : SettingList()) {
    if (!setting.Is(kSweepKey)) continue;
    if (key == setting.name) return setting;
    known.push_back(setting.name);
  }
  ThrowUnknown(where, "setting", key, known);
}

}  // namespace

SweepSettings ReadSweepSettings(const TomlFile& file, const toml::table& table) {
  SweepSettings settings;
  for (const auto& [toml_key, node] : table) {
    const std::string key(toml_key.str());
    const Setting& setting = SettingOf(key, file.Where(toml_key.source()));
    const std::string text = file.Value(key, setting.form, node);
    ReadAt(file.Where(node), key, [&] { setting.read(settings.render, text); });
    settings.texts[key] = *setting.text(settings.render);
  }
  return settings;
}

}  // namespace lanelight
