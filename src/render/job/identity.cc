#include "src/render/job/identity.h"

#include <nlohmann/json.hpp>
#include <set>

#include "src/base/core/json_text.h"
#include "src/base/core/version.h"
#include "src/render/job/loaded_scene.h"
#include "src/render/job/setting.h"
#include "src/vocabulary/strategy/strategy_text.h"

namespace lanelight {
namespace {

using Json = nlohmann::json;

const char* Remedy(const std::string& name) {
  if (name == "scene_hash") return " (the scene or a file of it has changed)";
  if (name == "target") return " (--simd chooses it)";
  if (name == "version")
    return " (another version of the program may compute different bits)";
  return "";
}

// Returns a value for a message; of strategies, which are long, the choices that differ.
std::string Shown(const Json& value, const Json& other) {
  const auto is_strategy = [](const Json& json) {
    return json.is_string() && json.get<std::string>().find('=') != std::string::npos;
  };
  if (!is_strategy(value) || !is_strategy(other)) return DumpJson(value);
  const std::string choices =
      ChoicesNotIn(other.get<std::string>(), value.get<std::string>());
  return choices.empty() ? "nothing of it" : choices;
}

}  // namespace

Json IdentityOf(const Job& job) {
  Json identity = SettingsJson(SettingsInForce(job), kIdentity);
  identity.update({{"scene_hash", fmt::format("{:016x}", job.loaded->scene_hash)},
                   {"strategy", ToText(job.scene.strategy)},
                   {"color_space", job.loaded->description.film.color_space},
                   {"version", FullVersion()}});
  const SpectralBuckets& buckets = job.loaded->description.film.buckets;
  if (buckets.count > 0) {
    identity["buckets"] = {
        {"count", buckets.count}, {"first_nm", buckets.first}, {"last_nm", buckets.last}};
  }
  return identity;
}

SpectralBuckets BucketsOf(const Json& identity) {
  const Json& buckets = identity.at("buckets");
  return {buckets.at("count"), buckets.at("first_nm"), buckets.at("last_nm")};
}

std::string IdentityDifferences(const Json& a, const std::string& who_a, const Json& b,
                                const std::string& who_b) {
  std::set<std::string> names;
  for (const auto& [name, value] : a.items()) names.insert(name);
  for (const auto& [name, value] : b.items()) names.insert(name);
  std::string text;
  for (const std::string& name : names) {
    const Json of_a = a.value(name, Json()), of_b = b.value(name, Json());
    if (of_a == of_b) continue;
    text += fmt::format("\n  {}: {} has {}, {} {}{}", name, who_a, Shown(of_a, of_b),
                        who_b, Shown(of_b, of_a), Remedy(name));
  }
  return text;
}

}  // namespace lanelight
