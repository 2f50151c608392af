// Names and text form of strategies.
#include "src/strategy/strategy.h"

#include <fmt/format.h>

#include "src/strategy/choice_names.h"

namespace lanelight {
namespace {

constexpr ChoiceInfo kChoices[] = {
#define ROW(axis, own, also, name, arguments, meaning, formula, source) \
  {axis, name, arguments, meaning, formula, source},
// clang-format off
#define X(enumerator, ...) ROW("directions", __VA_ARGS__)
    LANELIGHT_DIRECTIONS(X)
#undef X
#define X(enumerator, ...) ROW("points", __VA_ARGS__)
    LANELIGHT_POINTS(X)
#undef X
#define X(enumerator, ...) ROW("pairs", __VA_ARGS__)
    LANELIGHT_PAIRS(X)
#undef X
#define X(enumerator, ...) ROW("control", __VA_ARGS__)
    LANELIGHT_CONTROLS(X)
#undef X
#define X(enumerator, ...) ROW("roulette", __VA_ARGS__)
    LANELIGHT_ROULETTES(X)
#undef X
#define X(enumerator, ...) ROW("light-selection", __VA_ARGS__)
    LANELIGHT_LIGHT_SELECTIONS(X)
#undef X
#define X(enumerator, ...) ROW("seen-lights", __VA_ARGS__)
    LANELIGHT_SEEN_LIGHTS(X)
#undef X
#define X(enumerator, ...) ROW("light-points", __VA_ARGS__)
    LANELIGHT_LIGHT_POINTS(X)
#undef X
#define X(enumerator, ...) ROW("light-candidates", __VA_ARGS__)
    LANELIGHT_LIGHT_CANDIDATE_CHOICES(X)
#undef X
#define X(enumerator, ...) ROW("environment", __VA_ARGS__)
    LANELIGHT_ENVIRONMENT_CHOICES(X)
#undef X
#define X(enumerator, ...) ROW("shadow-roulette", __VA_ARGS__)
    LANELIGHT_SHADOW_ROULETTES(X)
#undef X
#define X(enumerator, ...) ROW("distances", __VA_ARGS__)
    LANELIGHT_DISTANCES(X)
#undef X
#define X(enumerator, ...) ROW("guiding", __VA_ARGS__)
    LANELIGHT_GUIDINGS(X)
#undef X
#define X(enumerator, ...) ROW("reuse", __VA_ARGS__)
    LANELIGHT_REUSES(X)
#undef X
#define X(enumerator, ...) ROW("decide", __VA_ARGS__)
    LANELIGHT_DECISIONS(X)
#undef X
// clang-format on
#undef ROW
};

constexpr PresetInfo kPresets[] = {
    {"paper-plain", "", "the common base: mis, independent points, nothing else"},
    {"paper-uniform", "directions=uniform", "uniform sampling of directions"},
    {"paper-importance", "directions=bsdf", "importance sampling of the BSDF"},
    {"paper-stratified", "points=stratified", "stratified sampling"},
    {"paper-antithetic", "pairs=antithetic", "antithetic variates"},
    {"paper-control", "control=regression", "a control variate, fitted to the samples"},
    {"paper-roulette", "roulette=constant", "Russian roulette"},
};

std::string RouletteText(const Strategy& s) {
  std::string text = Name(s.roulette);
  if (s.roulette == Roulette::kConstant) {
    text += fmt::format(":{}", s.termination);
  } else if (s.floor || s.first || s.scale != 1) {
    text += fmt::format(":{}", s.Floor());
  }
  if (s.first || s.scale != 1) text += fmt::format(":{}", s.First());
  return s.scale != 1 ? text + fmt::format(":{}", s.scale) : text;
}

std::string LightText(const Strategy& s) {
  std::string text = fmt::format(",light-points={},light-candidates={}",
                                 Name(s.light_points), Name(s.light_candidates));
  if (s.light_candidates == LightCandidates::kResampled) {
    text += fmt::format(":{}", s.candidates);
  }
  text += fmt::format(",environment={},shadow-roulette={}", Name(s.environment),
                      Name(s.shadow_roulette));
  return s.shadow_floor ? text + fmt::format(":{}", *s.shadow_floor) : text;
}

std::string ReuseText(const Strategy& s) {
  if (s.reuse == Reuse::kNone) return Name(s.reuse);
  return fmt::format("{}:{}:{}", Name(s.reuse), s.reused_paths, Name(s.block_layout));
}

}  // namespace

std::string ToText(const Strategy& s) {
  std::string text = fmt::format("directions={}", Name(s.directions));
  if (s.directions == Directions::kMis) {
    text += fmt::format(":{}", kHeuristics[static_cast<int>(s.heuristic)]);
  }
  text += fmt::format(",points={},pairs={}", Name(s.points), Name(s.pairs));
  if (s.pairs == Pairs::kAntithetic) text += fmt::format(":{}", Name(s.paired));
  text += fmt::format(",control={}", Name(s.control));
  if (s.control != Control::kNone) {
    text += s.coefficient ? fmt::format(",c={}", *s.coefficient) : ",c=optimal";
  }
  text += fmt::format(",roulette={},light-selection={},seen-lights={}", RouletteText(s),
                      Name(s.light_selection), Name(s.seen_lights));
  return text + LightText(s) +
         fmt::format(",distances={},guiding={},reuse={},decide={}", Name(s.distances),
                     Name(s.guiding), ReuseText(s), Name(s.decide));
}

std::span<const ChoiceInfo> AllChoices() { return kChoices; }
std::span<const PresetInfo> AllPresets() { return kPresets; }

const char* Name(Directions choice) { return kDirections[static_cast<int>(choice)]; }
const char* Name(Points choice) { return kPoints[static_cast<int>(choice)]; }
const char* Name(Pairs choice) { return kPairs[static_cast<int>(choice)]; }
const char* Name(Control choice) { return kControls[static_cast<int>(choice)]; }
const char* Name(Roulette choice) { return kRoulettes[static_cast<int>(choice)]; }
const char* Name(LightSelection choice) {
  return kLightSelections[static_cast<int>(choice)];
}
const char* Name(SeenLights choice) { return kSeenLights[static_cast<int>(choice)]; }
const char* Name(LightPoints choice) { return kLightPoints[static_cast<int>(choice)]; }
const char* Name(LightCandidates choice) {
  return kLightCandidateChoices[static_cast<int>(choice)];
}
const char* Name(EnvironmentPoints choice) {
  return kEnvironmentPoints[static_cast<int>(choice)];
}
const char* Name(ShadowRoulette choice) {
  return kShadowRoulettes[static_cast<int>(choice)];
}
const char* Name(Distances choice) { return kDistances[static_cast<int>(choice)]; }
const char* Name(Guiding choice) { return kGuidings[static_cast<int>(choice)]; }
const char* Name(Reuse choice) { return kReuses[static_cast<int>(choice)]; }
const char* Name(BlockLayout choice) { return kBlockLayouts[static_cast<int>(choice)]; }
const char* Name(Decide choice) { return kDecisions[static_cast<int>(choice)]; }
const char* Name(Paired choice) { return kPaired[static_cast<int>(choice)]; }

}  // namespace lanelight
