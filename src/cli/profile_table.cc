#include "src/cli/texts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <vector>

#include "kernels/simd/target.h"
#include "src/base/core/machine_info.h"
#include "src/base/core/parallel.h"
#include "src/base/core/text_layout.h"
#include "src/cli/console.h"
#include "src/cli/progress.h"
#include "src/base/stat/values.h"
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

std::string MedianText(const std::vector<double>& ns_per_sample) {
  return EstimateText(MedianOf(ns_per_sample));
}

const char* ItemOf(const ProfileRow& row) {
  if (row.kind != RowKind::kStage) return "sample";
  return row.intersect ? "ray" : "path";
}

// Says what ran, which row takes most of the time, and the cost of a sample.
std::string AnswerText(const ProfileReport& report, const Job& job,
                       const RunResult& result) {
  const int threads = ThreadCount(job.settings.threads);
  const std::size_t repeats = report.ns_per_sample.size();
  const ProfileRow& most = report.rows.front();
  std::string text = fmt::format("{}, {:.4g} spp{}, {} thread{}, {}{}: {} takes {:.0f} %",
                                 StrategyWords(job, result),
                                 double(result.samples) / double(job.window.pixels()),
                                 result.stopped_early ? " (stopped early)" : "", threads,
                                 threads == 1 ? "" : "s", job.plan.options.target.name(),
                                 repeats > 1 ? fmt::format(", {} repeats", repeats) : "",
                                 most.counts.name, 100 * most.fraction);
  if (most.counts.items > 0) {
    text += fmt::format(" ({:.3g} ns per {}", most.NsPerItem(), ItemOf(most));
    if (most.kind == RowKind::kStage) {
      text += fmt::format(", {:.0f} % of lanes filled", 100 * most.counts.Occupancy());
    }
    text += ")";
  }
  return Wrapped(text + fmt::format("; {:.3g} us per sample, {:.3g} rays.",
                                    1e-3 * MedianOf(report.ns_per_sample).value,
                                    report.rays_per_sample),
                 TerminalColumns(Stream::kOutput)) +
         "\n";
}

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
  return TextTable(WithoutEmptyColumns(lines),
                   {TerminalColumns(Stream::kOutput), 1, words});
}

// Returns the table with a bar behind each line but the header, where there is room;
// `values`: their lengths.
std::string BarTable(const CellLines& lines, const std::vector<double>& values) {
  constexpr std::size_t kMinBar = 6, kMaxBar = 40, kGap = 2;
  const std::string table = Table(lines);
  std::vector<std::string> rows;
  std::istringstream in(table);
  for (std::string row; std::getline(in, row);) rows.push_back(row);
  std::size_t used = kGap;
  for (const std::string& row : rows) used = std::max(used, row.size() + kGap);
  const std::size_t width = TerminalColumns(Stream::kOutput);
  const double longest = *std::ranges::max_element(values);
  if (rows.size() != lines.size() || used + kMinBar > width || !(longest > 0)) {
    return table;
  }
  const double room = double(std::min(kMaxBar, width - used));
  std::string text = rows[0] + "\n";
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const auto cells = std::size_t(std::lround(room * values[i - 1] / longest));
    if (cells > 0) rows[i].append(used - rows[i].size(), ' ').append(cells, '#');
    text += rows[i] + "\n";
  }
  return text;
}

std::string GroupTable(const ProfileReport& report) {
  CellLines lines = {{"group", "share", "ns/sample", "lanes"}};
  std::vector<double> values;
  for (const ProfileGroupRow& group : report.groups) {
    lines.push_back({Name(group.group), Share(group.fraction),
                     MedianText(group.ns_per_sample),
                     group.lane_slots > 0 ? Share(group.Occupancy()) : ""});
    values.push_back(group.fraction);
  }
  return BarTable(lines, values);
}

// Returns at most `room` lines of the most expensive stages and parts of tasks.
std::string StageTable(const ProfileReport& report, std::size_t room) {
  constexpr std::size_t kMaxStages = 12;
  constexpr double kMinShare = 0.005;
  CellLines lines = {{"stage", "share", "ns/item", "items", "lanes"}};
  std::vector<double> values;
  std::size_t more = 0;
  double share = 0;
  for (const ProfileRow& row : report.rows) {
    const StageProfile& c = row.counts;
    if (row.kind != RowKind::kStage && row.kind != RowKind::kPart) continue;
    if (values.size() >= kMaxStages || values.size() + 2 >= room ||
        (row.fraction < kMinShare && !values.empty())) {
      ++more;
      share += row.fraction;
      continue;
    }
    lines.push_back({c.name, Share(row.fraction), Ns(row.NsPerItem()),
                     TotalText(double(c.items)),
                     c.lane_slots > 0 ? Share(c.Occupancy()) : ""});
    values.push_back(row.fraction);
  }
  if (values.empty()) return "";
  return BarTable(lines, values) +
         (more == 0
              ? ""
              : fmt::format("{} other stages: {}; all with -v\n", more, Share(share)));
}

