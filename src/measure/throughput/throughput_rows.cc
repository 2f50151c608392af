#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "src/measure/throughput/throughput.h"

namespace lanelight {
namespace {

// Returns samples per second of wall clock or of processor time.
Interval RateIn(const ThroughputRow& row, const Interval& seconds) {
  const double samples = double(row.counts.samples);
  return {samples / seconds.value, samples / seconds.high, samples / seconds.low};
}

}  // namespace

Interval ThroughputRow::Seconds() const {
  return stat::MedianInterval(seconds, kBenchConfidence);
}

Interval ThroughputRow::Rate() const { return RateIn(*this, Seconds()); }

Interval ThroughputRow::CpuRate() const {
  return RateIn(*this, stat::MedianInterval(cpu_seconds, kBenchConfidence));
}

double ThroughputRow::WaitingFraction() const {
  const double cpu = std::accumulate(cpu_seconds.begin(), cpu_seconds.end(), 0.0);
  const double all = cpu + waiting_seconds;
  return all > 0 ? waiting_seconds / all : 0;
}

double ThroughputRow::RelativeHalfWidth() const {
  if (seconds.size() < kMinRepeats) return std::numeric_limits<double>::infinity();
  const Interval s = Seconds();
  return (s.high - s.low) / (2 * s.value);
}

std::vector<StageGroup> StageGroups(const ThroughputRow& row) {
  std::vector<StageGroup> groups;
  for (const ProfileGroupInfo& info : kProfileGroups) groups.push_back({info.name});
  const double ns = 1e9 / double(row.counts.samples);
  // Parts of tasks outside of stages have no lanes.
  for (const auto* profiles : {&row.counts.stages, &row.counts.parts}) {
    for (const StageProfile& s : *profiles) {
      StageGroup& group = groups[std::size_t(s.group)];
      group.ns_per_sample += ns * s.seconds;
      if (s.lane_slots > 0) group.items += s.items;
      group.lane_slots += s.lane_slots;
    }
  }
  return groups;
}

double MaxRelativeHalfWidth(const std::vector<ThroughputRow>& rows) {
  double worst = 0;
  for (const ThroughputRow& row : rows) worst = std::max(worst, row.RelativeHalfWidth());
  return worst;
}

const ThroughputRow* OneThreadRow(const std::vector<ThroughputRow>& rows,
                                  const ThroughputRow& row) {
  const auto found = std::ranges::find_if(rows, [&](const ThroughputRow& other) {
    return other.scene == row.scene && other.target == row.target && other.threads == 1;
  });
  return found == rows.end() ? nullptr : &*found;
}

std::vector<std::string> BusyReasons(const std::vector<ThroughputRow>& rows,
                                     const MachineInfo& machine) {
  double worst = 0;
  for (const ThroughputRow& row : rows) worst = std::max(worst, row.WaitingFraction());
  return BusyReasons(machine, worst);
}

std::vector<std::string> ThroughputWarnings(const std::vector<ThroughputRow>& rows,
                                            double within) {
  std::vector<std::string> warnings;
  if (const auto busy = BusyReasons(rows, ThisMachine()); !busy.empty()) {
    warnings.push_back(fmt::format(
        "The machine was busy: {}. Rates per second of processor time are more reliable.",
        fmt::join(busy, "; ")));
  }
  const double worst = MaxRelativeHalfWidth(rows);
  if (worst > within) {
    warnings.push_back(fmt::format(
        "Not all medians are known within {:.3g} %: the least certain one {}. Stop other "
        "programs or increase --time.",
        100 * within,
        std::isfinite(worst) ? fmt::format("is known within {:.2g} %", 100 * worst)
                             : "has no interval"));
  }
  return warnings;
}

}  // namespace lanelight
