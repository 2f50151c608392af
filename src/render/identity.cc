#include "src/render/identity.h"

#include <nlohmann/json.hpp>
#include <set>

#include "kernels/simd/target.h"
#include "src/core/json_text.h"
#include "src/core/version.h"

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
  const Film& film = job.description.film;
  const PixelRect& w = job.window;
  Json scattering;
  if (job.settings.scattering) scattering = ScatteringName(*job.settings.scattering);
  return {{"scene_hash", fmt::format("{:016x}", job.scene_hash)},
          {"resolution", {film.width, film.height}},
          {"crop", {w.x0, w.y0, w.x1, w.y1}},
          {"max_depth", job.plan.options.max_depth},
          {"seed", job.seed},
          {"strategy", ToText(job.scene.strategy)},
          {"scattering", scattering},
          {"copied_triangles", job.settings.copied_triangles},
          {"aov", job.plan.options.auxiliary != Auxiliary::kNone},
          {"gbuffer", GbufferName(film.gbuffer)},
          {"color_space", film.color_space},
          {"skip_unsupported", job.settings.skip_unsupported},
          {"target", CurrentTarget()},
          {"version", FullVersion()}};
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
