// How many samples per pixel a study's renders take.
#pragma once

#include <cstdint>
#include <vector>

#include "src/study/runs.h"

namespace lanelight {

/// Samples per pixel that take about `seconds`, by a few short renders of doubling size.
/// At least 1.
std::uint64_t SamplesInSeconds(Job& job, const Strategy& strategy, double seconds);

/// Powers of two below `largest`, and `largest` rounded to five binary digits.
std::vector<std::uint64_t> CountsUpTo(std::uint64_t largest);

/// Sample counts of the strategies that are ok: those asked for; with a budget, up to
/// what each renders in that time; else powers of two up to what the first one renders in
/// kDefaultStudySeconds. Ascending, without duplicates.
void ChooseCounts(const StudyOptions& options, Job& job,
                  std::vector<StrategyRuns>& strategies);

}  // namespace lanelight
