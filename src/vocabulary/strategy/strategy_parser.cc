// The text of a strategy: key=value,... after an optional preset.
#include <fast_float/fast_float.h>
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <iterator>

#include "src/base/core/source_location.h"
#include "src/base/core/suggest.h"
#include "src/vocabulary/strategy/strategy.h"

namespace lanelight {
namespace {

constexpr const char* kKeys[] = {
#define LANELIGHT_AXIS(Type, member, key, ...) key,
    LANELIGHT_AXES(LANELIGHT_AXIS)
#undef LANELIGHT_AXIS
        "c"};

constexpr const char kPlain[] =
    "directions=mis:power,points=independent,pairs=none,control=none,c=optimal,"
    "roulette=none,light-selection=power,seen-lights=paths,light-points=area,"
    "light-candidates=single,environment=plain,"
    "distances=exponential,pixel-samples=own,reuse=none,light-paths=none,decide=none";

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
  using Parts = std::vector<std::string_view>;  // a name and its arguments

  [[noreturn]] void Fail(const std::string& message) const {
    throw InputError(where_, fmt::format("strategy {}: {}", Quoted(text_), message));
  }

  void Item(std::string_view item, bool first) {
    const std::size_t equals = item.find('=');
    if (equals == std::string_view::npos) return Preset(item, first);
    Set(item.substr(0, equals), item.substr(equals + 1));
  }

