// The constants of a render that kernels read.
#pragma once

#include <cstdint>

#include "src/vocabulary/path/dimensions.h"
#include "src/vocabulary/path/features.h"
#include "src/vocabulary/path/sample_planes.h"

namespace lanelight {

/// Sample points: a randomisation is a sequence of 2^group_shift points, which samples of
/// a pixel share as src/vocabulary/path/replicates.h says.
struct PointsParameters {
  std::uint32_t group_shift = 0;
  const std::uint32_t* pmj02 = nullptr;  // table of pmj02.h (pmj02)
  bool by_tile = false;                  // pixels of a tile share their wavelengths
};

/// Antithetic pairs: bit d set = dimension d (src/vocabulary/path/dimensions.h) is shared
/// by samples 2k and 2k+1 and reflected, at depths below `depths`.
struct PairParameters {
  std::uint64_t dimensions = 0;
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

/// Copies that one camera sample may become, itself included. Every sample has as many
/// rows in the sample buffer.
inline constexpr std::uint32_t kMostCopies = 8;

/// First scattering event after which roulette=throughput is played, by default.
inline constexpr std::int32_t kThroughputFirst = 2;

struct RouletteParameters {
  float termination = 0;    // constant: probability of ending
  float floor = 0;          // throughput, luminance: least survival probability
  std::uint32_t first = 2;  // scattering events before the first decision
  float scale = 1;          // throughput: of it
};

/// Tables that some strategies need (src/scene/prepare/tables.h).
struct StrategyTables;

/// Constants of a render, made by src/scene/prepare/parameters.h.
struct RunParameters {
  std::uint32_t seed = 0;
  std::uint32_t width = 0, height = 0;  // full image
  std::uint32_t max_depth = 5;
  float exposure = 1;  // factor from radiance to film
  FeatureSet features;
  SamplePlanes planes;  // of a finished sample
  PointsParameters points;
  PairParameters pairs;
  MisParameters mis;
  RouletteParameters roulette;
  std::uint32_t candidates = 1;  // light samples of which one is kept
  const StrategyTables* tables = nullptr;
};

}  // namespace lanelight
