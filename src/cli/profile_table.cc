#include "src/cli/profile_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "kernels/simd/target.h"
#include "src/cli/progress.h"
#include "src/core/machine_info.h"
#include "src/core/parallel.h"

namespace lanelight {
namespace {

constexpr std::size_t kColumns = 100;
constexpr std::size_t kLabel = 12;

// "label      words ...", continued below the first word.
std::string Row(const std::string& label, const std::string& text) {
  std::string out, line = fmt::format("{:<{}}", label, kLabel);
  std::istringstream words(text);
  bool first = true;
  for (std::string word; words >> word; first = false) {
    if (!first && line.size() + 1 + word.size() > kColumns) {
      out += line + "\n";
      line = std::string(kLabel, ' ') + word;
    } else {
      line += (first ? "" : " ") + word;
    }
  }
  return out + line + "\n";
}

// Lets a list break after its commas.
std::string WithSpaces(const std::string& list) {
  std::string out;
  for (char c : list) out += c == ',' ? std::string(", ") : std::string(1, c);
  return out;
}

std::string PeaksText(const Peaks& peaks, SimdTarget target) {
  std::string text = "reads of one thread:";
  for (const MemoryLevel& level : peaks.levels) {
    text += fmt::format(" {} {:.0f} GB/s,", level.name, 1e-9 * level.bytes_per_second);
  }
  return text + fmt::format(" multiply-add {:.0f} Gflop/s ({})", 1e-9 * peaks.flops,
                            target.name());
}

std::string HeaderText(const ProfileReport& report, const Job& job,
                       const RunResult& result, const std::string& scene) {
  const double pixels = double(job.window.pixels());
  const SimdTarget target = job.plan.options.target;
  std::string text =
      fmt::format("{:<{}}{}\n", "scene", kLabel, scene) +
      Row("render",
          fmt::format("{}x{} pixels, {:.4g} samples each in {}{}; threads: {}, lanes: {} "
                      "({})",
                      job.window.width(), job.window.height(),
                      double(result.samples) / pixels, DurationText(result.seconds),
                      result.stopped_early ? " (stopped early)" : "",
                      ThreadCount(job.settings.threads), target.lanes(), target.name())) +
      Row("machine", MachineText(ThisMachine())) +
      Row("strategy", WithSpaces(ToText(job.scene.strategy))) +
      Row("peaks", PeaksText(report.peaks, target)) +
      Row("columns",
          fmt::format("{:.0f} KiB of a wavefront's paths, which live in {}",
                      double(result.bytes_in_flight) / 1024, report.level.name));
  if (result.counter_error != 0) {
    text += Row("counters", std::string(result.counters ? "in part: " : "none: ") +
                                WhyNoCounters(result.counter_error));
  }
  return text;
}

std::size_t NameWidth(const ProfileReport& report) {
  std::size_t width = 20;
  for (const ProfileRow& row : report.rows) {
    width = std::max(width, row.counts.name.size());
  }
  return width;
}

std::string CostHeader(const ProfileReport& report, std::size_t width) {
  return fmt::format("{:<{}}{:>7}{:>9}{:>8}{:>8}{:>7}{:>5}{:>6}{:>7}{:>6}  {}\n", "stage",
                     width, "share", "ns/item", "items", "calls", "lanes", "read",
                     "write", "GB/s", "of " + report.level.name.substr(0, 3), "bound");
}

// A number of at most eight characters.
std::string Ns(double ns) {
  return ns < 9999.5 ? fmt::format("{:.2f}", ns) : fmt::format("{:.3g}", ns);
}

std::string CostRow(const ProfileRow& row, std::size_t width) {
  const StageProfile& c = row.counts;
  std::string text = fmt::format("{:<{}}{:>6.1f}%", c.name, width, 100 * row.share);
  if (c.calls == 0) return text + "\n";
  text += fmt::format("{:>9}{:>8}{:>8}", Ns(row.NsPerItem()), TotalText(double(c.items)),
                      TotalText(double(c.calls)));
  if (row.kind != RowKind::kStage) return text + "\n";
  return text + fmt::format("{:>6.1f}%{:>5.0f}{:>6.0f}{:>7.1f}{:>5.0f}%  {}\n",
                            100 * c.Occupancy(), c.bytes_read, c.bytes_written,
                            1e-9 * row.bandwidth, 100 * row.of_peak, Name(row.bound));
}

std::string CostTable(const ProfileReport& report) {
  const std::size_t width = NameWidth(report);
  std::string text = CostHeader(report, width);
  for (const ProfileRow& row : report.rows) text += CostRow(row, width);
  text += fmt::format("{:<{}}{:>6.1f}%  {} of processor time, all threads together\n",
                      "total", width, 100.0, DurationText(report.seconds));
  if (!(report.intersect_seconds > 0)) return text;
  return text + fmt::format(
                    "\nother stages / intersect: {:.2f}   (with film and the rest: "
                    "{:.2f})\n",
                    report.Ratio(), report.RatioWithAll());
}

// Per item, user mode; of the calls in which the counters were read.
std::string CounterTable(const ProfileReport& report) {
  const std::size_t width = NameWidth(report);
  std::string text =
      fmt::format("\n{:<{}}{:>12}{:>14}{:>7}{:>12}{:>12}\n", "per item", width, "cycles",
                  "instructions", "IPC", "L1 misses", "LLC misses");
  for (const ProfileRow& row : report.rows) {
    if (row.counts.counted_items == 0) continue;
    text +=
        fmt::format("{:<{}}{:>12.1f}{:>14.1f}{:>7.2f}{:>12.3f}{:>12.4f}\n",
                    row.counts.name, width, row.PerItem(Counter::kCycles),
                    row.PerItem(Counter::kInstructions), row.InstructionsPerCycle(),
                    row.PerItem(Counter::kL1Misses), row.PerItem(Counter::kLlcMisses));
  }
  return text;
}

// What a reader would otherwise take for more than it is.
std::string Notes(const ProfileReport& report, const RunResult& result) {
  std::string text =
      Row("read, write",
          fmt::format(" bytes per item of path columns; trees, triangles, textures and "
                      "tables are not in them, nor in GB/s and \"of {}\"",
                      report.level.name));
  text += Row("bound", result.counters
                           ? "the limit that a stage works at (docs/profile.md)"
                           : "\"memory\" where the columns alone show it; without "
                             "counters \"-\" means not known (docs/profile.md)");
  if (report.waiting_seconds > 0.05 * report.seconds) {
    text += Row("busy", fmt::format("other programs had the processors for {:.0f} % of "
                                    "the time; the table counts processor time, but the "
                                    "caches were theirs too",
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
