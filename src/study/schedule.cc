#include "src/study/schedule.h"

#include <algorithm>
#include <bit>

namespace lanelight {
namespace {

constexpr std::uint64_t kMostSpp = 1u << 20;

double RenderSeconds(Job& job, const Strategy& strategy, std::uint64_t spp) {
  job.spp = spp;
  SetStrategy(job, strategy);
  FilmAccumulator film = MakeFilm(job);
  return RunJob(job, film).seconds;
}

std::vector<std::uint64_t> Sorted(std::vector<std::uint64_t> counts) {
  std::sort(counts.begin(), counts.end());
  counts.erase(std::unique(counts.begin(), counts.end()), counts.end());
  return counts;
}

}  // namespace

std::uint64_t SamplesInSeconds(Job& job, const Strategy& strategy, double seconds) {
  std::uint64_t spp = 1;
  double taken = RenderSeconds(job, strategy, spp);
  // An eighth of the time measures the speed well enough, costs of starting included.
  while (taken < seconds / 8 && spp < kMostSpp) {
    spp *= 2;
    taken = RenderSeconds(job, strategy, spp);
  }
  const double samples = double(spp) * seconds / std::max(taken, 1e-9);
  return static_cast<std::uint64_t>(std::clamp(samples, 1.0, double(kMostSpp)));
}

std::vector<std::uint64_t> CountsUpTo(std::uint64_t largest) {
  std::vector<std::uint64_t> counts;
  for (std::uint64_t n = 1; n < largest; n *= 2) counts.push_back(n);
  const int shift = std::max(0, static_cast<int>(std::bit_width(largest)) - 5);
  counts.push_back(largest >> shift << shift);
  return Sorted(counts);
}

void ChooseCounts(const StudyOptions& options, Job& job,
                  std::vector<StrategyRuns>& strategies) {
  std::vector<std::uint64_t> common = Sorted(options.spp);
  for (StrategyRuns& runs : strategies) {
    if (runs.status != RunStatus::kOk) continue;
    if (options.spp.empty() && options.budget) {
      runs.counts =
          CountsUpTo(SamplesInSeconds(job, runs.named.strategy, *options.budget));
      continue;
    }
    if (common.empty()) {
      common = CountsUpTo(std::bit_floor(
          SamplesInSeconds(job, runs.named.strategy, kDefaultStudySeconds)));
    }
    runs.counts = common;
  }
}

}  // namespace lanelight
