#include "tests/measure/report/synthetic_study.h"

#include <string>

#include "tests/measure/report/synthetic_images.h"
#include "tests/measure/report/synthetic_scene.h"
#include "tests/measure/report/synthetic_strategy.h"

namespace lanelight {
namespace {

using Json = nlohmann::json;

Json RenderedReference(const std::string& image) {
  return {{"source", "rendered"},
          {"files", Json::array()},
          {"strategy", "points=independent"},
          {"spp", 4096},
          {"relmse", 0.00011},
          {"rmse", 0.0062},
          {"independent", true},
          {"note", nullptr},
          {"image", image}};
}

std::vector<Recipe> Recipes() {
  return {{"paper-plain", "directions=bsdf,points=independent", 0, 1.0, -0.5, 0.011, 0},
          {"paper-uniform", "directions=uniform", 2, 1.6, -0.5, 0.0105, 0},
          {"paper-importance", "directions=mis:power", 3, 0.62, -0.5, 0.016, 0},
          {"paper-stratified", "points=stratified", 4, 0.9, -0.63, 0.0115, 0},
          {"paper-antithetic", "pairs=antithetic", 5, 0.88, -0.51, 0.0113, 0.12},
          {kHostileName, "points=sobol,control=none", 0, 0.6, -0.57, 0.0166, 0}};
}

void AddDiffuse(Json& scene, std::vector<ReportImage>& images) {
  const char* meanings[] = {"proportional to the cosine", "uniform over the hemisphere",
                            "the normal plus a point of the unit ball"};
  const char* models[] = {"lambertian", "uniform", "insphere"};
  for (int i = 0; i < 3; ++i) {
    const std::string name = std::string("diffuse-") + models[i];
    images.push_back(SyntheticRender(name, 0.05, 0.2 * i, 900 + i));
    scene["diffuse"].push_back({{"model", models[i]},
                                {"meaning", meanings[i]},
                                {"image", name},
                                {"mean", {0.41, 0.35, 0.31 + 0.01 * i}}});
  }
}

Json CompleteScene(std::vector<ReportImage>& images) {
  Json scene = BareScene("cornell-box");
  scene["machines"] = {{{"text", "<b>Synthetic</b> 1000, 4 cores, 8.0 GiB, load 1.50"}},
                       {{"text", "unknown processor, 2 cores, 8.0 GiB, load unknown"}}};
  const std::vector<int> counts = {1, 2, 4, 8, 16, 32, 64};
  scene["counts"] = counts;
  scene["target_relmse"] = 0.001;
  scene["notes"] = Json::array({"bump maps are not used"});
  scene["reference"] = RenderedReference("cornell-reference");
  images.push_back(SyntheticReference("cornell-reference"));
  int i = 0;
  scene["strategies"] = Json::array();
  for (const Recipe& recipe : Recipes()) {
    scene["strategies"].push_back(MakeStrategy(recipe, "cornell-" + std::to_string(i),
                                               counts, 100 + 10 * i, true, images));
    ++i;
  }
  Json refused =
      BareStrategy("paper-control", "control=regression,reuse=block", "refused");
  refused["message"] = "control=regression needs samples of one path each";
  refused["figure"] = 6;
  Json failed = BareStrategy("paper-roulette", "roulette=constant:0.2", "failed");
  failed["message"] = "the render ended early: no memory left";
  failed["figure"] = 7;
  scene["strategies"].push_back(refused);
  scene["strategies"].push_back(failed);
  scene["strategies"][1]["heavy_tailed"] = true;
  scene["calibration"] = {{"inside", 204},
                          {"total", 210},
                          {"share", {{"value", 0.971}, {"low", 0.939}, {"high", 0.989}}},
                          {"stated", 0.95}};
  scene["bias"] = {{"tests", 6}, {"failed", 1}, {"level", 0.05}};
  scene["verdict"] =
      "Sobol points and multiple importance sampling are the most efficient strategy: "
      "at 64 samples per pixel they are several times as efficient as plain path "
      "tracing, "
      "and no strategy that ran is distinguishable from them except those below rank 2.";
  AddDiffuse(scene, images);
  Rank(scene);
  return scene;
}

Json SparseScene(std::vector<ReportImage>& images) {
  Json scene = BareScene("one \"repetition\" & <more>");
  scene["counts"] = Json::array({4});
  scene["crop"] = {8, 0, 50, 50};
  scene["reference"] = {{"source", "file"},
                        {"files", {"/data/some/reference.exr"}},
                        {"strategy", nullptr},
                        {"spp", nullptr},
                        {"relmse", nullptr},
                        {"rmse", nullptr},
                        {"independent", false},
                        {"image", "not-there"},
                        {"note", "one file only: its own error is not known"}};
  scene["strategies"] = Json::array();
  for (int i = 0; i < 2; ++i) {
    Json s = MakeStrategy(Recipes()[i], "sparse-" + std::to_string(i), {4}, 500 + 10 * i,
                          false, images);
    s["images"]["bias"] = nullptr;
    s["heavy_tailed"] = nullptr;
    scene["strategies"].push_back(s);
  }
  scene["strategies"].push_back(BareStrategy("skipped", "", "skipped"));
  scene["verdict"] = nullptr;
  Rank(scene);
  return scene;
}

Json EmptyScene() {
  Json scene = BareScene("nothing ran");
  scene["counts"] = Json::array();
  scene["reference"] = nullptr;
  scene["baseline"] = nullptr;
  scene["bias"] = nullptr;
  scene["verdict"] = "No strategy ran.";
  scene["strategies"] = Json::array({BareStrategy("alone", "points=sobol", "failed")});
  scene["ranking"] = Json::array();
  return scene;
}

}  // namespace

SyntheticStudy MakeSyntheticStudy() {
  SyntheticStudy out;
  out.study = {{"schema", 1},
               {"kind", "lanelight-study"},
               {"settings",
                {{"confidence", 0.95},
                 {"repetitions", kRepetitions},
                 {"seed", 1},
                 {"threads", 2},
                 {"max_depth", nullptr},
                 {"resolution", nullptr},
                 {"crop", nullptr},
                 {"spp", nullptr},
                 {"budget", nullptr},
                 {"target_relmse", 0.001}}},
               {"machine",
                {{"target", "AVX2"},
                 {"threads", 2},
                 {"text", "Synthetic 2000, 2 cores, 8.0 GiB, load 0.10"},
                 {"versions", {{"lanelight", "0.1.0"}, {"highway", "1.0.3"}}}}},
               {"seconds", 431.7}};
  const Json broken = {{"name", "broken"},
                       {"path", "scenes/broken.pbrt"},
                       {"error", "scenes/broken.pbrt:7:1: unknown directive \"Shap\""}};
  out.study["scenes"] = {CompleteScene(out.images), SparseScene(out.images), broken,
                         EmptyScene(), CrowdedScene()};
  return out;
}

}  // namespace lanelight
