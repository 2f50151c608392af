#include "src/strategy/run_parameters.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "src/core/check.h"
#include "src/strategy/lattice.h"
#include "src/strategy/pmj02.h"

namespace lanelight {
namespace {

std::uint32_t LargestPowerOfTwo(std::uint64_t limit) {
  std::uint32_t size = 1;
  while (size * 2ull <= limit) size *= 2;
  return size;
}

constexpr std::uint32_t kMostGroup = 1u << 20;

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

// The errors of the points in either base end with the blocks 2^a and 3^b that the group
// consists of: n times the RMSE is about e = 2^(-a/2) + 3^(-b/2), n = 2^a 3^b, and a
// constant for other n. Least variance e^2 / n of the groups that make up a pixel.
std::uint32_t HaltonSize(std::uint64_t limit) {
  std::uint32_t best = 1;
  double least = 4;
  double error3 = 1;
  for (std::uint64_t power3 = 1; power3 <= limit; power3 *= 3, error3 /= std::sqrt(3.0)) {
    double error2 = 1;
    for (std::uint64_t n = power3; n <= limit; n *= 2, error2 /= std::sqrt(2.0)) {
      const double variance = (error2 + error3) * (error2 + error3) / double(n);
      if (variance >= least) continue;
      least = variance;
      best = static_cast<std::uint32_t>(n);
    }
  }
  return best;
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

std::uint32_t MostGroupSize(Points points) {
  if (points == Points::kIndependent) return 1;
  return points == Points::kPmj02 ? kPmj02Points : kMostGroup;
}

std::uint32_t PointsGroupSize(Points points, std::uint64_t spp) {
  const std::uint64_t wanted =
      std::clamp<std::uint64_t>(spp > 0 ? spp / 4 : 64, 1, MostGroupSize(points));
  switch (points) {
    case Points::kIndependent:
      return 1;
    case Points::kSobol:
    case Points::kPmj02:
      return LargestPowerOfTwo(wanted);
    case Points::kHalton:
      return HaltonSize(wanted);
    case Points::kLattice:
      return static_cast<std::uint32_t>(wanted);
    case Points::kStratified:
    case Points::kCmj: {
      // floor(sqrt(n)) columns of as many strata as fit: near-square, and all of n but
      // less than one row.
      const auto columns = static_cast<std::uint64_t>(std::sqrt(double(wanted)));
      return static_cast<std::uint32_t>(columns * (wanted / columns));
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

namespace {

// What the group size costs against one net of all samples.
std::string LossText(const Strategy& strategy, std::uint64_t spp, std::uint32_t own) {
  const std::uint32_t pairs = strategy.pairs == Pairs::kAntithetic ? 2 : 1;
  std::string text;
  if (own == 1) {
    return fmt::format(", not stratified (that takes {} samples): as independent",
                       8 * pairs);
  }
  if (own == MostGroupSize(strategy.points)) {
    text += fmt::format(", {} being the most that are stratified together", own);
  }
  if (spp % (own * pairs) != 0) {
    text += fmt::format(", {} left over in an incomplete one, less well stratified",
                        spp % (own * pairs));
  }
  return text;
}

}  // namespace

std::string PointsText(const Strategy& strategy, std::uint64_t spp) {
  const bool pairs = strategy.pairs == Pairs::kAntithetic;
  const std::uint32_t size = GroupSize(strategy, spp);
  const std::uint32_t own = size / (pairs ? 2 : 1);
  std::string text = Name(strategy.points);
  if (strategy.points != Points::kIndependent) {
    if (spp == 0) {
      text += fmt::format(", randomisations of {} samples", size);
    } else if (own > 1) {
      text += fmt::format(", {} randomisations of {} samples", spp / size, size);
    }
    const PointsParameters p = MakePointsParameters(strategy.points, own);
    if (p.columns.count * p.rows.count > 1) {
      text += fmt::format(" in {}x{} strata", p.columns.count, p.rows.count);
    }
    if (spp > 0) text += LossText(strategy, spp, own);
  }
  if (pairs) text += fmt::format(", antithetic pairs ({})", Name(strategy.paired));
  return text;
}

}  // namespace lanelight
