// The text of a strategy: key=value,... after an optional preset.
#include <fast_float/fast_float.h>
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <iterator>

#include "src/core/suggest.h"
#include "src/strategy/choice_names.h"
#include "src/strategy/strategy.h"

namespace lanelight {
namespace {

// By StrategyKey.
constexpr const char* kKeys[] = {
    "directions",  "points",          "pairs",       "control",      "c",
    "roulette",    "light-selection", "seen-lights", "light-points", "light-candidates",
    "environment", "shadow-roulette", "distances",   "guiding",      "reuse",
    "decide"};
static_assert(std::size(kKeys) == static_cast<std::size_t>(StrategyKey::kCount));

constexpr const char kPlain[] =
    "directions=mis:power,points=independent,pairs=none,control=none,c=optimal,"
    "roulette=none,light-selection=power,seen-lights=paths,light-points=area,"
    "light-candidates=single,environment=plain,shadow-roulette=none,"
    "distances=exponential,guiding=none,"
    "reuse=none,decide=none";

class Parser {
 public:
  Parser(std::string_view text, const SourceLocation& where)
      : text_(text), where_(where) {}

  StrategyChanges Parse() {
    bool first = true;
    for (std::string_view rest = text_; !rest.empty() || !first;) {
      const std::size_t comma = rest.find(',');
      Item(rest.substr(0, comma), first);
      first = false;
      if (comma == std::string_view::npos) break;
      rest.remove_prefix(comma + 1);
    }
    return changes_;
  }

 private:
  [[noreturn]] void Fail(const std::string& message) const {
    throw InputError(where_, fmt::format("strategy {}: {}", Quoted(text_), message));
  }

  void Item(std::string_view item, bool first) {
    const std::size_t equals = item.find('=');
    if (equals == std::string_view::npos) return Preset(item, first);
    Set(item.substr(0, equals), item.substr(equals + 1));
  }

  void Preset(std::string_view name, bool first) {
    std::vector<std::string> names;
    for (const PresetInfo& preset : AllPresets()) {
      names.emplace_back(preset.name);
      if (name != preset.name) continue;
      if (!first) Fail(fmt::format("preset {} must come first", Quoted(name)));
      strategy_ = {};
      ApplyStrategy(kPlain, where_, strategy_);
      ApplyStrategy(preset.changes, where_, strategy_);
      changes_.keys.set();
      return;
    }
    if (name.empty()) Fail("empty item: expected key=value,...");
    Unknown("preset (or a key without =value)", name, names);
  }

  [[noreturn]] void Unknown(std::string_view kind, std::string_view found,
                            const std::vector<std::string>& known) const {
    const std::string nearest = NearestName(found, known);
    Fail(fmt::format("unknown {} {}; {}supported: {}", kind, Quoted(found),
                     nearest.empty() ? "" : "did you mean " + Quoted(nearest) + "? ",
                     QuotedList(known)));
  }

  // Index of `found` among the names of a key.
  template <std::size_t kSize>
  std::size_t Choose(std::string_view key, std::string_view found,
                     const char* const (&names)[kSize]) const {
    for (std::size_t i = 0; i < kSize; ++i) {
      if (found == names[i]) return i;
    }
    Unknown(fmt::format("value of \"{}\"", key), found, {names, names + kSize});
  }

  double Number(std::string_view key, std::string_view text, double low,
                double high) const {
    double value = 0;
    const auto [end, error] =
        fast_float::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || !(value >= low) ||
        !(value <= high)) {
      Fail(fmt::format("{} of \"{}\" is not a number from {} to {}", Quoted(text), key,
                       low, high));
    }
    return value;
  }

  // Splits "name:a:b" into at most `most` parts.
  std::vector<std::string_view> Parts(std::string_view key, std::string_view value,
                                      std::size_t most) const {
    std::vector<std::string_view> parts;
    for (;;) {
      const std::size_t colon = value.find(':');
      parts.push_back(value.substr(0, colon));
      if (colon == std::string_view::npos) break;
      value.remove_prefix(colon + 1);
    }
    if (parts.size() > most) {
      Fail(fmt::format("\"{}\" of {} takes at most {} arguments after ':'", parts[0], key,
                       most - 1));
    }
    return parts;
  }

  void Set(std::string_view key, std::string_view value) {
    const auto* end = std::end(kKeys);
    const auto* found = std::find(std::begin(kKeys), end, key);
    if (found == end) Unknown("key", key, {std::begin(kKeys), end});
    const auto changed = static_cast<StrategyKey>(found - kKeys);
    SetValue(changed, key, value);
    changes_.keys.set(static_cast<std::size_t>(changed));
  }

