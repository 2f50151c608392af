// Sampler and integrator.
#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

#include "src/parse/interpret.h"
#include "src/core/suggest.h"

namespace lanelight {
namespace {

constexpr int kMostSamples = std::numeric_limits<int>::max();

struct IntegratorInfo {
  const char* name;
  std::vector<const char*> ignored;  // parameters of pbrt that have no effect here
};

const std::vector<IntegratorInfo>& Integrators() {
  static const std::vector<IntegratorInfo> kIntegrators = {
      {"path", {"regularize"}},
      {"volpath", {"regularize"}},
      {"simplepath", {"samplebsdf", "samplelights"}},
      {"simplevolpath", {}},
      {"ambientocclusion", {"cossample", "maxdistance"}},
      {"bdpt", {"lightsampler", "regularize", "visualizestrategies", "visualizeweights"}},
      {"function", {"function", "skipbad", "imagefilename"}},
      {"lightpath", {}},
      {"mlt",
       {"bootstrapsamples", "chains", "largestepprobability", "mutationsperpixel",
        "regularize", "sigma"}},
      {"randomwalk", {}},
      {"sppm", {"iterations", "photonsperiteration", "radius", "regularize", "seed"}}};
  return kIntegrators;
}

}  // namespace

void InterpretSampler(ParseState& state, const std::string& type, ParamSet& params) {
  static const std::vector<std::pair<std::string, Points>> kSamplers = {
      {"zsobol", Points::kSobol},         {"independent", Points::kIndependent},
      {"paddedsobol", Points::kSobol},    {"sobol", Points::kSobol},
      {"halton", Points::kHalton},        {"pmj02bn", Points::kPmj02},
      {"stratified", Points::kStratified}};
  std::vector<std::string> names;
  std::optional<Points> points;
  for (const auto& [name, kind] : kSamplers) {
    names.push_back(name);
    if (type == name) points = kind;
  }
  if (!points) ThrowUnknown(params.where(), "sampler", type, names);
  Sampler sampler = state.scene.sampler;
  if (type == "stratified") {
    constexpr int kMostStrata = 32768;
    sampler.spp = params.Integer("xsamples", 4, 1, kMostStrata) *
                  params.Integer("ysamples", 4, 1, kMostStrata);
    params.Ignore("jitter", "strata are always jittered");
  } else {
    sampler.spp = params.Integer("pixelsamples", 16, 1, kMostSamples);
  }
  const int seed = params.Integer("seed", -1, 0, std::numeric_limits<int>::max());
  if (seed >= 0) sampler.seed = static_cast<std::uint64_t>(seed);
  if (type != "independent" && type != "stratified") {
    params.Ignore("randomization", "the points are always randomised");
  }
  params.CheckAllUsed();
  state.scene.sampler = sampler;
  state.scene.strategy.points = *points;
}

// pbrt's choice of lights; where the file does not say, the strategy's default stays.
static void InterpretLightSampler(ParseState& state, ParamSet& params) {
  static const std::vector<std::string> kNames = {"bvh", "exhaustive", "power",
                                                  "uniform"};
  const std::string name = params.String("lightsampler", "");
  if (name.empty()) return;
  if (std::find(kNames.begin(), kNames.end(), name) == kNames.end()) {
    ThrowUnknown(params.where(), "light sampler", name, kNames);
  }
  LightSelection& selection = state.scene.strategy.light_selection;
  if (name == "uniform") selection = LightSelection::kUniform;
  if (name == "power") selection = LightSelection::kPower;
  if (name == "bvh" || name == "exhaustive") selection = LightSelection::kTree;
  if (name == "exhaustive") {
    state.AddNote(params.where(), "light sampler \"exhaustive\" is replaced by a tree");
  }
}

void InterpretIntegrator(ParseState& state, const std::string& type, ParamSet& params) {
  const IntegratorInfo* found = nullptr;
  std::vector<std::string> names;
  for (const IntegratorInfo& info : Integrators()) {
    if (type == info.name) found = &info;
    names.emplace_back(info.name);
  }
  if (found == nullptr) ThrowUnknown(params.where(), "integrator", type, names);
  const bool ours = type == "path" || type == "volpath";
  if (!ours) {
    state.AddNote(params.where(),
                  fmt::format("integrator {} is replaced by \"path\"", Quoted(type)),
                  type == "ambientocclusion" || type == "function");
  }
  state.scene.integrator.max_depth = params.Integer("maxdepth", 5, 0, 1000000);
  if (ours) {
    InterpretLightSampler(state, params);
    state.scene.integrator.strategy = params.String("strategy", "");
    state.scene.integrator.strategy_where = params.where();
  }
  for (const char* name : found->ignored) {
    // Paths that are made rougher lose their caustics; others only find them otherwise.
    const bool visible = name == std::string_view("regularize");
    const char* why = "the path integrator here does not have it";
    visible ? params.IgnoreVisible(name, why) : params.Ignore(name, why);
  }
  params.CheckAllUsed();
}

}  // namespace lanelight
