#include "src/prepare/groups.h"
#include "src/prepare/parameters.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "src/core/check.h"
#include "src/prepare/lattice.h"
#include "src/prepare/pmj02.h"

namespace lanelight {
namespace {

Strata MakeStrata(std::uint32_t count) {
  Strata strata;
  strata.count = count;
  while ((1u << strata.bits) < count) ++strata.bits;
  const std::uint64_t width = ~std::uint64_t{0} / count;
  strata.whole = static_cast<std::uint32_t>(width >> 32);
  strata.part = static_cast<std::uint32_t>(width);
  return strata;
}

// Near-square strata: the largest divisor of the size up to its root, and the rest.
void SetGrid(PointsParameters& p) {
  auto columns = static_cast<std::uint32_t>(std::sqrt(double(p.group_size)));
  while (p.group_size % columns != 0) --columns;
  p.columns = MakeStrata(columns);
  p.rows = MakeStrata(p.group_size / columns);
}

void SetLattice(PointsParameters& p) {
  if (p.group_size == 1) return;
  const std::uint64_t z = LatticeGenerator(p.group_size);
  p.lattice_whole = static_cast<std::uint32_t>((z << 32) / p.group_size);
  const std::uint64_t rest = (z << 32) % p.group_size;
  p.lattice_part = static_cast<std::uint32_t>((rest << 32) / p.group_size);
}

void SetBase3(PointsParameters& p) {
  std::uint32_t power = 1;
  for (; power < p.group_size; power *= 3) ++p.base3_digits;
  p.base3 = MakeStrata(power);
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

constexpr std::uint64_t Bit(Dimension d) {
  return std::uint64_t{1} << static_cast<std::uint32_t>(d);
}

}  // namespace

PointsParameters MakePointsParameters(Points points, std::uint32_t group_size) {
  LL_CHECK_GE(group_size, 1u);
  LL_CHECK_LE(group_size, MostGroupSize(points));
  PointsParameters p;
  p.group_size = group_size;
  while ((1u << p.group_shift) < group_size) ++p.group_shift;
  SetMagic(p);
  p.strata = MakeStrata(group_size);
  if (points == Points::kSobol || points == Points::kPmj02) {
    LL_CHECK(std::has_single_bit(group_size));
  }
  if (points == Points::kStratified || points == Points::kCmj) SetGrid(p);
  if (points == Points::kLattice) SetLattice(p);
  if (points == Points::kHalton) SetBase3(p);
  if (points == Points::kPmj02) p.pmj02 = Pmj02Table().data();
  return p;
}

PairParameters MakePairParameters(const Strategy& strategy) {
  if (strategy.pairs == Pairs::kNone) return {};
  constexpr std::uint64_t kPixel = Bit(Dimension::kFilm) | Bit(Dimension::kLens);
  constexpr std::uint64_t kLight = Bit(Dimension::kSelect) | Bit(Dimension::kLight);
  constexpr std::uint64_t kBsdf = Bit(Dimension::kBsdf) | Bit(Dimension::kLobe);
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

}  // namespace lanelight
