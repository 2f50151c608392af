#include "src/render/identity.h"

#include <nlohmann/json.hpp>
#include <set>

#include "src/core/json_text.h"
#include "src/core/version.h"
#include "src/render/setting.h"

namespace lanelight {
namespace {

using Json = nlohmann::json;

// What to do about a difference.
const char* Remedy(const std::string& name) {
  if (name == "scene_hash") return " (the scene or a file of it has changed)";
  if (name == "target") return " (--target chooses it)";
  if (name == "version") return " (another program may compute other bits)";
  return "";
}

}  // namespace

Json IdentityOf(const Job& job) {
  Json identity = SettingsJson(SettingsInForce(job), kIdentity);
  identity.update({{"scene_hash", fmt::format("{:016x}", job.scene_hash)},
                   {"strategy", ToText(job.scene.strategy)},
                   {"color_space", job.description.film.color_space},
                   {"version", FullVersion()}});
  return identity;
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
    text += fmt::format("\n  {}: {} has {}, {} {}{}", name, who_a, DumpJson(of_a), who_b,
                        DumpJson(of_b), Remedy(name));
  }
  return text;
}

}  // namespace lanelight