  void SetValue(StrategyKey changed, std::string_view key, std::string_view value) {
    switch (changed) {
      case StrategyKey::kDirections:
        return SetDirections(value);
      case StrategyKey::kPoints:
        strategy_.points = static_cast<Points>(Choose(key, value, kPoints));
        return;
      case StrategyKey::kPairs:
        return SetPairs(value);
      case StrategyKey::kControl:
        strategy_.control = static_cast<Control>(Choose(key, value, kControls));
        return;
      case StrategyKey::kCoefficient:
        strategy_.coefficient.reset();
        if (value != "optimal") strategy_.coefficient = Number(key, value, -1e6, 1e6);
        return;
      case StrategyKey::kRoulette:
        return SetRoulette(value);
      case StrategyKey::kLightSelection:
        strategy_.light_selection =
            static_cast<LightSelection>(Choose(key, value, kLightSelections));
        return;
      case StrategyKey::kSeenLights:
        strategy_.seen_lights = static_cast<SeenLights>(Choose(key, value, kSeenLights));
        return;
      case StrategyKey::kLightPoints:
        strategy_.light_points =
            static_cast<LightPoints>(Choose(key, value, kLightPoints));
        return;
      case StrategyKey::kLightCandidates:
        return SetLightCandidates(value);
      case StrategyKey::kEnvironment:
        strategy_.environment =
            static_cast<EnvironmentPoints>(Choose(key, value, kEnvironmentPoints));
        return;
      case StrategyKey::kShadowRoulette:
        return SetShadowRoulette(value);
      case StrategyKey::kDistances:
        strategy_.distances = static_cast<Distances>(Choose(key, value, kDistances));
        return;
      case StrategyKey::kGuiding:
        strategy_.guiding = static_cast<Guiding>(Choose(key, value, kGuidings));
        return;
      case StrategyKey::kReuse:
        return SetReuse(value);
      case StrategyKey::kDecide:
        strategy_.decide = static_cast<Decide>(Choose(key, value, kDecisions));
        return;
      case StrategyKey::kCount:
        return;
    }
  }

  void SetDirections(std::string_view value) {
    const auto parts = Parts("directions", value, 2);
    strategy_.directions =
        static_cast<Directions>(Choose("directions", parts[0], kDirections));
    strategy_.heuristic = Heuristic::kPower;
    if (parts.size() < 2) return;
    if (strategy_.directions != Directions::kMis) {
      Fail(fmt::format("\"{}\" of directions takes no argument", parts[0]));
    }
    strategy_.heuristic =
        static_cast<Heuristic>(Choose("directions=mis", parts[1], kHeuristics));
  }

  void SetPairs(std::string_view value) {
    const auto parts = Parts("pairs", value, 2);
    strategy_.pairs = static_cast<Pairs>(Choose("pairs", parts[0], kPairs));
    strategy_.paired = Paired::kAll;
    if (parts.size() < 2) return;
    if (strategy_.pairs == Pairs::kNone) Fail("\"none\" of pairs takes no argument");
    strategy_.paired = static_cast<Paired>(Choose("pairs=antithetic", parts[1], kPaired));
  }

  void SetLightCandidates(std::string_view value) {
    const auto parts = Parts("light-candidates", value, 2);
    strategy_.light_candidates = static_cast<LightCandidates>(
        Choose("light-candidates", parts[0], kLightCandidateChoices));
    strategy_.candidates = kDefaultLightCandidates;
    if (parts.size() < 2) return;
    if (strategy_.light_candidates == LightCandidates::kSingle) {
      Fail("\"single\" of light-candidates takes no argument");
    }
    const double m =
        Number("light-candidates=resampled", parts[1], 2, kMostLightCandidates);
    if (m != std::floor(m)) Fail("the number of light candidates must be whole");
    strategy_.candidates = static_cast<std::uint32_t>(m);
  }

  void SetReuse(std::string_view value) {
    const auto parts = Parts("reuse", value, 3);
    strategy_.reuse = static_cast<Reuse>(Choose("reuse", parts[0], kReuses));
    strategy_.reused_paths = kDefaultReusedPaths;
    strategy_.block_layout = BlockLayout::kRandom;
    if (parts.size() < 2) return;
    if (strategy_.reuse == Reuse::kNone) Fail("\"none\" of reuse takes no argument");
    const double n = Number("reuse=block", parts[1], kLeastReusedPaths, kMostReusedPaths);
    strategy_.reused_paths = static_cast<std::uint32_t>(n);
    if (n != strategy_.reused_paths || !std::has_single_bit(strategy_.reused_paths)) {
      Fail(
          "the number of paths of a block must be a power of two: 2, 4, 8, 16, 32 or 64");
    }
    if (parts.size() < 3) return;
    strategy_.block_layout =
        static_cast<BlockLayout>(Choose("reuse=block:N", parts[2], kBlockLayouts));
  }

