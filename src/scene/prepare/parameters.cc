#include "src/scene/prepare/parameters.h"

#include "src/scene/prepare/groups.h"
#include "src/scene/prepare/pmj02.h"

namespace lanelight {
namespace {

constexpr std::uint64_t Bit(Dimension d) {
  return std::uint64_t{1} << static_cast<std::uint32_t>(d);
}

}  // namespace

PointsParameters MakePointsParameters(Points points) {
  PointsParameters p;
  p.group_shift = LogSequence(points);
  if (points == Points::kPmj02) p.pmj02 = Pmj02Table().data();
  return p;
}

PairParameters MakePairParameters(const Strategy& strategy) {
  if (strategy.pairs == Pairs::kNone) return {};
  constexpr std::uint64_t kPixel =
      Bit(Dimension::kFilm) | Bit(Dimension::kLens) | Bit(Dimension::kTime);
  constexpr std::uint64_t kLight = Bit(Dimension::kSelect) | Bit(Dimension::kLight);
  constexpr std::uint64_t kBsdf = Bit(Dimension::kBsdf) | Bit(Dimension::kLobe);
  constexpr std::uint64_t kMedium =
      Bit(Dimension::kCameraMedium) | Bit(Dimension::kMedium);
  constexpr std::uint32_t kEveryDepth = 0xffffffffu;
  switch (strategy.paired) {
    case Paired::kAll:
      return {kPixel | kLight | kBsdf | kMedium | Bit(Dimension::kRoulette), kEveryDepth};
    case Paired::kPixel:
      return {kPixel, kEveryDepth};
    case Paired::kLight:
      return {kLight, kEveryDepth};
    case Paired::kBsdf:
      return {kBsdf, kEveryDepth};
    case Paired::kFirstBounce:
      return {kLight | kBsdf, 1};
  }
  return {};
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

}  // namespace lanelight
