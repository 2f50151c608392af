// Names, text form and parser of strategies.
#include "src/strategy/strategy.h"

#include <fast_float/fast_float.h>
#include <fmt/format.h>

#include <array>
#include <cmath>

#include "src/core/suggest.h"

namespace lanelight {
namespace {

constexpr ChoiceInfo kChoices[] = {
#define ROW(axis, name, arguments, meaning, formula, source) \
  {axis, name, arguments, meaning, formula, source},
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
#undef ROW
};

#define FIRST(name, ...) name
#define X(enumerator, ...) FIRST(__VA_ARGS__, ),
constexpr const char* kDirections[] = {LANELIGHT_DIRECTIONS(X)};
constexpr const char* kPoints[] = {LANELIGHT_POINTS(X)};
constexpr const char* kPairs[] = {LANELIGHT_PAIRS(X)};
constexpr const char* kControls[] = {LANELIGHT_CONTROLS(X)};
constexpr const char* kRoulettes[] = {LANELIGHT_ROULETTES(X)};
constexpr const char* kLightSelections[] = {LANELIGHT_LIGHT_SELECTIONS(X)};
constexpr const char* kPaired[] = {LANELIGHT_PAIRED(X)};
#undef X
#undef FIRST
constexpr const char* kHeuristics[] = {"power", "balance"};

constexpr const char kPlain[] =
    "directions=mis:power,points=independent,pairs=none,control=none,c=optimal,"
    "roulette=none,light-selection=power";
constexpr PresetInfo kPresets[] = {
    {"paper-plain", "", "the common base: mis, independent points, nothing else"},
    {"paper-uniform", "directions=uniform", "uniform sampling of directions"},
    {"paper-importance", "directions=bsdf", "importance sampling of the BSDF"},
    {"paper-stratified", "points=stratified", "stratified sampling"},
    {"paper-antithetic", "pairs=antithetic", "antithetic variates"},
    {"paper-control", "control=analytic", "a control variate for direct light"},
    {"paper-roulette", "roulette=constant:0.25", "Russian roulette"},
};

class Parser {
 public:
  Parser(std::string_view text, const SourceLocation& where, Strategy& strategy)
      : text_(text), where_(where), strategy_(strategy) {}

  void Parse() {
    bool first = true;
    for (std::string_view rest = text_; !rest.empty() || !first;) {
      const std::size_t comma = rest.find(',');
      Item(rest.substr(0, comma), first);
      first = false;
      if (comma == std::string_view::npos) break;
      rest.remove_prefix(comma + 1);
    }
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
    for (const PresetInfo& preset : kPresets) {
      names.emplace_back(preset.name);
      if (name != preset.name) continue;
      if (!first) Fail(fmt::format("preset {} must come first", Quoted(name)));
      strategy_ = {};
      ApplyStrategy(kPlain, where_, strategy_);
      ApplyStrategy(preset.changes, where_, strategy_);
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
    if (key == "directions") return SetDirections(value);
    if (key == "points") {
      strategy_.points = static_cast<Points>(Choose(key, value, kPoints));
    } else if (key == "pairs") {
      SetPairs(value);
    } else if (key == "control") {
      strategy_.control = static_cast<Control>(Choose(key, value, kControls));
    } else if (key == "c") {
      strategy_.coefficient.reset();
      if (value != "optimal") strategy_.coefficient = Number(key, value, -1e6, 1e6);
    } else if (key == "roulette") {
      SetRoulette(value);
    } else if (key == "light-selection") {
      strategy_.light_selection =
          static_cast<LightSelection>(Choose(key, value, kLightSelections));
    } else {
      Unknown("key", key,
              {"directions", "points", "pairs", "control", "c", "roulette",
               "light-selection"});
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

  void SetRoulette(std::string_view value) {
    const auto parts = Parts("roulette", value, 3);
    const auto kind = static_cast<Roulette>(Choose("roulette", parts[0], kRoulettes));
    strategy_.roulette = kind;
    strategy_.termination = Strategy{}.termination;
    strategy_.floor.reset();
    strategy_.first.reset();
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
  }

  std::string_view text_;
  const SourceLocation& where_;
  Strategy& strategy_;
};

std::string RouletteText(const Strategy& s) {
  std::string text = Name(s.roulette);
  if (s.roulette == Roulette::kConstant) {
    text += fmt::format(":{}", s.termination);
  } else if (s.floor || s.first) {
    text += fmt::format(":{}", s.Floor());
  }
  if (s.first) text += fmt::format(":{}", *s.first);
  return text;
}

}  // namespace

void ApplyStrategy(std::string_view text, const SourceLocation& where,
                   Strategy& strategy) {
  if (!text.empty()) Parser(text, where, strategy).Parse();
}

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
  return text + fmt::format(",roulette={},light-selection={}", RouletteText(s),
                            Name(s.light_selection));
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
const char* Name(Paired choice) { return kPaired[static_cast<int>(choice)]; }

}  // namespace lanelight
