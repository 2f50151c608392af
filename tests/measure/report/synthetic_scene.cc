#include "tests/measure/report/synthetic_scene.h"

#include <algorithm>

#include "tests/measure/report/synthetic_images.h"
#include "tests/measure/report/synthetic_strategy.h"

namespace lanelight {
namespace {

using Json = nlohmann::json;

const char* const kPoints[] = {"sobol", "halton", "stratified", "independent"};
const char* const kRoulettes[] = {"throughput",       "adjoint",       "none",
                                  "throughput:0:2:4", "constant:0.25", "constant:0.5"};

// Long names as people give them, and complete texts that are longer.
Recipe RecipeOf(int i) {
  Recipe recipe{};
  recipe.name = i == 0 ? "default"
                       : std::string("points=") + kPoints[i % 4] +
                             ",roulette=" + kRoulettes[i / 4] + ",directions=mis:balance";
  recipe.text = "directions=mis:power,points=" + std::string(kPoints[i % 4]) +
                ",pairs=none,control=none,roulette=" + kRoulettes[i / 4] +
                ",light-selection=power";
  recipe.noise = 0.5 + 0.07 * ((i * 7) % kCrowd);
  recipe.order = -0.5 - 0.01 * (i % 6);
  recipe.seconds = 0.01 + 0.0002 * i;
  return recipe;
}

Json Twin(const std::string& name) {
  Json twin = BareStrategy(name, "points=sobol", "same");
  twin["message"] = "is default";
  twin["same_as"] = 0;
  return twin;
}

}  // namespace

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

Json CrowdedScene() {
  Json scene = BareScene("crowd");
  const std::vector<int> counts = {1, 4, 16, 64};
  scene["counts"] = counts;
  scene["target_relmse"] = 0.002;
  scene["reference"] = nullptr;
  scene["strategies"] = Json::array();
  std::vector<ReportImage> unused;
  for (int i = 0; i < kCrowd; ++i) {
    Json s = MakeStrategy(RecipeOf(i), "", counts, 900 + 10 * i, true, unused);
    s["images"] = nullptr;
    s["heavy_tailed"] = i % 6 == 2;
    for (Json& level : s["levels"]) level["self"]["refused"] = i % 6 == 2 ? 3 : 0;
    scene["strategies"].push_back(s);
  }
  scene["strategies"].push_back(Twin("points=sobol"));
  scene["strategies"].push_back(Twin("scene"));
  scene["strategies"].push_back(
      BareStrategy("control=regression,reuse=block", "", "refused"));
  scene["calibration"] = {
      {"inside", 0},
      {"total", 0},
      {"refused", 48},
      {"share", {{"value", nullptr}, {"low", nullptr}, {"high", nullptr}}},
      {"stated", 0.95}};
  scene["bias"] = {
      {"tests", 20},     {"failed", 0},          {"strategies", Json::array()},
      {"alike", {1, 2}}, {"suspect_tiles", {3}}, {"level", 0.001}};
  scene["verdict"] = "Many strategies are alike.";
  scene["cautions"] = {"The ranking is at 16 samples per pixel.", "Ranks change."};
  Rank(scene);
  return scene;
}

}  // namespace lanelight
