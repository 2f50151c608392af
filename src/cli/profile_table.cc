#include "src/cli/texts.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "kernels/simd/target.h"
#include "src/base/core/machine_info.h"
#include "src/base/core/parallel.h"
#include "src/base/core/text_layout.h"
#include "src/cli/console.h"
#include "src/cli/progress.h"

namespace lanelight {
namespace {

std::string PeaksText(const Peaks& peaks, SimdTarget target) {
  std::string text = "reads of one thread:";
  for (const MemoryLevel& level : peaks.levels) {
    text += fmt::format(" {} {:.0f} GB/s,", level.name, 1e-9 * level.bytes_per_second);
  }
  return text + fmt::format(" multiply-add {:.0f} Gflop/s ({})", 1e-9 * peaks.flops,
                            target.name());
}

// Names the strategy that was profiled, which `render` uses with the same arguments.
std::string StrategyWords(const Job& job, const RunResult& result) {
  const std::string text = ToText(StrategyInForce(result, job));
  if (job.scene.strategy.decide != Decide::kPilot) return text;
  return fmt::format("chosen by a trial run of {}, the row \"{}\": {}",
                     DurationText(result.training.seconds), kPilotRowName, text);
}

std::string HeaderText(const ProfileReport& report, const Job& job,
                       const RunResult& result, const std::string& scene) {
  const double pixels = double(job.window.pixels());
  const SimdTarget target = job.plan.options.target;
  std::string text =
      SummaryRow("strategy", StrategyWords(job, result)) + SummaryRow("scene", scene) +
      SummaryRow(
          "render",
          fmt::format("{}x{} pixels, {:.4g} samples each in {}{}; threads: {}, lanes: {} "
                      "({})",
                      job.window.width(), job.window.height(),
                      double(result.samples) / pixels, DurationText(result.seconds),
                      result.stopped_early ? " (stopped early)" : "",
                      ThreadCount(job.settings.threads), target.lanes(), target.name())) +
      SummaryRow("machine", MachineText(ThisMachine())) +
      SummaryRow("peaks", PeaksText(report.peaks, target)) +
      SummaryRow("columns",
                 fmt::format("{:.0f} KiB for the paths of a wavefront; they fit in {}",
                             double(result.bytes_in_flight) / 1024, report.level.name));
  if (result.counter_error != 0) {
    text += SummaryRow("counters", std::string(result.counters ? "in part: " : "none: ") +
                                       CountersProblem(result.counter_error));
  }
  return text;
}

// A number of at most eight characters.
std::string Ns(double ns) {
  return ns < 9999.5 ? fmt::format("{:.2f}", ns) : fmt::format("{:.3g}", ns);
}

std::vector<std::string> CostCells(const ProfileRow& row) {
  const StageProfile& c = row.counts;
  std::vector<std::string> cells(11);
  cells[0] = c.name;
  cells[1] = fmt::format("{:.1f}%", 100 * row.fraction);
  if (c.calls == 0) return cells;
  cells[2] = Ns(row.NsPerItem());
  cells[3] = TotalText(double(c.items));
  cells[4] = TotalText(double(c.calls));
  if (row.kind != RowKind::kStage) return cells;
  cells[5] = fmt::format("{:.1f}%", 100 * c.Occupancy());
  cells[6] = fmt::format("{:.0f}", c.bytes_read);
  cells[7] = fmt::format("{:.0f}", c.bytes_written);
  cells[8] = fmt::format("{:.1f}", 1e-9 * row.bandwidth);
  cells[9] = fmt::format("{:.0f}%", 100 * row.of_peak);
  cells[10] = Name(row.bound);
  return cells;
}

std::string CostTable(const ProfileReport& report) {
  std::vector<std::vector<std::string>> lines = {
      {"stage", "share", "ns/item", "items", "calls", "lanes", "read", "write", "GB/s",
       "of " + report.level.name.substr(0, 3), "bound"}};
  for (const ProfileRow& row : report.rows) lines.push_back(CostCells(row));
  const std::string text =
      TextTable(lines, {TerminalColumns(Stream::kOutput), 1, 1}) +
      fmt::format("total      {} of processor time, all threads together\n",
                  DurationText(report.seconds));
  if (!(report.intersect_seconds > 0)) return text;
  return text + fmt::format(
                    "\ntime of other stages / time of intersection: {:.2f} (with film "
                    "and set-up: "
                    "{:.2f})\n",
                    report.Ratio(), report.RatioWithAll());
}

// Per item, user mode; of the calls in which the counters were read.
std::string CounterTable(const ProfileReport& report) {
  std::vector<std::vector<std::string>> lines = {
      {"per item", "cycles", "instructions", "IPC", "L1 misses", "LLC misses"}};
  for (const ProfileRow& row : report.rows) {
    if (row.counts.counted_items == 0) continue;
    lines.push_back({row.counts.name,
                     fmt::format("{:.1f}", row.PerItem(Counter::kCycles)),
                     fmt::format("{:.1f}", row.PerItem(Counter::kInstructions)),
                     fmt::format("{:.2f}", row.InstructionsPerCycle()),
                     fmt::format("{:.3f}", row.PerItem(Counter::kL1Misses)),
                     fmt::format("{:.4f}", row.PerItem(Counter::kLlcMisses))});
  }
  return "\n" + TextTable(lines, {TerminalColumns(Stream::kOutput), 1, 0});
}

// Explains columns that could be misread.
std::string Notes(const ProfileReport& report, const RunResult& result) {
  std::string text = SummaryRow(
      "read,write", fmt::format(" bytes of path columns per item; read, write, GB/s and "
                                "\"of {}\" exclude BVH, triangles, textures and tables",
                                report.level.name));
  text += SummaryRow(
      "bound", result.counters ? "what limits the speed of the stage (docs/profile.md)"
                               : "\"memory\": memory bandwidth limits the stage; \"-\": "
                                 "unknown without hardware counters (docs/profile.md)");
  if (report.waiting_seconds > 0.05 * report.seconds) {
    text += SummaryRow(
        "busy", fmt::format("other programs used the processors for {:.0f} % of the "
                            "time; their cache use may slow the stages of this table",
                            100 * report.waiting_seconds /
                                (report.seconds + report.waiting_seconds)));
  }
  return text;
}

}  // namespace

std::string ProfileText(const ProfileReport& report, const Job& job,
                        const RunResult& result, const std::string& scene) {
  return HeaderText(report, job, result, scene) + "\n" + CostTable(report) +
         (result.counters ? CounterTable(report) : "") + "\n" + Notes(report, result);
}

}  // namespace lanelight