  void SetShadowRoulette(std::string_view value) {
    const auto parts = Parts("shadow-roulette", value, 2);
    strategy_.shadow_roulette = static_cast<ShadowRoulette>(
        Choose("shadow-roulette", parts[0], kShadowRoulettes));
    strategy_.shadow_floor.reset();
    if (parts.size() < 2) return;
    if (strategy_.shadow_roulette == ShadowRoulette::kNone) {
      Fail("\"none\" of shadow-roulette takes no argument");
    }
    strategy_.shadow_floor = Number("shadow-roulette", parts[1], 0.001, 1);
  }

  void SetRoulette(std::string_view value) {
    const auto parts = Parts("roulette", value, value.starts_with("throughput") ? 4 : 3);
    const auto kind = static_cast<Roulette>(Choose("roulette", parts[0], kRoulettes));
    strategy_.roulette = kind;
    strategy_.termination = Strategy{}.termination;
    strategy_.floor.reset();
    strategy_.first.reset();
    strategy_.scale = 1;
    if (parts.size() < 2) return;
    if (kind == Roulette::kConstant) {
      strategy_.termination = Number("roulette=constant", parts[1], 0.001, 0.999);
    } else if (kind == Roulette::kThroughput || kind == Roulette::kLuminance) {
      strategy_.floor = Number("roulette", parts[1], 0, 1);
    } else {
      Fail(fmt::format("\"{}\" of roulette takes no argument", parts[0]));
    }
    if (parts.size() < 3) return;
    const double first = Number("roulette", parts[2], 1, 1000000);
    if (first != std::floor(first)) Fail("the first event of roulette must be whole");
    strategy_.first = static_cast<std::uint32_t>(first);
    if (parts.size() < 4) return;
    strategy_.scale = Number("roulette=throughput", parts[3], 0.1, 100);
  }

  std::string_view text_;
  const SourceLocation& where_;
  StrategyChanges changes_;
  Strategy& strategy_ = changes_.values;
};

}  // namespace

StrategyChanges ParseStrategy(std::string_view text, const SourceLocation& where) {
  if (text.empty()) return {};
  return Parser(text, where).Parse();
}

void Apply(const StrategyChanges& changes, Strategy& strategy) {
  const Strategy& from = changes.values;
  const auto has = [&](StrategyKey key) {
    return changes.keys.test(static_cast<std::size_t>(key));
  };
  if (has(StrategyKey::kDirections)) {
    strategy.directions = from.directions;
    strategy.heuristic = from.heuristic;
  }
  if (has(StrategyKey::kPoints)) strategy.points = from.points;
  if (has(StrategyKey::kPairs)) {
    strategy.pairs = from.pairs;
    strategy.paired = from.paired;
  }
  if (has(StrategyKey::kControl)) strategy.control = from.control;
  if (has(StrategyKey::kCoefficient)) strategy.coefficient = from.coefficient;
  if (has(StrategyKey::kRoulette)) {
    strategy.roulette = from.roulette;
    strategy.termination = from.termination;
    strategy.floor = from.floor;
    strategy.first = from.first;
    strategy.scale = from.scale;
  }
  if (has(StrategyKey::kLightSelection)) strategy.light_selection = from.light_selection;
  if (has(StrategyKey::kSeenLights)) strategy.seen_lights = from.seen_lights;
  if (has(StrategyKey::kLightPoints)) strategy.light_points = from.light_points;
  if (has(StrategyKey::kLightCandidates)) {
    strategy.light_candidates = from.light_candidates;
    strategy.candidates = from.candidates;
  }
  if (has(StrategyKey::kEnvironment)) strategy.environment = from.environment;
  if (has(StrategyKey::kShadowRoulette)) {
    strategy.shadow_roulette = from.shadow_roulette;
    strategy.shadow_floor = from.shadow_floor;
  }
  if (has(StrategyKey::kDistances)) strategy.distances = from.distances;
  if (has(StrategyKey::kGuiding)) strategy.guiding = from.guiding;
  if (has(StrategyKey::kReuse)) {
    strategy.reuse = from.reuse;
    strategy.reused_paths = from.reused_paths;
    strategy.block_layout = from.block_layout;
  }
  if (has(StrategyKey::kDecide)) strategy.decide = from.decide;
}

void ApplyStrategy(std::string_view text, const SourceLocation& where,
                   Strategy& strategy) {
  Apply(ParseStrategy(text, where), strategy);
}

}  // namespace lanelight
