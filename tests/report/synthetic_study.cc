#include "tests/report/synthetic_study.h"

#include <cmath>
#include <algorithm>
#include <string>

#include "tests/report/synthetic_images.h"

namespace lanelight {
namespace {

using Json = nlohmann::json;

constexpr int kRepetitions = 5;
constexpr int kSide = 16;  // pixels of a tile

struct Recipe {
  std::string name, text;
  int figure;      // 0: none
  double noise;    // relative standard deviation of one sample
  double order;    // of the RMSE
  double seconds;  // of one sample per pixel
  double bias;     // planted, relative
};

Json Interval(double value, double relative) {
  const double width = std::abs(value) * relative;
  return {{"value", value}, {"low", value - width}, {"high", value + width}};
}

Json Unbounded(double value) {
  return {{"value", value}, {"low", nullptr}, {"high", nullptr}};
}

Json Optional(double value, double relative, bool repeated) {
  return repeated ? Interval(value, relative) : Unbounded(value);
}

Json MakeLevel(const Recipe& recipe, int spp, bool repeated) {
  const double rmse = 0.6 * recipe.noise * std::pow(spp, recipe.order);
  const double wobble = 1 + 0.08 * (SyntheticRandom(int(recipe.noise * 1e3), spp) - 0.5);
  const double variance = rmse * rmse * wobble, bias2 = recipe.bias * recipe.bias / 9;
  const double relmse = variance + bias2, seconds = recipe.seconds * (spp + 0.4);
  Json level = {
      {"spp", spp},
      {"repetitions", repeated ? kRepetitions : 1},
      {"rmse", Optional(std::sqrt(relmse) * 0.7, 0.06, repeated)},
      {"relmse", Optional(relmse, 0.12, repeated)},
      {"mape", Optional(std::sqrt(relmse) * 0.8, 0.05, repeated)},
      {"relmse_trimmed", Optional(relmse * 0.62, 0.08, repeated)},
      {"worst_share", 0.031},
      {"variance", Optional(variance, 0.12, repeated)},
      {"bias2", Optional(bias2 - 0.01 * variance, 1.8, repeated)},
      {"mean", {0.4102, 0.3561, 0.3127}},
      {"bias", Optional(recipe.bias / 9 + 1e-4, 1.4, repeated)},
      {"bias_p", recipe.bias > 0 ? 3.1e-7 : 0.37},
      {"cpu_seconds", Optional(seconds, 0.04, repeated)},
      {"wall_seconds", Optional(seconds / 1.9, 0.05, repeated)},
      {"rays_per_sample", 7.31},
      {"path_length", 3.62},
      {"reference_share", relmse < 2e-4 ? 0.61 : 0.02},
      {"reference_limited", relmse < 2e-4},
      {"invalid", 0},
      {"self",
       {{"relmse", Optional(relmse * (0.94 + 0.3 / spp), 0.1, repeated)},
        {"inside", repeated ? kRepetitions - (spp == 4) : 1},
        {"total", repeated ? kRepetitions : 1}}},
  };
  if (repeated) return level;
  for (const char* member : {"bias_p", "self", "variance", "bias2", "mape",
                             "relmse_trimmed", "reference_share"}) {
    level[member] = nullptr;
  }
  return level;
}

Json MakeTiles(const Recipe& recipe, int seed) {
  const int columns = kSyntheticWidth / kSide, rows = kSyntheticHeight / kSide;
  Json z = Json::array(), failed = Json::array();
  for (int row = 0; row < rows; ++row) {
    Json line = Json::array();
    for (int column = 0; column < columns; ++column) {
      const int index = row * columns + column;
      const double u = (column + 0.5) / columns, v = (row + 0.5) / rows;
      const bool biased = recipe.bias > 0 && u > 0.6 && v > 0.6;
      line.push_back(4 * SyntheticRandom(seed, index) - 2 + (biased ? 4 : 0));
      if (biased && index % 3 != 0) failed.push_back(index);
    }
    z.push_back(line);
  }
  z[0][0] = nullptr;
  return {{"side", kSide}, {"columns", columns}, {"rows", rows},
          {"z", z},        {"failed", failed},   {"level", 1e-4}};
}

Json MakeStages(const Recipe& recipe, double seconds) {
  const std::vector<std::pair<const char*, double>> shares = {
      {"intersect", 0.41},   {"shadow", 0.21},  {"shade diffuse", 0.13},
      {"generate", 0.07},    {"lights", 0.06},  {"roulette", 0.03},
      {"shade glass", 0.03}, {"route", 0.025},  {"accumulate", 0.02},
      {"compact", 0.01},     {"control", 0.005}};
  Json stages = Json::array();
  double tilt = recipe.seconds * 40;
  for (const auto& [name, share] : shares) {
    const double mine = name == shares[1].first ? share * (1 - tilt) : share;
    stages.push_back({{"name", name},
                      {"seconds", mine * seconds},
                      {"share", mine},
                      {"ns_per_item", 11.0 + 100 * mine},
                      {"items", 1234567},
                      {"occupancy", 0.93}});
  }
  stages[3]["occupancy"] = nullptr;
  return stages;
}

Json BareStrategy(const std::string& name, const std::string& text,
                  const std::string& status) {
  return {{"name", name},
          {"text", text},
          {"status", status},
          {"message", nullptr},
          {"figure", nullptr},
          {"levels", Json::array()},
          {"order", nullptr},
          {"to_target", nullptr},
          {"efficiency", nullptr},
          {"at_spp", nullptr},
          {"rank", nullptr},
          {"heavy_tailed", false},
          {"stages", Json::array()},
          {"images", nullptr},
          {"tiles", nullptr}};
}

Json AddImages(const Recipe& recipe, const std::string& prefix, double noise, int seed,
               bool repeated, std::vector<ReportImage>& images) {
  const Json names = {{"mean", prefix + "-mean"},
                      {"one", prefix + "-one"},
                      {"variance", prefix + "-variance"},
                      {"bias", repeated ? Json(prefix + "-bias") : Json()}};
  images.push_back(
      SyntheticRender(names["mean"], noise / std::sqrt(kRepetitions), recipe.bias, seed));
  images.push_back(SyntheticRender(names["one"], noise, recipe.bias, seed + 1));
  images.push_back(SyntheticVariance(names["variance"], noise));
  if (repeated) {
    images.push_back(SyntheticBias(names["bias"], noise, recipe.bias, seed + 2));
  }
  return names;
}

Json MakeStrategy(const Recipe& recipe, const std::string& prefix,
                  const std::vector<int>& counts, int seed, bool repeated,
                  std::vector<ReportImage>& images) {
  Json s = BareStrategy(recipe.name, recipe.text, "ok");
  for (const int spp : counts) s["levels"].push_back(MakeLevel(recipe, spp, repeated));
  const Json& last = s["levels"].back();
  const double relmse = last["relmse"]["value"], seconds = last["cpu_seconds"]["value"];
  s["at_spp"] = counts.back();
  if (recipe.figure > 0) s["figure"] = recipe.figure;
  s["efficiency"] = Optional(3e-3 / (relmse * seconds), 0.15, repeated);
  s["stages"] = MakeStages(recipe, seconds * kRepetitions);
  const double noise = recipe.noise * std::pow(counts.back(), recipe.order);
  s["images"] = AddImages(recipe, prefix, noise * 2.2, seed, repeated, images);
  if (counts.size() > 1) s["order"] = Optional(recipe.order, 0.03, repeated);
  if (repeated) {
    s["tiles"] = MakeTiles(recipe, seed);
    s["to_target"] = {{"spp", Interval(1500 * recipe.noise * recipe.noise, 0.2)},
                      {"seconds", Interval(1.5 * recipe.noise * recipe.noise, 0.22)},
                      {"extrapolated", recipe.noise > 0.9}};
  }
  return s;
}

// Efficiencies relative to the first, the order by them, and ranks from their intervals.
void Rank(Json& scene) {
  std::vector<int> order;
  Json& strategies = scene["strategies"];
  const int baseline = scene["baseline"];
  const double unit = strategies[baseline]["efficiency"]["value"];
  for (int i = 0; i < int(strategies.size()); ++i) {
    Json& efficiency = strategies[i]["efficiency"];
    if (efficiency.is_null()) continue;
    for (Json& x : efficiency) {
      if (x.is_number()) x = x.get<double>() / unit;
    }
    order.push_back(i);
  }
  const auto value = [&](int i, const char* member) {
    return strategies[i]["efficiency"][member].template get<double>();
  };
  std::sort(order.begin(), order.end(),
            [&](int a, int b) { return value(a, "value") > value(b, "value"); });
  scene["ranking"] = order;
  for (const int i : order) {
    if (strategies[i]["efficiency"]["low"].is_null()) continue;
    int best = 1, worst = int(order.size());
    for (const int j : order) {
      best += value(j, "low") > value(i, "high");
      worst -= value(j, "high") < value(i, "low");
    }
    strategies[i]["rank"] = {best, worst};
  }
}

Json BareScene(const std::string& name) {
  return {{"name", name},
          {"path", "scenes/" + name + ".pbrt"},
          {"hash", "9e3779b97f4a7c15"},
          {"error", nullptr},
          {"resolution", {kSyntheticWidth, kSyntheticHeight}},
          {"crop", {0, 0, kSyntheticWidth, kSyntheticHeight}},
          {"seconds", {{"load", 0.012}, {"build", 0.034}, {"reference", 12.5}}},
          {"notes", Json::array()},
          {"baseline", 0},
          {"target_relmse", nullptr},
          {"calibration", nullptr},
          {"bias", {{"tests", 0}, {"failed", 0}, {"level", 0.05}}},
          {"diffuse", Json::array()}};
}

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
          {"paper-stratified", "points=cmj", 4, 0.9, -0.63, 0.0115, 0},
          {"paper-antithetic", "pairs=antithetic:all", 5, 0.88, -0.51, 0.0113, 0.12},
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
  Json refused = BareStrategy("paper-control", "control=analytic", "refused");
  refused["message"] = "control=analytic needs a light without area; try control=ambient";
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
      "Sobol points and multiple importance sampling give the least error for the time: "
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
  scene["crop"] = {8, 0, 100, 100};
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
                 {"versions", {{"lanelight", "0.1.0"}, {"highway", "1.0.3"}}}}},
               {"seconds", 431.7}};
  const Json broken = {{"name", "broken"},
                       {"path", "scenes/broken.pbrt"},
                       {"error", "scenes/broken.pbrt:7:1: unknown directive \"Shap\""}};
  out.study["scenes"] = {CompleteScene(out.images), SparseScene(out.images), broken,
                         EmptyScene()};
  return out;
}

}  // namespace lanelight
