#include "src/cli/texts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "kernels/simd/target.h"
#include "src/base/core/machine_info.h"
#include "src/base/core/parallel.h"
#include "src/base/core/text_layout.h"
#include "src/cli/console.h"
#include "src/cli/progress.h"
#include "src/base/stat/values.h"
#include "src/render/job/machine_json.h"
#include "src/vocabulary/strategy/strategy_text.h"

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
  const Strategy strategy = StrategyInForce(result, job);
  Strategy defaults;
  defaults.decide = strategy.decide;
  const std::string changes = ChoicesNotIn(ToText(defaults), ToText(strategy));
  std::string text = changes.empty() ? "Default strategy" : "Strategy " + changes;
  if (job.scene.strategy.decide == Decide::kPilot) {
    text += fmt::format(" (chosen by a trial run of {})",
                        DurationText(result.training.seconds));
  }
  return text;
}

// A number of at most eight characters.
std::string Ns(double ns) {
  return ns < 9999.5 ? fmt::format("{:.2f}", ns) : fmt::format("{:.3g}", ns);
}

std::string Share(double fraction) { return fmt::format("{:.1f}%", 100 * fraction); }

const char* ItemOf(const ProfileRow& row) {
  if (row.kind != RowKind::kStage) return "sample";
  return row.intersect ? "ray" : "path";
}

}  // namespace

std::string ProfileAnswer(const ProfileReport& report, const Job& job,
                          const RunResult& result) {
  const int threads = ThreadCount(job.settings.threads);
  const std::size_t repeats = report.ns_per_sample.size();
  const ProfileRow& most = report.rows.front();
  std::string text = fmt::format(
      "{}, {:.4g} spp{}, {} thread{}, {}{}: {} takes {:.0f} %",
      StrategyWords(job, result), double(result.samples) / double(job.window.pixels()),
      result.stopped_early ? " (stopped early)" : "", threads, threads == 1 ? "" : "s",
      TargetText(job.plan.options.target.name()),
      repeats > 1
          ? fmt::format(", {} repeats{}", repeats,
                        repeats < kProfileRepeats ? " (in brackets: their range)" : "")
          : "",
      most.counts.name, 100 * most.fraction);
  if (most.counts.items > 0) {
    text += fmt::format(" ({:.3g} ns per {}", most.NsPerItem(), ItemOf(most));
    if (most.kind == RowKind::kStage) {
      text += fmt::format(", {:.0f} % of lanes filled", 100 * most.counts.Occupancy());
    }
    text += ")";
  }
  return text + fmt::format("; {:.3g} us per sample, {:.3g} rays.",
                            1e-3 * MedianOf(report.ns_per_sample).value,
                            report.rays_per_sample);
}

