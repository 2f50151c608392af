#include "src/render/job/loaded_scene.h"
#include "src/render/job/setting.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "src/base/core/json_text.h"
#include "src/base/core/parallel.h"
#include "src/render/job/job.h"
#include "src/scene/compiled/scene.h"

namespace lanelight {

RenderSettings SettingsInForce(const Job& job) {
  const Film& film = job.loaded->description.film;
  const PixelRect& w = job.window;
  const auto unless_none = [](auto value) {
    return value > 0 ? std::optional(value) : std::nullopt;
  };
  RenderSettings s = job.settings;
  s.spp = unless_none(job.spp);
  s.seconds = unless_none(job.seconds);
  s.target_relmse = unless_none(job.target.relmse);
  s.target_rmse = unless_none(job.target.rmse);
  s.seed = job.seed;
  s.resolution = {film.width, film.height};
  s.crop = {w.x0, w.y0, w.x1, w.y1};
  s.aov = job.plan.options.auxiliary != Auxiliary::kNone;
  s.gbuffer = film.gbuffer;
  s.sampler = job.scene.strategy.sampler;
  s.max_depth = int(job.plan.options.max_depth);
  s.transport = job.scene.transport() == Transport::kSpectral
                    ? TransportSetting::kSpectral
                    : TransportSetting::kRgb;
  s.build = job.scene.compiled->accel.quality;
  s.threads = ThreadCount(s.threads);
  s.target = job.plan.options.target.name();
  return s;
}

namespace {

// The value of a text; null for none.
nlohmann::json ValueJson(ValueForm form, const std::optional<std::string>& text) {
  if (!text) return nullptr;
  if (form == ValueForm::kText) return *text;
  if (form == ValueForm::kNumber) return std::stod(*text);
  if (form != ValueForm::kSize && form != ValueForm::kWindow) {
    return ParseJson(*text);
  }
  std::string list = "[" + *text + "]";
  std::ranges::replace(list, 'x', ',');
  return ParseJson(list);
}

std::string KeyOf(const SettingText& setting) {
  std::string key = *setting.key == '\0' ? setting.name : setting.key;
  std::ranges::replace(key, '-', '_');
  return key;
}

}  // namespace

nlohmann::json SettingsJson(const RenderSettings& settings, SettingUse use) {
  nlohmann::json out = nlohmann::json::object();
  for (const auto& setting : SettingList()) {
    if (!setting.Is(use)) continue;
    out[KeyOf(setting)] = ValueJson(setting.form, setting.text(settings));
  }
  return out;
}

}  // namespace lanelight
