// The numbers of a strategy that kernels read, as parts of RunParameters.
#pragma once

#include <cstdint>
#include <string>

#include "src/strategy/strategy.h"
#include "src/wavefront/dimensions.h"

namespace lanelight {

/// `count` equal parts of a whole, and what places a number in one of them.
struct Strata {
  std::uint32_t count = 1;
  std::uint32_t bits = 0;  // least b with 2^b >= count
  // floor((2^64 - 1) / count) = whole 2^32 + part
  std::uint32_t whole = 0xffffffffu, part = 0xffffffffu;
};

/// Sample points. `group_size` consecutive samples of a pixel share one randomisation.
struct PointsParameters {
  std::uint32_t group_size = 1;
  std::uint32_t group_shift = 0;  // log2(group_size), for samplers of powers of two
  // sample / group_size = (sample * group_magic) >> group_magic_shift, for sample < 2^31
  // (Granlund and Montgomery 1994).
  std::uint32_t group_magic = 0, group_magic_shift = 0;
  Strata strata;         // group_size strata of one dimension
  Strata columns, rows;  // of two: columns * rows = group_size (stratified, cmj)
  Strata base3;          // 3^base3_digits (halton)
  std::uint32_t base3_digits = 0;  // least d with 3^d >= group_size
  // floor(2^64 z / group_size) = lattice_whole 2^32 + lattice_part (lattice)
  std::uint32_t lattice_whole = 0, lattice_part = 0;
  const std::uint32_t* pmj02 = nullptr;  // table of pmj02.h (pmj02)
};

/// Antithetic pairs: bit d set = dimension d (src/wavefront/dimensions.h) is shared by
/// samples 2k and 2k+1 and reflected, at depths below `depths`.
struct PairParameters {
  std::uint32_t dimensions = 0;
  std::uint32_t depths = 0;

  bool Has(Dimension d) const {
    return (dimensions >> static_cast<std::uint32_t>(d) & 1) != 0;
  }
};

/// Weight of a technique of density p against one of density q, with r = q / p:
///   1 / (1 + r (square r + linear)),
/// power heuristic (1, 0), balance heuristic (0, 1). directions=light has (0, 0): light
/// samples count in full, and `hits`, a factor on light that scattered rays hit, is 0.
struct MisParameters {
  float square = 1, linear = 0, hits = 1;
};

struct RouletteParameters {
  float termination = 0.25f;  // constant: probability of ending
  float floor = 0;            // throughput, luminance: least survival probability
  std::uint32_t first = 2;    // scattering events before the first decision
};

/// Tables that some strategies need (src/strategy/tables.h).
struct StrategyTables;

/// group_size: a power of two for sobol and pmj02, at most MostGroupSize(points).
PointsParameters MakePointsParameters(Points points, std::uint32_t group_size);
PairParameters MakePairParameters(const Strategy& strategy);
MisParameters MakeMisParameters(const Strategy& strategy);
RouletteParameters MakeRouletteParameters(const Strategy& strategy);

/// Largest group of a sampler.
std::uint32_t MostGroupSize(Points points);

/// Samples that share one randomisation of the sample points: 1 for independent points;
/// otherwise the best size that the sampler has of which at least four fit into `spp`,
/// so that the error can be estimated from the scatter of independent randomisations.
/// spp = 0: unknown. Samples that are left over start a further, incomplete group: they
/// are unbiased, and lose only the stratification. (This and the next two: groups.cc.)
std::uint32_t PointsGroupSize(Points points, std::uint64_t spp);

/// Samples that depend on each other, one observation of the film: the points' group, or
/// two of them with antithetic pairs.
std::uint32_t GroupSize(const Strategy& strategy, std::uint64_t spp);

/// "64 groups of 8x8 strata", "16 randomisations of 4 samples", ... for reports. Groups
/// are those of GroupSize() if `group_size` is 0.
std::string PointsText(const Strategy& strategy, std::uint64_t spp,
                       std::uint32_t group_size = 0);

}  // namespace lanelight
