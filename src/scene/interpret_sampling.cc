// Sampler and integrator.
#include <algorithm>
#include <limits>

#include "src/scene/interpret.h"
#include "src/scene/suggest.h"

namespace lanelight {
namespace {

constexpr int kMostSamples = std::numeric_limits<int>::max();

struct IntegratorInfo {
  const char* name;
  std::vector<const char*> ignored;  // parameters of pbrt that have no effect here
};

const std::vector<IntegratorInfo>& Integrators() {
  static const std::vector<IntegratorInfo> kIntegrators = {
      {"path", {"lightsampler", "regularize"}},
      {"volpath", {"lightsampler", "regularize"}},
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
  static const std::vector<std::string> kNames = {
      "zsobol", "independent", "paddedsobol", "sobol", "halton", "pmj02bn", "stratified"};
  if (std::find(kNames.begin(), kNames.end(), type) == kNames.end()) {
    ThrowUnknown(params.where(), "sampler", type, kNames);
  }
  Sampler sampler = state.scene.sampler;
  sampler.kind = type == "independent" ? SamplerKind::kIndependent : SamplerKind::kSobol;
  if (type == "stratified") {
    constexpr int kMostStrata = 32768;
    sampler.spp = params.Integer("xsamples", 4, 1, kMostStrata) *
                  params.Integer("ysamples", 4, 1, kMostStrata);
    params.Ignore("jitter", "samples are Owen-scrambled Sobol' points");
  } else {
    sampler.spp = params.Integer("pixelsamples", 16, 1, kMostSamples);
  }
  if (type == "halton" || type == "pmj02bn" || type == "stratified") {
    state.AddNote(params.where(), fmt::format("sampler {} is replaced by Owen-scrambled "
                                              "Sobol' points",
                                              Quoted(type)));
  }
  const int seed = params.Integer("seed", -1, 0, std::numeric_limits<int>::max());
  if (seed >= 0) sampler.seed = static_cast<std::uint64_t>(seed);
  if (type != "independent" && type != "stratified") {
    params.Ignore("randomization", "Sobol' points are always Owen-scrambled");
  }
  params.CheckAllUsed();
  state.scene.sampler = sampler;
}

void InterpretIntegrator(ParseState& state, const std::string& type, ParamSet& params) {
  const IntegratorInfo* found = nullptr;
  std::vector<std::string> names;
  for (const IntegratorInfo& info : Integrators()) {
    if (type == info.name) found = &info;
    names.emplace_back(info.name);
  }
  if (found == nullptr) ThrowUnknown(params.where(), "integrator", type, names);
  if (type != "path") {
    state.AddNote(params.where(),
                  fmt::format("integrator {} is replaced by \"path\"", Quoted(type)));
  }
  state.scene.integrator.max_depth = params.Integer("maxdepth", 5, 0, 1000000);
  for (const char* name : found->ignored) {
    params.Ignore(name, "the path integrator here does not have it");
  }
  params.CheckAllUsed();
}

}  // namespace lanelight
