#include "src/strategy/run_parameters.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "src/strategy/lattice.h"
#include "src/strategy/pmj02.h"

namespace lanelight {
namespace {

std::uint32_t LargestPowerOfTwo(std::uint64_t limit) {
  std::uint32_t size = 1;
  while (size * 2ull <= limit) size *= 2;
  return size;
}

// Near-square strata: a = floor(sqrt(n)), b = floor(n / a).
void SetStrata(PointsParameters& p) {
  p.strata_x = static_cast<std::uint32_t>(std::sqrt(double(p.group_size)));
  while (p.group_size % p.strata_x != 0) --p.strata_x;
  p.strata_y = p.group_size / p.strata_x;
}

// Division of numbers below 2^31 by a multiplication: with l = ceil(log2 d),
// m = ceil(2^(31+l) / d) < 2^32 and floor(n / d) = n m >> (31 + l).
void SetMagic(PointsParameters& p) {
  std::uint32_t l = 0;
  while ((std::uint64_t{1} << l) < p.group_size) ++l;
  const std::uint64_t power = std::uint64_t{1} << (31 + l);
  p.group_magic = static_cast<std::uint32_t>((power + p.group_size - 1) / p.group_size);
  p.group_magic_shift = 31 + l;
}

constexpr std::uint32_t Bit(Dimension d) { return 1u << static_cast<std::uint32_t>(d); }

}  // namespace

PointsParameters MakePointsParameters(Points points, std::uint32_t group_size) {
  PointsParameters p;
  p.group_size = group_size;
  while ((1u << p.group_shift) < group_size) ++p.group_shift;
  SetMagic(p);
  if (points == Points::kStratified || points == Points::kCmj) SetStrata(p);
  if (points == Points::kLattice) p.lattice_generator = LatticeGenerator(group_size);
  for (std::uint64_t power = 1; power < group_size; power *= 3) ++p.base3_digits;
  return p;
}

PairParameters MakePairParameters(const Strategy& strategy) {
  if (strategy.pairs == Pairs::kNone) return {};
  constexpr std::uint32_t kPixel = Bit(Dimension::kFilm) | Bit(Dimension::kLens);
  constexpr std::uint32_t kLight = Bit(Dimension::kSelect) | Bit(Dimension::kLight);
  constexpr std::uint32_t kBsdf = Bit(Dimension::kBsdf) | Bit(Dimension::kLobe);
  constexpr std::uint32_t kEveryDepth = 0xffffffffu;
  switch (strategy.paired) {
    case Paired::kAll:
      return {kPixel | kLight | kBsdf | Bit(Dimension::kRoulette), kEveryDepth};
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
          strategy.First()};
}

std::uint32_t PointsGroupSize(Points points, std::uint64_t spp) {
  constexpr std::uint64_t kMost = 1u << 20;
  const std::uint64_t wanted =
      std::clamp<std::uint64_t>(spp > 0 ? spp / 4 : 64, 1, kMost);
  switch (points) {
    case Points::kIndependent:
      return 1;
    case Points::kSobol:
      return LargestPowerOfTwo(wanted);
    case Points::kPmj02:
      return LargestPowerOfTwo(std::min<std::uint64_t>(wanted, kPmj02Points));
    case Points::kLattice:
      return static_cast<std::uint32_t>(std::min<std::uint64_t>(wanted, kMostLattice));
    case Points::kHalton:
      return static_cast<std::uint32_t>(wanted);
    case Points::kStratified:
    case Points::kCmj: {
      // floor(sqrt(n)) rows of as many strata as fit: near-square, and all of n but less
      // than one row.
      const auto rows = static_cast<std::uint64_t>(std::sqrt(double(wanted)));
      return static_cast<std::uint32_t>(rows * (wanted / rows));
    }
  }
  return 1;
}

std::uint32_t GroupSize(const Strategy& strategy, std::uint64_t spp) {
  const bool pairs = strategy.pairs == Pairs::kAntithetic;
  const std::uint64_t share =
      pairs && spp > 0 ? std::max<std::uint64_t>(spp / 2, 1) : spp;
  return PointsGroupSize(strategy.points, share) * (pairs ? 2 : 1);
}

std::string PointsText(const Strategy& strategy, std::uint64_t spp) {
  const bool pairs = strategy.pairs == Pairs::kAntithetic;
  const std::uint32_t size = GroupSize(strategy, spp);
  std::string text = Name(strategy.points);
  if (size > 1 && spp > 0) {
    const PointsParameters p =
        MakePointsParameters(strategy.points, size / (pairs ? 2 : 1));
    text += fmt::format(", {} randomisations of {} samples", spp / size, size);
    if (p.strata_x * p.strata_y > 1) {
      text += fmt::format(" in {}x{} strata", p.strata_x, p.strata_y);
    }
    if (spp % size != 0) {
      text += fmt::format(", {} left over in an incomplete one", spp % size);
    }
  }
  if (pairs) text += fmt::format(", antithetic pairs ({})", Name(strategy.paired));
  return text;
}

}  // namespace lanelight
