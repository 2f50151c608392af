#include "tests/measure/report/synthetic_strategy.h"

#include <cmath>
#include <utility>

#include "tests/measure/report/synthetic_images.h"

namespace lanelight {
namespace {

using Json = nlohmann::json;

constexpr int kSide = 8;  // pixels of a tile

Json Around(double value, double relative) {
  const double width = std::abs(value) * relative;
  return {{"value", value}, {"low", value - width}, {"high", value + width}};
}

Json Unbounded(double value) {
  return {{"value", value}, {"low", nullptr}, {"high", nullptr}};
}

Json Optional(double value, double relative, bool repeated) {
  return repeated ? Around(value, relative) : Unbounded(value);
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
  const std::vector<std::pair<const char*, double>> fractions = {
      {"intersect", 0.41},   {"shadow", 0.21},  {"shade diffuse", 0.13},
      {"generate", 0.07},    {"lights", 0.06},  {"roulette", 0.03},
      {"shade glass", 0.03}, {"route", 0.025},  {"accumulate", 0.02},
      {"compact", 0.01},     {"control", 0.005}};
  Json stages = Json::array();
  double tilt = recipe.seconds * 40;
  for (const auto& [name, fraction] : fractions) {
    const double mine = name == fractions[1].first ? fraction * (1 - tilt) : fraction;
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

}  // namespace

Json BareStrategy(const std::string& name, const std::string& text,
                  const std::string& status) {
  return {{"name", name},          {"text", text},
          {"status", status},      {"message", nullptr},
          {"figure", nullptr},     {"levels", Json::array()},
          {"order", nullptr},      {"to_target", nullptr},
          {"efficiency", nullptr}, {"efficiency_trimmed", nullptr},
          {"at_spp", nullptr},     {"rank", nullptr},
          {"heavy_tailed", false}, {"stages", Json::array()},
          {"images", nullptr},     {"tiles", nullptr}};
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
  s["efficiency_trimmed"] = Optional(1.2, 0.1, repeated);
  s["stages"] = MakeStages(recipe, seconds * kRepetitions);
  const double noise = recipe.noise * std::pow(counts.back(), recipe.order);
  s["images"] = AddImages(recipe, prefix, noise * 2.2, seed, repeated, images);
  if (counts.size() > 1) s["order"] = Optional(recipe.order, 0.03, repeated);
  if (repeated) {
    s["tiles"] = MakeTiles(recipe, seed);
    s["to_target"] = {{"spp", Around(1500 * recipe.noise * recipe.noise, 0.2)},
                      {"seconds", Around(1.5 * recipe.noise * recipe.noise, 0.22)},
                      {"extrapolated", recipe.noise > 0.9}};
  }
  return s;
}

}  // namespace lanelight
