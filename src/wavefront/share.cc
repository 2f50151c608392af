#include "src/wavefront/share.h"

#include <algorithm>
#include <cmath>

#include "src/wavefront/run.h"

namespace lanelight {

std::uint64_t Share::Samples(std::uint64_t mean) const {
  constexpr std::uint64_t kEnd = kSamplesPerSeed;
  constexpr auto kLast = static_cast<std::uint64_t>(double(kEnd) / kMostShare);
  if (weight == 1 || mean <= kAllocationPilot || mean >= kEnd) return mean;
  const std::uint64_t more = std::min(mean, kLast) - kAllocationPilot;
  const auto turns =
      static_cast<std::uint64_t>(std::floor(double(more) * weight / turn + offset));
  const std::uint64_t samples = kAllocationPilot + turns * turn;
  if (mean <= kLast) return samples;
  return samples + (kEnd - samples) * (mean - kLast) / (kEnd - kLast);
}

std::uint64_t Share::Mean(std::uint64_t samples) const {
  if (weight == 1 || samples < kAllocationPilot || samples >= kSamplesPerSeed) {
    return samples;
  }
  std::uint64_t low = kAllocationPilot, high = kSamplesPerSeed;
  while (high - low > 1) {
    const std::uint64_t middle = low + (high - low) / 2;
    (Samples(middle) <= samples ? low : high) = middle;
  }
  return low;
}

Share ShareOf(const Films& films, int x, int y) {
  Share share;
  const double weight = films.WeightAt(x, y);
  if (weight == 0) return share;
  const SampleGroups& groups = films.film().groups();
  share.weight = weight;
  share.turn = groups.unit * (groups.replicates ? kReplicates : 1);
  // The same in all pixels of a cell. Roberts' sequence: neighbouring blocks are rounded
  // in different directions.
  const double offset = 0.5 + 0.7548776662466927 * (x / kShareBlock) +
                        0.5698402909980532 * (y / kShareBlock);
  share.offset = offset - std::floor(offset);
  return share;
}

}  // namespace lanelight
