#include "src/render/job/roofline.h"

#include <algorithm>

namespace lanelight {
namespace {

constexpr double kLineBytes = 64;

// Misses fetch a line each from the level behind: those of the first cache from the
// second, those of the last from main memory. As parts of what was measured.
double MissTraffic(const Peaks& peaks, const ProfileRow& row) {
  const double ns = row.NsPerItem();
  if (peaks.levels.size() < 2 || !(ns > 0)) return 0;
  const double second = row.PerItem(Counter::kL1Misses) * kLineBytes / (ns * 1e-9);
  const double memory = row.PerItem(Counter::kLlcMisses) * kLineBytes / (ns * 1e-9);
  return std::max(second / peaks.levels[1].bytes_per_second,
                  memory / peaks.levels.back().bytes_per_second);
}

Bound BoundOf(const Peaks& peaks, const ProfileRow& row) {
  if (row.of_peak >= kBoundFrom) return Bound::kMemory;
  const double ipc = row.InstructionsPerCycle();
  if (!(ipc > 0) || !(peaks.fma_ipc > 0)) return Bound::kUnknown;
  if (MissTraffic(peaks, row) >= kBoundFrom) return Bound::kMemory;
  return ipc >= kBoundFrom * peaks.fma_ipc ? Bound::kCompute : Bound::kNeither;
}

}  // namespace

const char* Name(Bound bound) {
  static constexpr const char* kNames[] = {"-", "memory", "compute", "neither"};
  static_assert(std::size(kNames) == static_cast<std::size_t>(Bound::kNeither) + 1);
  return kNames[static_cast<int>(bound)];
}

void PlaceOnRoofline(const Peaks& peaks, const MemoryLevel& level, ProfileRow& row) {
  const StageProfile& c = row.counts;
  if (!(c.seconds > 0) || c.items == 0) return;
  row.bandwidth = c.bytes_per_item * double(c.items) / c.seconds;
  if (level.bytes_per_second > 0) row.of_peak = row.bandwidth / level.bytes_per_second;
  row.bound = BoundOf(peaks, row);
}

}  // namespace lanelight
