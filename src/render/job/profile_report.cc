#include "src/render/job/profile_report.h"

#include <algorithm>

#include "src/render/job/roofline.h"

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
void AddRows(const RunResult& result, ProfileReport& report) {
  double timed = result.training.cpu_seconds;
  const auto add = [&](RowKind kind, const std::vector<StageProfile>& rows) {
    for (const StageProfile& counts : rows) {
      timed += counts.seconds;
      if (kind == RowKind::kStage || counts.calls > 0) {
        report.rows.push_back(MakeRow(kind, counts));
      }
    }
  };
  add(RowKind::kStage, result.stages);
  add(RowKind::kPart, result.parts);
  if (result.training.cpu_seconds > 0) {
    report.rows.push_back(
        MakeRow(RowKind::kPilot, kPilotRowName, result.training.cpu_seconds));
  }
  const double rest = std::max(0.0, result.cpu_seconds - timed);
  report.rows.push_back(MakeRow(RowKind::kOutside, "outside stages", rest));
  report.waiting_seconds = std::max(0.0, result.waiting_seconds);
}

void AddSums(ProfileReport& report) {
  for (const ProfileRow& row : report.rows) {
    report.seconds += row.counts.seconds;
    if (row.kind != RowKind::kStage) continue;
    (row.intersect ? report.intersect_seconds : report.other_stage_seconds) +=
        row.counts.seconds;
  }
}

}  // namespace

const char* Name(RowKind kind) {
  static constexpr const char* kNames[] = {"stage", "task", "pilot", "outside"};
  static_assert(std::size(kNames) == static_cast<std::size_t>(RowKind::kOutside) + 1);
  return kNames[static_cast<int>(kind)];
}

double ProfileRow::NsPerItem() const {
  return counts.items > 0 ? 1e9 * counts.seconds / double(counts.items) : 0;
}

double ProfileRow::PerItem(Counter counter) const {
  const auto value = counts.counted[static_cast<std::size_t>(counter)];
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

ProfileReport MakeProfileReport(const RunResult& result, const Peaks& peaks) {
  ProfileReport report;
  report.peaks = peaks;
  report.level = peaks.LevelOf(double(result.bytes_in_flight));
  AddRows(result, report);
  AddSums(report);
  for (ProfileRow& row : report.rows) {
    row.share = report.seconds > 0 ? row.counts.seconds / report.seconds : 0;
    if (row.kind == RowKind::kStage) PlaceOnRoofline(peaks, report.level, row);
  }
  std::sort(report.rows.begin(), report.rows.end(),
            [](const ProfileRow& a, const ProfileRow& b) {
              return a.share != b.share ? a.share > b.share
                                        : a.counts.name < b.counts.name;
            });
  return report;
}

}  // namespace lanelight
