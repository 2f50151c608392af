// A strategy: one choice per axis, each orthogonal to the others. The choices and their
// meaning: choices.h. Text form: `key=value,...`, optionally after the name of a preset.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "src/vocabulary/strategy/choices.h"

namespace lanelight {

struct SourceLocation;  // src/base/core/source_location.h

enum class Heuristic : std::uint8_t { kPower, kBalance };
inline constexpr const char* kHeuristicNames[] = {"power", "balance"};

inline constexpr std::uint32_t kMaxLightCandidates = 64;
/// Numbers of paths that reuse=block connects: powers of two.
/// Side of the tiles, in pixels, whose paths it may connect.
inline constexpr std::int32_t kReuseTile = 16;
inline constexpr std::uint32_t kMaxLightPathSamples = 1024;
inline constexpr std::uint32_t kMinReusedPaths = 2, kMaxReusedPaths = 64;

struct Strategy {
  Directions directions = Directions::kMis;
  Heuristic heuristic = Heuristic::kPower;  // of kMis
  SampleSequence sampler = SampleSequence::kSobol;
  Pairs pairs = Pairs::kNone;
  Control control = Control::kNone;
  /// Coefficient c of f - c (h - E[h]); empty: estimated per pixel (`c=optimal`). The
  /// paper's equation 7 writes f + c (h - E[h]): its coefficient is minus this one.
  std::optional<double> coefficient;
  Roulette roulette = Roulette::kThroughput;
  // of kConstant: probability of ending, in (0, 1)
  double termination = kConstantTermination;
  std::optional<double> floor;         // of kThroughput: least survival
  std::optional<std::uint32_t> first;  // first scattering event with roulette
  double scale = 1;                    // of kThroughput: of the throughput
  LightSelection light_selection = LightSelection::kPower;
  VisibleLights visible_lights = VisibleLights::kApart;
  LightPoints light_points = LightPoints::kArea;
  LightCandidates light_candidates = LightCandidates::kSingle;
  std::uint32_t candidates =
      kDefaultLightCandidates;  // of kResampled: 2 to kMaxLightCandidates
  EnvironmentPoints environment = EnvironmentPoints::kPlain;
  Distances distances = Distances::kExponential;
  PixelSamples pixel_samples = PixelSamples::kOwn;
  Reuse reuse = Reuse::kNone;
  std::uint32_t reused_paths = kDefaultReusedPaths;  // of kBlock
  BlockLayout block_layout = BlockLayout::kRandom;   // of kBlock
  LightPaths light_paths = LightPaths::kNone;
  std::uint32_t light_path_samples = kDefaultLightPathSamples;  // of kSplats
  Decide decide = Decide::kNone;

  friend bool operator==(const Strategy&, const Strategy&) = default;

  /// Returns the least survival probability of the roulette on throughput.
  double Floor() const { return floor.value_or(0); }
  /// Returns the first scattering event (from 1) after which roulette is played.
  std::uint32_t First() const {
    return first.value_or(roulette == Roulette::kConstant ? 1 : 2);
  }
  /// Scattered rays may hit any light and count in full: no light that can be hit is
  /// sampled. (Lights that nothing can hit always are.)
  bool SamplesHittableLights() const {
    return directions == Directions::kLight || directions == Directions::kMis;
  }
  bool Splits() const { return roulette == Roulette::kAdjoint; }
  /// Returns whether pixels of a tile share paths or samples, or a trial run may decide
  /// so: tiles must be the same for any number of samples.
  bool MayShare() const {
    return reuse != Reuse::kNone || pixel_samples == PixelSamples::kShared ||
           decide == Decide::kPilot;
  }
};

/// The preset that is the renderer's own strategy.
inline constexpr const char* kDefaultStrategyName = "default";

/// Changes of a strategy, as a text that has been parsed; empty: none.
struct StrategyChanges {
  std::string text;
};

/// A preset, which can only come first, sets all keys. Throws InputError at `where` with
/// the word that is not understood, what would be, and the nearest known name. An empty
/// text changes nothing.
StrategyChanges ParseStrategy(std::string_view text, const SourceLocation& where);

/// Changes `strategy` as the text said and leaves the rest.
void Apply(const StrategyChanges& changes, Strategy& strategy);

/// Parses a text and applies it to `strategy`.
void ApplyStrategy(std::string_view text, const SourceLocation& where,
                   Strategy& strategy);

/// Joins two texts of changes, either of which may be empty.
std::string JoinedChanges(const std::string& first, const std::string& then);

/// Complete text form, which ApplyStrategy reads back: "directions=mis:power,points=...".
std::string ToText(const Strategy& strategy);

/// A row of `lanelight strategies`.
struct ChoiceInfo {
  const char *axis, *name, *arguments, *meaning, *formula, *source;
};
/// Returns all choices, grouped by axis.
std::span<const ChoiceInfo> AllChoices();

struct PresetInfo {
  const char *name, *changes, *meaning;
};
/// The figures of the founding paper: each changes one thing of paper-plain.
std::span<const PresetInfo> AllPresets();

#define LANELIGHT_AXIS(Type, ...) const char* Name(Type choice);
LANELIGHT_AXES(LANELIGHT_AXIS)
#undef LANELIGHT_AXIS
const char* Name(BlockLayout choice);

}  // namespace lanelight