// Explains groups of a strategy's own, and warns of other programs.
std::string GroupNotes(const ProfileReport& report) {
  const std::size_t width = TerminalColumns(Stream::kOutput);
  std::string text;
  for (const ProfileGroupRow& group : report.groups) {
    if (group.group < ProfileGroup::kVisibleLights) continue;
    text +=
        Wrapped(fmt::format("{}: {}", Name(group.group), Meaning(group.group)), width) +
        "\n";
  }
  const auto repeats = int(report.ns_per_sample.size());
  if (repeats > 1 && repeats < kProfileRepeats) {
    text += Wrapped(fmt::format("Intervals are ranges of {} repeats; 95 % intervals need "
                                "{}.",
                                repeats, kProfileRepeats),
                    width) +
            "\n";
  }
  if (report.busy.empty()) return text;
  return text +
         Wrapped(fmt::format("warning: the machine was busy: {}",
                             fmt::join(report.busy, "; ")),
                 width) +
         "\n";
}

std::size_t LinesOf(const std::string& text) {
  return std::size_t(std::ranges::count(text, '\n'));
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

std::vector<std::string> CostCells(const ProfileRow& row) {
  const StageProfile& c = row.counts;
  std::vector<std::string> cells(12);
  cells[0] = c.name;
  cells[1] = Share(row.fraction);
  if (row.ns_per_sample.size() > 1) cells[2] = MedianText(row.ns_per_sample);
  if (c.calls == 0) return cells;
  cells[3] = Ns(row.NsPerItem());
  cells[4] = TotalText(double(c.items));
  cells[5] = TotalText(double(c.calls));
  if (row.kind != RowKind::kStage) return cells;
  cells[6] = Share(c.Occupancy());
  cells[7] = fmt::format("{:.0f}", c.bytes_read);
  cells[8] = fmt::format("{:.0f}", c.bytes_written);
  cells[9] = fmt::format("{:.1f}", 1e-9 * row.bandwidth);
  cells[10] = fmt::format("{:.0f}%", 100 * row.of_peak);
  cells[11] = Name(row.bound);
  return cells;
}

std::string CostTable(const ProfileReport& report) {
  CellLines lines = {{"stage", "share", "ns/sample", "ns/item", "items", "calls", "lanes",
                      "read", "write", "GB/s", "of " + report.level.name.substr(0, 3),
                      "bound"}};
  for (const ProfileRow& row : report.rows) lines.push_back(CostCells(row));
  const std::string text =
      Table(lines, lines[0].size() == WithoutEmptyColumns(lines)[0].size()) +
      fmt::format("total      {} of processor time, all threads together\n",
                  DurationText(report.seconds));
  if (!(report.intersect_seconds > 0)) return text;
  return text + fmt::format(
                    "\ntime of other stages / time of intersection: {:.2f} (with film "
                    "and set-up: "
                    "{:.2f})\n",
                    report.Ratio(), report.RatioWithAll());
}

std::string BounceCosts(const ProfileReport& report) {
  CellLines lines = {{"bounce", "share", "closest rays", "shadow rays", "lanes"}};
  for (std::size_t i = 0; i < report.bounces.size(); ++i) {
    const BounceProfile& b = report.bounces[i];
    lines.push_back({fmt::format("{}{}", i, i + 1 == kMaxBounces ? " and more" : ""),
                     Share(report.seconds > 0 ? b.seconds / report.seconds : 0),
                     TotalText(b.rays_closest), TotalText(b.rays_shadow),
                     b.lane_slots > 0 ? Share(b.items / b.lane_slots) : ""});
  }
  return lines.size() > 1 ? "\n" + Table(lines) : "";
}

std::string MaterialCosts(const ProfileReport& report) {
  CellLines lines = {{"material", "share", "ns/path", "paths", "lanes"}};
  for (const ProfileRow& row : report.rows) {
    const StageProfile& c = row.counts;
    if (c.material.empty()) continue;
    lines.push_back({c.material, Share(row.fraction), Ns(row.NsPerItem()),
                     TotalText(double(c.items)), Share(c.Occupancy())});
  }
  return lines.size() > 1 ? "\n" + Table(lines) : "";
}

// Per item, user mode; of the calls in which the counters were read.
std::string CounterTable(const ProfileReport& report) {
  CellLines lines = {
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
  return "\n" + Table(lines);
}

// Explains columns that could be misread.
std::string Notes(const ProfileReport& report) {
  std::string text = SummaryRow(
      "read,write", fmt::format(" bytes of path columns per item; read, write, GB/s and "
                                "\"of {}\" exclude BVH, triangles, textures and tables",
                                report.level.name));
  const auto is_known = [](const ProfileRow& r) { return r.bound != Bound::kUnknown; };
  if (std::ranges::none_of(report.rows, is_known)) return text;
  return text +
         SummaryRow("bound", "what limits the speed of the stage (docs/profile.md)");
}

}  // namespace

std::string ProfileText(const ProfileReport& report, const Job& job,
                        const RunResult& result, const std::string& scene, bool verbose) {
  const std::string begin =
      AnswerText(report, job, result) + "\n" + GroupTable(report) + "\n";
  const std::string notes = GroupNotes(report);
  if (!verbose) {
    const std::size_t used = LinesOf(begin) + LinesOf(notes) + 1;
    const std::size_t room = kProfileLines - std::min(kProfileLines, used);
    return begin + StageTable(report, room) + (notes.empty() ? "" : "\n" + notes);
  }
  return begin + DetailRows(report, job, result, scene) + CostTable(report) +
         (result.counters ? CounterTable(report) : "") + BounceCosts(report) +
         MaterialCosts(report) + "\n" + Notes(report) + notes;
}

}  // namespace lanelight
