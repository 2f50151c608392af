// How samples of a pixel are grouped: those of a group depend on each other and count as
// one observation.
#pragma once

#include <cstdint>
#include <string>

#include "src/strategy/strategy.h"

namespace lanelight {

/// Largest group of a sampler.
std::uint32_t MostGroupSize(Points points);

/// Samples that share one randomisation of the sample points: 1 for independent points;
/// otherwise the best size that the sampler has of which at least four fit into `spp`,
/// so that the error can be estimated from the scatter of independent randomisations.
/// spp = 0: unknown. Samples that are left over start a further, incomplete group: they
/// are unbiased, and lose only the stratification.
std::uint32_t PointsGroupSize(Points points, std::uint64_t spp);

/// Samples that depend on each other, one observation of the film: the points' group, or
/// two of them with antithetic pairs.
std::uint32_t GroupSize(const Strategy& strategy, std::uint64_t spp);

/// "64 groups of 8x8 strata", "16 randomisations of 4 samples", ... for reports. Groups
/// are those of GroupSize() if `group_size` is 0.
std::string PointsText(const Strategy& strategy, std::uint64_t spp,
                       std::uint32_t group_size = 0);

}  // namespace lanelight