namespace {

using CellLines = std::vector<std::vector<std::string>>;  // cells, below a header

// Removes columns whose cells are all empty or "-".
CellLines WithoutEmptyColumns(CellLines lines) {
  for (std::size_t c = lines[0].size(); c-- > 0;) {
    const auto has_data = [&](const std::vector<std::string>& line) {
      return &line != &lines[0] && !line[c].empty() && line[c] != "-";
    };
    if (std::ranges::any_of(lines, has_data)) continue;
    for (std::vector<std::string>& line : lines)
      line.erase(line.begin() + std::ptrdiff_t(c));
  }
  return lines;
}

std::string Table(const CellLines& lines, std::size_t words = 0) {
  return TextTable(lines, {TerminalColumns(Stream::kOutput), 1, words});
}

std::vector<std::string> CostCells(const ProfileRow& row) {
  const StageProfile& c = row.counts;
  std::vector<std::string> cells = {c.name, Share(row.fraction),
                                    EstimateText(MedianOf(row.ns_per_sample)),
                                    c.lane_slots > 0 ? Share(c.Occupancy()) : ""};
  if (c.calls > 0) {
    cells.insert(cells.end(), {Ns(row.NsPerItem()), TotalText(double(c.items)),
                               TotalText(double(c.calls))});
  }
  if (c.calls > 0 && row.kind == RowKind::kStage) {
    cells.insert(
        cells.end(),
        {fmt::format("{:.0f}", c.bytes_read), fmt::format("{:.0f}", c.bytes_written),
         fmt::format("{:.1f}", 1e-9 * row.bandwidth),
         fmt::format("{:.0f}%", 100 * row.of_peak), Name(row.bound)});
  }
  cells.resize(12);
  if (c.counted_items > 0) {  // per item, user mode
    cells.insert(cells.end(), {fmt::format("{:.1f}", row.PerItem(Counter::kCycles)),
                               fmt::format("{:.2f}", row.InstructionsPerCycle()),
                               fmt::format("{:.3f}", row.PerItem(Counter::kL1Misses)),
                               fmt::format("{:.4f}", row.PerItem(Counter::kLlcMisses))});
  }
  return cells;
}

// The header, and the first `columns` cells of all rows.
CellLines CostLines(const std::string& label, const std::vector<ProfileRow>& rows,
                    std::size_t columns, const std::string& level = "") {
  CellLines lines = {{label, "share", "ns/sample", "lanes", "ns/item", "items", "calls",
                      "read", "write", "GB/s", "of " + level, "bound", "cycles", "IPC",
                      "L1 misses", "LLC misses"}};
  for (const ProfileRow& row : rows) lines.push_back(CostCells(row));
  for (std::vector<std::string>& line : lines) line.resize(columns);
  return WithoutEmptyColumns(lines);
}

// Returns the table with a bar for the share of each row, where there is room.
std::string BarTable(const std::string& label, const std::vector<ProfileRow>& rows) {
  constexpr std::size_t kMinBar = 6, kMaxBar = 40, kGap = 2;
  const std::size_t columns = rows[0].ns_per_sample.size() > 1 ? 4 : 5;
  CellLines lines = CostLines(label, rows, columns);
  const std::string table = Table(lines);
  const std::size_t used = table.find('\n') + kGap,
                    width = TerminalColumns(Stream::kOutput);
  if (used + kMinBar > width || !(rows[0].fraction > 0)) return table;
  const double room = double(std::min(kMaxBar, width - used)) / rows[0].fraction;
  lines[0].push_back("");
  for (std::size_t i = 0; i < rows.size(); ++i) {
    lines[i + 1].emplace_back(std::size_t(std::lround(room * rows[i].fraction)), '#');
  }
  return Table(lines, 1);
}

// Returns the most expensive stages and parts of tasks; fewer below many groups.
std::string StageTable(const ProfileReport& report) {
  const std::size_t room = std::min<std::size_t>(12, 24 - report.groups.size());
  std::vector<ProfileRow> rows;
  double rest = 1;
  for (const ProfileRow& row : report.rows) {
    if (row.counts.calls == 0 || rows.size() == room) continue;
    rows.push_back(row);
    rest -= row.fraction;
  }
  if (rows.empty()) return "";
  return BarTable("stage", rows) +
         fmt::format("{:.1f}% elsewhere; all stages with -v\n", 100 * rest);
}

// Explains groups of a strategy's own, and warns of other programs.
std::string GroupNotes(const ProfileReport& report) {
  const auto line = [](const std::string& words) {
    return Wrapped(words, TerminalColumns(Stream::kOutput)) + "\n";
  };
  std::string text;
  for (const ProfileRow& row : report.groups) {
    const std::string meaning = InfoOf(row.counts.group).meaning;
    if (!meaning.empty()) text += line(row.counts.name + ": " + meaning);
  }
  if (report.busy.empty()) return text;
  return text + line(fmt::format("warning: the machine was busy: {}",
                                 fmt::join(report.busy, "; ")));
}

std::string DetailRows(const ProfileReport& report, const Job& job,
                       const RunResult& result, const std::string& scene) {
  const SimdTarget target = job.plan.options.target;
  std::string text =
      SummaryRow("strategy", ToText(StrategyInForce(result, job))) +
      SummaryRow("scene", scene) +
      SummaryRow("render", fmt::format("{}x{} pixels in {}; {} lanes", job.window.width(),
                                       job.window.height(), DurationText(result.seconds),
                                       target.lanes())) +
      SummaryRow("machine", MachineText(ThisMachine())) +
      SummaryRow("peaks", PeaksText(report.peaks, target)) +
      SummaryRow("columns",
                 fmt::format("{:.0f} KiB for the paths of a wavefront; they fit in {}",
                             double(result.bytes_in_flight) / 1024, report.level.name));
  if (result.counter_error != 0) {
    text += SummaryRow("counters", std::string(result.counters ? "in part: " : "none: ") +
                                       CountersProblem(result.counter_error));
  }
  return text + "\n";
}

std::string BounceTable(const ProfileReport& report) {
  CellLines lines = {{"bounce", "share", "closest rays", "shadow rays", "lanes"}};
  for (std::size_t i = 0; i < report.bounces.size(); ++i) {
    const BounceProfile& b = report.bounces[i];
    lines.push_back({fmt::format("{}{}", i, i + 1 == kMaxBounces ? " and more" : ""),
                     Share(b[kBounceSeconds] / report.seconds),
                     TotalText(b[kBounceClosest]), TotalText(b[kBounceShadow]),
                     Share(b[kBounceItems] / b[kBounceSlots])});
  }
  return "\n" + Table(lines);
}

std::string MaterialCosts(const ProfileReport& report) {
  std::vector<ProfileRow> rows;
  for (const ProfileRow& row : report.rows) {
    if (row.counts.material.empty()) continue;
    rows.push_back(row);
    rows.back().counts.name = row.counts.material;
  }
  if (rows.empty()) return "";
  return "\n" + Table(CostLines("material", rows, 6));
}

// Explains columns that could be misread.
std::string Notes(const ProfileReport& report) {
  return SummaryRow("read,write",
                    fmt::format(" bytes of path columns per item; read, write, GB/s and "
                                "\"of {}\" exclude BVH, triangles, textures and tables",
                                report.level.name));
}

}  // namespace

std::string StageCostText(const RunResult& result) {
  Peaks unknown;
  unknown.levels.emplace_back();
  return Table(CostLines("stage", MakeProfileReport({&result, 1}, unknown).rows, 7));
}

std::string ProfileText(const ProfileReport& report, const Job& job,
                        const RunResult& result, const std::string& scene, bool verbose) {
  const std::string begin =
      Wrapped(ProfileAnswer(report, job, result), TerminalColumns(Stream::kOutput)) +
      "\n\n" + BarTable("group", report.groups) + "\n";
  const std::string notes = "\n" + GroupNotes(report);
  if (!verbose) return begin + StageTable(report) + notes;
  return begin + DetailRows(report, job, result, scene) +
         Table(CostLines("stage", report.rows, 16, report.level.name.substr(0, 3))) +
         BounceTable(report) + MaterialCosts(report) + "\n" + Notes(report) + notes;
}

}  // namespace lanelight
