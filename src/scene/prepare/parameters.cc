#include "src/scene/prepare/parameters.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>

namespace lanelight {

namespace {

// The least sum of light subpaths: it is 1.0 to 1.4 in five scenes, whose filters have a
// radius of 0.5 to 1.5.
constexpr double kPixelsOfLightPath = 3;
// These are of a Gaussian of radius 1.5 and sigma 0.5, where the filter is not known.
constexpr FilterReach kUsualReach = {1, 3.2, 1. / 3};

// Errors of two pixels have no more in common than the share of samples in which they are
// in one block: (N - 1) / 255 of a tile's pixels by chance. Rectangles hold the same
// neighbours again and again, but no more than N.
double DependentsOfReuse(const Strategy& strategy) {
  if (strategy.reuse == Reuse::kNone) return 1;
  const double n = strategy.reused_paths;
  if (strategy.block_layout != BlockLayout::kRandom) return n;
  return 1 + (n - 1) * (n - 1) / (kReuseTile * kReuseTile - 1);
}

// Points (or pairs) of one replicate, of `units` samples or pairs that take turns.
std::string SizeText(const Strategy& strategy, std::uint64_t units) {
  const bool pairs = strategy.pairs == Pairs::kAntithetic;
  const char* const what = pairs ? "pairs" : "points";
  const std::uint64_t own = units / kReplicates, rest = units % kReplicates;
  const std::uint64_t maximum = std::uint64_t{1} << LogSequence(strategy.sampler);
  if (own + (rest > 0) > maximum) {
    const std::uint64_t cycle = maximum * kReplicates;
    const std::uint64_t rounds = (units + cycle - 1) / cycle;
    return fmt::format(", {} randomisations of up to {} {}, the most that it stratifies",
                       rounds * kReplicates, maximum, what);
  }
  std::string text = fmt::format(", {} randomisations of {}", kReplicates, own);
  if (rest > 0) text += fmt::format(" or {}", own + 1);
  text += fmt::format(" {}", what);
  if (rest > 0 || !std::has_single_bit(own)) {
    const std::uint64_t better = std::bit_floor(own) * kReplicates * (pairs ? 2 : 1);
    text += fmt::format(" ({} or {} samples are better stratified)", better, 2 * better);
  }
  return text;
}

}  // namespace

// A light subpath serves the pixels whose filter it meets, a few times. Of shared samples
// what they have in common remains, and the rest becomes less.
double DependentsOf(const Strategy& strategy, const FilterReach& reach) {
  const bool shared = strategy.pixel_samples == PixelSamples::kShared;
  if (strategy.light_paths != LightPaths::kNone) {
    return std::max({kPixelsOfLightPath, reach.splats, shared ? reach.shared : 1});
  }
  const double own = DependentsOfReuse(strategy);
  if (!shared) return own;
  constexpr double kOthers = kReuseTile * kReuseTile - 1;
  const double common = std::sqrt((own - 1) / kOthers);
  const double correlation = common / ((1 - common) * reach.shared_variance + common);
  return reach.shared + kOthers * correlation * correlation;
}

SamplerParameters MakeSamplerParameters(SampleSequence sampler) {
  SamplerParameters p;
  p.group_shift = LogSequence(sampler);
  return p;
}

MisParameters MakeMisParameters(const Strategy& strategy) {
  if (strategy.directions == Directions::kLight) return {0, 0, 0};
  if (strategy.heuristic == Heuristic::kBalance) return {0, 1, 1};
  return {1, 0, 1};
}

RouletteParameters MakeRouletteParameters(const Strategy& strategy) {
  return {static_cast<float>(strategy.termination), static_cast<float>(strategy.Floor()),
          strategy.First(), static_cast<float>(strategy.scale)};
}

std::uint32_t CandidatesOf(const Strategy& strategy, const FeatureSet& features) {
  return features.Has(Feature::kLightCandidates) ? strategy.candidates : 1;
}

std::uint32_t LogSequence(SampleSequence sampler) {
  switch (sampler) {
    case SampleSequence::kIndependent:
      return 0;
    case SampleSequence::kHalton:
      return 12;                       // below 3^8: see kernels/samplers/halton-inl.h
    case SampleSequence::kStratified:  // beyond, floats have no room for more strata
    case SampleSequence::kSobol:
      return 20;
  }
  return 0;
}

SampleGroups GroupsOf(const Strategy& strategy) {
  SampleGroups groups;
  groups.unit = strategy.pairs == Pairs::kAntithetic ? 2 : 1;
  // Pairs of which the fit of control=regression knows single samples have no variance of
  // their own: those of four turns say it.
  groups.replicates = strategy.sampler != SampleSequence::kIndependent ||
                      (groups.unit == 2 && strategy.control == Control::kRegression);
  groups.dependents = DependentsOf(strategy, kUsualReach);
  return groups;
}

std::string PointsText(const Strategy& strategy, std::uint64_t spp) {
  const bool pairs = strategy.pairs == Pairs::kAntithetic;
  const std::uint64_t units = pairs ? (spp + 1) / 2 : spp;
  std::string text = Name(strategy.sampler);
  if (strategy.sampler != SampleSequence::kIndependent) {
    if (spp == 0) {
      text += fmt::format(", {} randomisations", kReplicates);
    } else if (units < 2 * kReplicates) {
      text += fmt::format(
          ", not stratified (needs {} samples per pixel), so the same as independent",
          2 * kReplicates * (pairs ? 2 : 1));
    } else {
      text += SizeText(strategy, units);
    }
  }
  if (pairs) text += ", antithetic pairs";
  return text;
}

}  // namespace lanelight
