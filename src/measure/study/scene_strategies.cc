// Strategies that a scene supports, and the diffuse models of Figure 1 of the founding
// paper.

#include <algorithm>
#include <filesystem>

#include "src/measure/study/scene_runner.h"
#include "src/render/films/colors.h"
#include "src/render/job/loaded_scene.h"
#include "src/render/job/setting.h"
#include "src/render/plan/plan_features.h"
#include "src/scene/compile/compile.h"

namespace lanelight {
namespace {

// Returns the message without the prefix "error: strategy: ".
std::string Reason(const InputError& error) {
  const std::string text = error.what(), prefix = "strategy: ";
  const std::size_t at = text.find(prefix);
  return at == std::string::npos ? text : text.substr(at + prefix.size());
}

namespace fs = std::filesystem;

struct Model {
  Scattering scattering;
  const char* meaning;
};
constexpr Model kModels[] = {
    {Scattering::kUniform, "completely diffuse: directions uniform over the hemisphere"},
    {Scattering::kLambertian, "Lambertian: directions in proportion to the cosine"},
    {Scattering::kInSphere,
     "the paper's Lambertian: the normal plus a random point in the unit sphere"},
};

bool HasDiffuse(const FeatureSet& features) {
  return features.Has(Feature::kDiffuse) || features.Has(Feature::kDiffuseUniform) ||
         features.Has(Feature::kDiffuseInSphere);
}

}  // namespace

void SceneRunner::CheckStrategies() {
  for (NamedStrategy& named :
       StudyStrategies(options_, job_.loaded->description.strategy)) {
    StrategyRuns runs;
    runs.named = std::move(named);
    plan_keys_.emplace_back();
    try {
      const Job job = WithStrategy(job_, runs.named.strategy);
      for (const std::string& note : job.plan.notes) {
        runs.message += (runs.message.empty() ? "" : "; ") + note;
      }
      FindEquivalent(runs, plan_keys_.back() = PlanKey(job.scene, job.plan));
    } catch (const InputError& error) {
      runs.status = RunStatus::kRefused;
      runs.message = Reason(error);
    }
    scene_.strategies.push_back(std::move(runs));
  }
}

// Finds a strategy with an equal plan, whose renders are bit-identical.
void SceneRunner::FindEquivalent(StrategyRuns& runs, const std::string& key) {
  const auto found = std::find(plan_keys_.begin(), plan_keys_.end() - 1, key);
  if (found == plan_keys_.end() - 1) return;
  runs.same_as = std::size_t(found - plan_keys_.begin());
  const NamedStrategy& twin = scene_.strategies[*runs.same_as].named;
  const bool equal = twin.strategy == runs.named.strategy;
  runs.status = RunStatus::kSame;
  runs.message = fmt::format("{} {}{}{}", equal ? "is" : "is on this scene identical to",
                             twin.name, runs.message.empty() ? "" : ": ", runs.message);
}

void SceneRunner::RunDiffuseModels() {
  if (!HasDiffuse(job_.scene.features())) return;
  for (const Model& model : kModels) {
    DiffuseModel diffuse = {ScatteringNames().Write(model.scattering), model.meaning, {}};
    const std::string path = scene_.folder + "/diffuse-" + diffuse.name + ".exr";
    if (fs::exists(path)) {
      diffuse.image = ReadColors(path);
      scene_.diffuse.push_back(std::move(diffuse));
      continue;
    }
    Report("diffuse model " + diffuse.name);
    RenderSettings settings = options_.settings;
    settings.scattering = model.scattering;
    settings.spp = MaxSamples();
    settings.transport = SettingsInForce(job_).transport;
    settings.cached_bvh = CachedBvhOf(*job_.scene.compiled);
    const Job job = PrepareJob(scene_.path, settings);
    const FilmAccumulator film = RunJob(job, {}, hooks_.stop).film;
    if (IsStopped()) return;
    diffuse.image = FilmColors(film);
    for (Rgb& c : diffuse.image) c = RoundToFloat(c);
    WriteColors(path, film.width(), film.height(), {{"", &diffuse.image}});
    scene_.diffuse.push_back(std::move(diffuse));
  }
}

}  // namespace lanelight