  void Preset(std::string_view name, bool first) {
    std::vector<std::string> names = {kDefaultStrategyName};
    if (name == names.front() && first) {
      strategy_ = {};
      return;
    }
    for (const PresetInfo& preset : AllPresets()) {
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

  // The value of a key by one of its names.
  template <class Choice, std::size_t kSize>
  void Choose(std::string_view key, std::string_view found,
              const char* const (&names)[kSize], Choice& choice) const {
    const auto* name = std::find(names, names + kSize, found);
    if (name == names + kSize) {
      Unknown(fmt::format("value of {}=:", key), found, {names, names + kSize});
    }
    choice = static_cast<Choice>(name - names);
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

  void Set(std::string_view key, std::string_view value) {
    if (key == "c") return SetCoefficient(value);
#define LANELIGHT_AXIS(Type, member, axis, ...) \
  if (key == axis) return SetAxis(key, value, k##Type##Names, strategy_.member);
    LANELIGHT_AXES(LANELIGHT_AXIS)
#undef LANELIGHT_AXIS
    Unknown("key", key, {std::begin(kKeys), std::end(kKeys)});
  }

  // "name:argument:..."
  template <class Choice, std::size_t kSize>
  void SetAxis(std::string_view key, std::string_view value,
               const char* const (&names)[kSize], Choice& choice) {
    Parts parts;
    for (std::size_t colon = 0; colon != value.npos;) {
      colon = value.find(':');
      parts.push_back(value.substr(0, colon));
      if (colon != value.npos) value.remove_prefix(colon + 1);
    }
    Choose(key, parts[0], names, choice);
    key_ = key;
    SetArguments(choice, parts);
  }

  // Returns whether there are arguments, of which a choice takes at most so many.
  bool Has(const Parts& parts, std::size_t max_parts) const {
    if (parts.size() <= max_parts + 1) return parts.size() > 1;
    if (max_parts == 0)
      Fail(fmt::format("\"{}\" of {} takes no argument", parts[0], key_));
    Fail(fmt::format("\"{}\" of {} takes at most {} arguments after ':'", parts[0], key_,
                     max_parts));
  }

  template <class Choice>
  void SetArguments(Choice, const Parts& parts) {
    Has(parts, 0);
  }

  void SetCoefficient(std::string_view value) {
    strategy_.coefficient.reset();
    if (value != "optimal") strategy_.coefficient = Number("c", value, -1e6, 1e6);
  }

  void SetArguments(Directions directions, const Parts& parts) {
    strategy_.heuristic = Heuristic::kPower;
    if (!Has(parts, directions == Directions::kMis ? 1 : 0)) return;
    Choose("directions=mis", parts[1], kHeuristicNames, strategy_.heuristic);
  }

  void SetArguments(LightCandidates candidates, const Parts& parts) {
    strategy_.candidates = kDefaultLightCandidates;
    if (!Has(parts, candidates == LightCandidates::kSingle ? 0 : 1)) return;
    const double m =
        Number("light-candidates=resampled", parts[1], 2, kMaxLightCandidates);
    if (m != std::floor(m)) Fail("the number of light candidates must be whole");
    strategy_.candidates = static_cast<std::uint32_t>(m);
  }

  void SetArguments(Reuse reuse, const Parts& parts) {
    strategy_.reused_paths = kDefaultReusedPaths;
    strategy_.block_layout = BlockLayout::kRandom;
    if (!Has(parts, reuse == Reuse::kNone ? 0 : 2)) return;
    const double n = Number("reuse=block", parts[1], kMinReusedPaths, kMaxReusedPaths);
    strategy_.reused_paths = static_cast<std::uint32_t>(n);
    if (n != strategy_.reused_paths || !std::has_single_bit(strategy_.reused_paths)) {
      Fail(
          "the number of paths of a block must be a power of two: 2, 4, 8, 16, 32 or 64");
    }
    if (parts.size() < 3) return;
    Choose("reuse=block:N", parts[2], kBlockLayoutNames, strategy_.block_layout);
  }

  void SetArguments(LightPaths paths, const Parts& parts) {
    strategy_.light_path_samples = kDefaultLightPathSamples;
    if (!Has(parts, paths == LightPaths::kNone ? 0 : 1)) return;
    const double n = Number("light-paths=splats:N", parts[1], 1, kMaxLightPathSamples);
    if (n != std::floor(n))
      Fail("the number of camera samples per light subpath must be whole");
    strategy_.light_path_samples = static_cast<std::uint32_t>(n);
  }

  void SetArguments(Roulette roulette, const Parts& parts) {
    const bool by_throughput = roulette == Roulette::kThroughput;
    strategy_.termination = Strategy{}.termination;
    strategy_.floor.reset();
    strategy_.first.reset();
    strategy_.scale = 1;
    const bool constant = roulette == Roulette::kConstant;
    if (!Has(parts, by_throughput ? 3 : constant ? 2 : 0)) return;
    if (constant) {
      strategy_.termination = Number("roulette=constant", parts[1], 0.001, 0.999);
    } else {
      strategy_.floor = Number("roulette", parts[1], 0, 1);
    }
    if (parts.size() < 3) return;
    const double first = Number("roulette", parts[2], 1, 1000000);
    if (first != std::floor(first)) Fail("the first event of roulette must be whole");
    strategy_.first = static_cast<std::uint32_t>(first);
    if (parts.size() < 4) return;
    strategy_.scale = Number("roulette=throughput", parts[3], 0.1, 100);
  }

  std::string_view text_, key_;
  const SourceLocation& where_;
  Strategy& strategy_;
};

}  // namespace

StrategyChanges ParseStrategy(std::string_view text, const SourceLocation& where) {
  Strategy any;
  ApplyStrategy(text, where, any);
  return {std::string(text)};
}

std::string JoinedChanges(const std::string& first, const std::string& then) {
  return first + (first.empty() || then.empty() ? "" : ",") + then;
}

void Apply(const StrategyChanges& changes, Strategy& strategy) {
  ApplyStrategy(changes.text, {}, strategy);
}

void ApplyStrategy(std::string_view text, const SourceLocation& where,
                   Strategy& strategy) {
  if (text.empty()) return;
  Strategy changed = strategy;  // a text that is not understood changes nothing
  Parser(text, where, changed).Parse();
  strategy = changed;
}

}  // namespace lanelight
