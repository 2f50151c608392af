// The list of settings: what is derived from it, for each of them.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <set>

#include "src/render/job/identity.h"
#include "src/render/job/report.h"
#include "src/render/job/setting.h"
#include "tests/support/test_target.h"

namespace lanelight {
namespace {

using Json = nlohmann::json;

// A text of each setting that is not its default.
std::map<std::string, std::string> OtherTexts() {
  return {{"spp", "3"},
          {"time", "0.5"},
          {"target", "50%"},
          {"target-relmse", "0.25"},
          {"target-rmse", "1e-12"},
          {"seed", "18446744073709551615"},
          {"resolution", "64x48"},
          {"crop", "1,2,30,40"},
          {"aov", "true"},
          {"gbuffer", "world"},
          {"strategy", "roulette=none,reuse=none"},
          {"sampler", "halton"},
          {"transport", "spectral"},
          {"max-depth", "0"},
          {"scattering", "insphere"},
          {"depth", "half"},
          {"exposure", "-1.5"},
          {"png", "true"},
          {"wavefront", "512"},
          {"build", "fast"},
          {"copied-triangles", "0"},
          {"threads", "2"},
          {"simd", AvailableTargets().back()},
          {"skip-unsupported", "true"}};
}

Job BoxWith(const RenderSettings& settings) {
  return PrepareJob(std::string(LANELIGHT_SOURCE_DIR) + "/scenes/cornell-box.pbrt",
                    settings);
}

std::set<std::string> Keys(const Json& json) {
  std::set<std::string> keys;
  for (const auto& [key, value] : json.items()) keys.insert(key);
  return keys;
}

}  // namespace

TEST_CASE("each setting is parsed, printed and marked as set", "[render]") {
  const auto texts = OtherTexts();
  std::set<std::string> names;
  RenderSettings all;
  for (const Setting& setting : SettingList()) {
    INFO(setting.name);
    CHECK(names.insert(setting.name).second);
    CHECK(&SettingNamed(setting.name) == &setting);
    CHECK_FALSE(setting.IsSet({}));
    CHECK_FALSE(setting.meaning.empty());
    const std::string text = texts.at(setting.name);
    RenderSettings settings;
    setting.read(settings, text);
    CHECK(setting.text(settings) == text);
    CHECK(setting.IsSet(settings));
    setting.read(all, text);
    // No other setting is kept in the same place.
    for (const Setting& other : SettingList()) {
      const bool same = other.name == std::string(setting.writes) ||
                        setting.name == std::string(other.writes);
      CHECK(other.IsSet(settings) == (same || &other == &setting));
    }
  }
  CHECK(names.size() == texts.size());
  for (const auto& [name, text] : texts) CHECK(SettingNamed(name).text(all) == text);
}

TEST_CASE("settings are numbers, lists and names in JSON", "[render]") {
  RenderSettings settings;
  for (const char* name : {"time", "seed", "crop", "resolution", "aov", "sampler"}) {
    SettingNamed(name).read(settings, OtherTexts().at(name));
  }
  const Json json = SettingsJson(settings, kReported);
  CHECK(json.at("time_budget") == 0.5);
  CHECK(json.at("time_budget").is_number_float());
  CHECK(json.at("seed") == 18446744073709551615u);
  CHECK(json.at("crop") == Json{1, 2, 30, 40});
  CHECK(json.at("resolution") == Json{64, 48});
  CHECK(json.at("aov") == true);
  CHECK(json.at("sampler") == "halton");
  CHECK(json.at("spp") == nullptr);
  CHECK_FALSE(json.contains("skip_unsupported"));
}

TEST_CASE("identities and reports have the settings in force", "[render]") {
  RenderSettings settings;
  settings.resolution = {8, 6};
  settings.crop = {1, 2, 5, 6};
  settings.target_rmse = 0.5;
  const Job job = BoxWith(settings);
  const Json identity = IdentityOf(job);
  // States have it: what is gone, new or called otherwise ends their renders.
  CHECK(Keys(identity) ==
        std::set<std::string>{"scene_hash", "resolution", "crop", "max_depth", "seed",
                              "strategy", "scattering", "copied_triangles", "aov",
                              "gbuffer", "color_space", "skip_unsupported", "target",
                              "transport", "version"});
  CHECK(identity.at("resolution") == Json{8, 6});
  CHECK(identity.at("crop") == Json{1, 2, 5, 6});
  CHECK(identity.at("scattering") == nullptr);
  CHECK(identity.at("gbuffer") == "");
  CHECK(identity.at("target") == TestTarget().name());
  CHECK(identity.at("max_depth") == job.plan.options.max_depth);
  const Json reported = HeadJson(job, "box", true).at("settings");
  CHECK(Keys(reported) ==
        std::set<std::string>{"resolution", "crop", "spp", "time_budget", "target_relmse",
                              "target_rmse", "max_depth", "seed", "sampler", "strategy",
                              "points", "aov", "gbuffer", "depth", "build",
                              "copied_triangles", "threads", "transport"});
  CHECK(reported.at("transport") == "rgb");
  CHECK(reported.at("target_rmse") == 0.5);
  CHECK(reported.at("target_relmse") == nullptr);
  CHECK(reported.at("spp") == nullptr);
  CHECK(reported.at("sampler") == Name(job.scene.strategy.sampler));
  CHECK(reported.at("depth") == "half");
}

TEST_CASE("only settings that change pixels change the render's identity", "[render]") {
  RenderSettings small;
  small.resolution = {8, 6};
  const Json defaults = IdentityOf(BoxWith(small));
  for (const auto& [name, text] : OtherTexts()) {
    const Setting& setting = SettingNamed(name);
    INFO(name);
    RenderSettings settings = small;
    if (name == "crop") {
      settings.crop = {1, 1, 2, 2};
    } else if (name == "simd") {
      continue;  // is chosen for the process
    } else {
      setting.read(settings, text);
    }
    // What there is of them after all, which identities have.
    const bool differs = setting.Is(kIdentity) || name == "sampler" || name == "strategy";
    CHECK((IdentityOf(BoxWith(settings)) != defaults) == differs);
  }
}

}  // namespace lanelight
