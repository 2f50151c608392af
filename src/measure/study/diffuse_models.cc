// Figure 1 of the founding paper: the scene with each diffuse model on all its diffuse
// surfaces.
#include <filesystem>

#include "src/measure/study/scene_runner.h"
#include "src/render/films/colors.h"
#include "src/render/job/setting.h"
#include "src/scene/compile/compile.h"

namespace lanelight {
namespace {

namespace fs = std::filesystem;

struct Model {
  Scattering scattering;
  const char* meaning;
};
constexpr Model kModels[] = {
    {Scattering::kUniform, "completely diffuse: directions uniform over the hemisphere"},
    {Scattering::kLambertian, "Lambertian: directions in proportion to the cosine"},
    {Scattering::kInSphere,
     "the paper's Lambertian: the normal plus a point from within the unit sphere"},
};

bool HasDiffuse(const FeatureSet& features) {
  return features.Has(Feature::kDiffuse) || features.Has(Feature::kDiffuseUniform) ||
         features.Has(Feature::kDiffuseInSphere);
}

}  // namespace

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
    settings.spp = MostSamples();
    settings.transport = SettingsInForce(job_).transport;
    settings.known_tree = TreesOf(*job_.scene.compiled);
    const Job job = PrepareJob(scene_.path, settings);
    const FilmAccumulator film = RunJob(job, {}, hooks_.stop).film;
    if (Stopped()) return;
    diffuse.image = FilmColors(film);
    for (Rgb& c : diffuse.image) c = RoundToFloat(c);
    WriteColors(path, film.width(), film.height(), {{"", &diffuse.image}});
    scene_.diffuse.push_back(std::move(diffuse));
  }
}

}  // namespace lanelight
