// Parameters of kernels and groups of samples that follow from a strategy.
#pragma once

#include <cstdint>
#include <string>

#include "src/vocabulary/path/replicates.h"
#include "src/vocabulary/path/run_parameters.h"
#include "src/vocabulary/strategy/strategy.h"

namespace lanelight {

SamplerParameters MakeSamplerParameters(SampleSequence sampler);
MisParameters MakeMisParameters(const Strategy& strategy);
RouletteParameters MakeRouletteParameters(const Strategy& strategy);
/// Returns the number of light samples of which a plan with these features keeps one.
std::uint32_t CandidatesOf(const Strategy& strategy, const FeatureSet& features);

/// Returns log2 of the number of points of one randomisation.
std::uint32_t LogSequence(SampleSequence sampler);

/// What a pixel filter makes of SampleGroups::dependents.
struct FilterReach {
  double splats = 1;  // of light subpaths: SplatPixels (src/render/wave/light_paths.h)
  /// Of shared samples that are independent, and their variance over that of own ones
  /// (src/render/wave/shared_samples.h).
  double shared = 1, shared_variance = 1;
};
/// Returns SampleGroups::dependents of a strategy.
double DependentsOf(const Strategy& strategy, const FilterReach& reach);

/// Returns the groups that count as one observation.
SampleGroups GroupsOf(const Strategy& strategy);

/// Returns text for reports, such as "sobol, 4 randomisations of 16 points"; spp = 0:
/// unknown.
std::string PointsText(const Strategy& strategy, std::uint64_t spp);

}  // namespace lanelight
