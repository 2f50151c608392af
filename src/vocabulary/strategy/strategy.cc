// Names and text form of strategies.
#include "src/vocabulary/strategy/strategy.h"

#include <fmt/format.h>

namespace lanelight {
namespace {

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
  return text + fmt::format(",environment={}", Name(s.environment));
}

std::string ReuseText(const Strategy& s) {
  if (s.reuse == Reuse::kNone) return Name(s.reuse);
  return fmt::format("{}:{}:{}", Name(s.reuse), s.reused_paths, Name(s.block_layout));
}

std::string LightPathsText(const Strategy& s) {
  if (s.light_paths == LightPaths::kNone) return Name(s.light_paths);
  return fmt::format("{}:{}", Name(s.light_paths), s.light_path_samples);
}

}  // namespace

std::string ToText(const Strategy& s) {
  std::string text = fmt::format("directions={}", Name(s.directions));
  if (s.directions == Directions::kMis) {
    text += fmt::format(":{}", kHeuristicNames[static_cast<int>(s.heuristic)]);
  }
  text += fmt::format(",points={},pairs={}", Name(s.sampler), Name(s.pairs));
  text += fmt::format(",control={}", Name(s.control));
  if (s.control != Control::kNone) {
    text += s.coefficient ? fmt::format(",c={}", *s.coefficient) : ",c=optimal";
  }
  text += fmt::format(",roulette={},light-selection={},seen-lights={}", RouletteText(s),
                      Name(s.light_selection), Name(s.visible_lights));
  return text + LightText(s) +
         fmt::format(",distances={},pixel-samples={},reuse={},light-paths={},decide={}",
                     Name(s.distances), Name(s.pixel_samples), ReuseText(s),
                     LightPathsText(s), Name(s.decide));
}

std::span<const ChoiceInfo> AllChoices() {
  static constexpr ChoiceInfo kChoices[] = {
#define X(Type, key, enumerator, own, also, name, arguments, meaning, formula, source) \
  {key, name, arguments, meaning, formula, source},
#define LANELIGHT_AXIS(Type, member, key, CHOICES) CHOICES(X, Type, key)
      LANELIGHT_AXES(LANELIGHT_AXIS)
#undef LANELIGHT_AXIS
#undef X
  };
  return kChoices;
}

std::span<const PresetInfo> AllPresets() { return kPresets; }

#define LANELIGHT_NAME(Type, ...) \
  const char* Name(Type choice) { return k##Type##Names[static_cast<int>(choice)]; }
LANELIGHT_AXES(LANELIGHT_NAME)
LANELIGHT_NAME(BlockLayout)
#undef LANELIGHT_NAME

}  // namespace lanelight
