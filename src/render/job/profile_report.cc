#include "src/render/job/profile_report.h"

#include <algorithm>

#include "src/base/core/machine_info.h"

namespace lanelight {
namespace {

ProfileRow MakeRow(RowKind kind, const StageProfile& counts) {
  ProfileRow row;
  row.kind = kind;
  row.counts = counts;
  row.intersect =
      counts.role == StageRole::kIntersect || counts.role == StageRole::kShadow;
  return row;
}

ProfileRow MakeRow(RowKind kind, const char* name, double seconds) {
  StageProfile counts;
  counts.name = name;
  counts.seconds = seconds;
  return MakeRow(kind, counts);
}

// The rest is what the processor time of the process has beyond stages, parts and pilot.
std::vector<ProfileRow> RowsOf(const RunResult& result) {
  std::vector<ProfileRow> rows;
  double timed = result.training.cpu_seconds;
  const auto add = [&](RowKind kind, const std::vector<StageProfile>& profiles) {
    for (const StageProfile& counts : profiles) {
      timed += counts.seconds;
      if (kind == RowKind::kStage || counts.calls > 0) {
        rows.push_back(MakeRow(kind, counts));
      }
    }
  };
  add(RowKind::kStage, result.stages);
  add(RowKind::kPart, result.parts);
  if (result.training.cpu_seconds > 0) {
    rows.push_back(MakeRow(RowKind::kPilot, kPilotRowName, result.training.cpu_seconds));
    rows.back().counts.group = ProfileGroup::kTraining;
  }
  const double rest = std::max(0.0, result.cpu_seconds - timed);
  rows.push_back(MakeRow(RowKind::kOutside, "outside stages", rest));
  return rows;
}

// Rows are those of any repeat: trial runs of two repeats may choose differently.
void AddRows(std::span<const RunResult> repeats, ProfileReport& report) {
  for (std::size_t i = 0; i < repeats.size(); ++i) {
    const double per_sample =
        1e9 / double(std::max<std::uint64_t>(repeats[i].samples, 1));
    report.ns_per_sample.push_back(0);
    for (const ProfileRow& more : RowsOf(repeats[i])) {
      auto row = std::ranges::find_if(report.rows, [&](const ProfileRow& r) {
        return r.counts.name == more.counts.name;
      });
      if (row == report.rows.end()) row = report.rows.insert(row, more);
      row->ns_per_sample.resize(i);
      row->ns_per_sample.push_back(per_sample * more.counts.seconds);
      report.ns_per_sample.back() += row->ns_per_sample.back();
    }
  }
  for (ProfileRow& row : report.rows) {
    row.ns_per_sample.resize(repeats.size());
    row.counts.seconds = 1e-9 * stat::Median(row.ns_per_sample) *
                         double(std::max<std::uint64_t>(report.samples, 1));
  }
}

void Sort(std::vector<ProfileRow>& rows) {
  std::ranges::sort(rows, [](const ProfileRow& a, const ProfileRow& b) {
    return a.fraction != b.fraction ? a.fraction > b.fraction
                                    : a.counts.name < b.counts.name;
  });
}

void AddGroups(ProfileReport& report) {
  std::vector<ProfileRow>& groups = report.groups;
  for (const ProfileRow& row : report.rows) {
    const StageProfile& c = row.counts;
    auto sum = std::ranges::find_if(
        groups, [&](const ProfileRow& g) { return g.counts.group == c.group; });
    if (sum == groups.end()) {
      sum = groups.insert(sum, MakeRow(RowKind::kGroup, InfoOf(c.group).name, 0));
      sum->counts.group = c.group;
      sum->ns_per_sample.resize(row.ns_per_sample.size());
    }
    sum->counts.seconds += c.seconds;
    sum->fraction += row.fraction;
    if (c.lane_slots > 0) sum->counts.items += c.items;
    sum->counts.lane_slots += c.lane_slots;
    for (std::size_t i = 0; i < row.ns_per_sample.size(); ++i) {
      sum->ns_per_sample[i] += row.ns_per_sample[i];
    }
  }
  Sort(groups);
}

void AddSums(ProfileReport& report) {
  for (const ProfileRow& row : report.rows) {
    report.seconds += row.counts.seconds;
    if (row.kind != RowKind::kStage) continue;
    (row.intersect ? report.intersect_seconds : report.other_stage_seconds) +=
        row.counts.seconds;
  }
}

constexpr double kLineBytes = 64;

// Returns the larger fraction of a measured bandwidth that cache misses take. Each
// fetches a line: misses of the first cache from the second, those of the last from main
// memory.
double CacheMissTraffic(const Peaks& peaks, const ProfileRow& row) {
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
  if (CacheMissTraffic(peaks, row) >= kBoundFrom) return Bound::kMemory;
  return ipc >= kBoundFrom * peaks.fma_ipc ? Bound::kCompute : Bound::kNeither;
}

}  // namespace

const char* Name(RowKind kind) {
  static constexpr const char* kNames[] = {"stage", "task", "pilot", "outside", "group"};
  static_assert(std::size(kNames) == std::size_t(RowKind::kGroup) + 1);
  return kNames[int(kind)];
}

double ProfileRow::NsPerItem() const {
  return counts.items > 0 ? 1e9 * counts.seconds / double(counts.items) : 0;
}

double ProfileRow::PerItem(Counter counter) const {
  const auto value = counts.counted[std::size_t(counter)];
  return counts.counted_items > 0 ? double(value) / double(counts.counted_items) : 0;
}

double ProfileRow::InstructionsPerCycle() const {
  const double cycles = PerItem(Counter::kCycles);
  return cycles > 0 ? PerItem(Counter::kInstructions) / cycles : 0;
}

double ProfileReport::Ratio() const {
  return intersect_seconds > 0 ? other_stage_seconds / intersect_seconds : 0;
}

double ProfileReport::RatioWithAll() const {
  return intersect_seconds > 0 ? (seconds - intersect_seconds) / intersect_seconds : 0;
}

Interval MedianOf(const std::vector<double>& ns_per_sample) {
  return stat::MedianInterval(ns_per_sample, kProfileConfidence);
}

ProfileReport MakeProfileReport(std::span<const RunResult> repeats, const Peaks& peaks) {
  const RunResult& first = repeats.front();
  ProfileReport report;
  report.peaks = peaks;
  report.level = peaks.LevelOf(double(first.bytes_in_flight));
  report.samples = first.samples;
  report.rays_per_sample = double(first.rays_closest + first.rays_shadow) /
                           double(std::max<std::uint64_t>(first.samples, 1));
  report.bounces = first.bounces;
  while (!report.bounces.empty() && report.bounces.back()[kBounceItems] == 0) {
    report.bounces.pop_back();
  }
  AddRows(repeats, report);
  AddSums(report);
  for (ProfileRow& row : report.rows) {
    row.fraction = report.seconds > 0 ? row.counts.seconds / report.seconds : 0;
    if (row.kind == RowKind::kStage) PlaceOnRoofline(peaks, report.level, row);
  }
  Sort(report.rows);
  AddGroups(report);
  double cpu = 1e-9;
  for (const RunResult& result : repeats) {
    report.waiting_seconds += std::max(0.0, result.waiting_seconds);
    cpu += result.cpu_seconds;
  }
  report.busy =
      BusyReasons(ThisMachine(), report.waiting_seconds / (report.waiting_seconds + cpu));
  return report;
}

const char* Name(Bound bound) {
  static constexpr const char* kNames[] = {"-", "memory", "compute", "neither"};
  static_assert(std::size(kNames) == std::size_t(Bound::kNeither) + 1);
  return kNames[int(bound)];
}

void PlaceOnRoofline(const Peaks& peaks, const MemoryLevel& level, ProfileRow& row) {
  const StageProfile& c = row.counts;
  if (!(c.seconds > 0) || c.items == 0) return;
  row.bandwidth = c.bytes_per_item * double(c.items) / c.seconds;
  if (level.bytes_per_second > 0) row.of_peak = row.bandwidth / level.bytes_per_second;
  row.bound = BoundOf(peaks, row);
}

}  // namespace lanelight
