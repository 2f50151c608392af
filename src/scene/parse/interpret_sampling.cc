#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "src/base/core/suggest.h"
#include "src/scene/parse/interpret.h"

namespace lanelight {
namespace {

constexpr int kMaxSamples = std::numeric_limits<int>::max();

// Names, and their parameters that have no effect here.
using Ignored = std::vector<std::pair<const char*, std::vector<const char*>>>;

const Ignored kIntegrators = {
    {"path", {}},
    {"volpath", {}},
    {"simplepath", {"samplebsdf", "samplelights"}},
    {"simplevolpath", {}},
    {"ambientocclusion", {"cossample", "maxdistance"}},
    {"bdpt", {"lightsampler", "visualizestrategies", "visualizeweights"}},
    {"function", {"function", "skipbad", "imagefilename"}},
    {"lightpath", {}},
    {"mlt",
     {"bootstrapsamples", "chains", "largestepprobability", "mutationsperpixel",
      "sigma"}},
    {"randomwalk", {}},
    {"sppm", {"iterations", "photonsperiteration", "radius", "seed"}}};

const Ignored kAccelerators = {
    {"bvh", {"maxnodeprims", "splitmethod"}},
    {"kdtree", {"intersectcost", "traversalcost", "emptybonus", "maxprims", "maxdepth"}}};

// Without a light sampler in the file, the strategy's default stays.
void InterpretLightSampler(ParseState& state, ParamSet& params) {
  static constexpr std::pair<const char*, LightSelection> kSelections[] = {
      {"bvh", LightSelection::kTree},
      {"exhaustive", LightSelection::kTree},
      {"power", LightSelection::kPower},
      {"uniform", LightSelection::kUniform}};
  const std::string name = params.String("lightsampler", "");
  if (name.empty()) return;
  state.scene.strategy.light_selection =
      Lookup(kSelections, name, params.where(), "light sampler");
  if (name == "exhaustive") {
    state.AddNote(params.where(), "light sampler \"exhaustive\" is replaced by a tree");
  }
}

}  // namespace

void InterpretSampler(ParseState& state, const std::string& type, ParamSet& params) {
  static constexpr std::pair<const char*, SampleSequence> kSamplers[] = {
      {"zsobol", SampleSequence::kSobol},
      {"independent", SampleSequence::kIndependent},
      {"paddedsobol", SampleSequence::kSobol},
      {"sobol", SampleSequence::kSobol},
      {"halton", SampleSequence::kHalton},
      {"pmj02bn", SampleSequence::kSobol},
      {"stratified", SampleSequence::kStratified}};
  const SampleSequence sequence = Lookup(kSamplers, type, params.where(), "sampler");
  if (type == "pmj02bn") {
    state.AddNote(params.where(), "sampler \"pmj02bn\" is replaced by \"sobol\"");
  }
  Sampler sampler = state.scene.sampler;
  if (type == "stratified") {
    constexpr int kMaxStrata = 32768;
    sampler.spp = params.Integer("xsamples", 4, {1, kMaxStrata}) *
                  params.Integer("ysamples", 4, {1, kMaxStrata});
    params.Ignore("jitter", "strata are always jittered");
  } else {
    sampler.spp = params.Integer("pixelsamples", 16, {1, kMaxSamples});
  }
  const int seed = params.Integer("seed", -1, {0, std::numeric_limits<int>::max()});
  if (seed >= 0) sampler.seed = static_cast<std::uint64_t>(seed);
  if (type != "independent" && type != "stratified") {
    params.Ignore("randomization", "the sample sequence is always randomised");
  }
  params.CheckAllUsed();
  state.scene.sampler = sampler;
  state.scene.strategy.sampler = sequence;
}

void InterpretIntegrator(ParseState& state, const std::string& type, ParamSet& params) {
  const auto& ignored = Lookup(kIntegrators, type, params.where(), "integrator");
  const bool ours = type == "path" || type == "volpath";
  if (!ours) {
    const bool changes_image = type == "ambientocclusion" || type == "function";
    const bool finds_caustics = type == "mlt" || type == "sppm";
    if (type == "bdpt" || type == "lightpath") {
      state.scene.integrator.from_lights = params.where();
    }
    state.scene.notes.push_back(
        {params.where(),
         fmt::format(
             "integrator {} is replaced by \"path\"{}", Quoted(type),
             finds_caustics ? "; for caustics use --strategy light-paths=splats" : ""),
         changes_image});
  }
  state.scene.integrator.max_depth = params.Integer("maxdepth", 5, {0, 1000000});
  if (ours) {
    InterpretLightSampler(state, params);
    state.scene.integrator.strategy = params.String("strategy", "");
    state.scene.integrator.strategy_where = params.where();
    if (params.Find("transport", {ParamType::kString}) != nullptr) {
      state.scene.integrator.transport = params.Choice<Transport>(
          "transport", {{"rgb", Transport::kRgb}, {"spectral", Transport::kSpectral}});
    }
  }
  const bool regularizes = type == "bdpt" || type == "mlt" || type == "sppm";
  if (ours || regularizes) {
    state.scene.integrator.regularize = params.Bool("regularize", false);
  }
  for (const char* name : ignored) {
    params.Ignore(name, "the path integrator has no such option");
  }
  params.CheckAllUsed();
}

void InterpretAccelerator(const std::string& type, ParamSet& params) {
  for (const char* name : Lookup(kAccelerators, type, params.where(), "accelerator")) {
    params.Ignore(name, "the BVH is the only accelerator");
  }
  params.CheckAllUsed();
}

}  // namespace lanelight
