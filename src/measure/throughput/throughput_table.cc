#include "src/measure/throughput/throughput.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "src/base/core/machine_info.h"
#include "src/base/core/text_layout.h"
#include "src/base/core/version.h"
#include "src/base/stat/values.h"
#include "src/render/job/machine_json.h"

namespace lanelight {
namespace {

using Cells = std::vector<std::string>;

constexpr std::size_t kLabel = 8;

std::string MarkdownLine(const Cells& cells) {
  std::string line = "|";
  for (const std::string& cell : cells) line += " " + cell + " |";
  return line + "\n";
}

// The first two columns, scene and target, are left-aligned.
std::string Table(const std::vector<Cells>& lines, const TableStyle& style) {
  constexpr std::size_t kNames = 2;
  if (!style.markdown) return TextTable(lines, {style.width, kNames, 0});
  std::string text = MarkdownLine(lines[0]) + "|";
  for (std::size_t c = 0; c < lines[0].size(); ++c) text += c < kNames ? "---|" : "---:|";
  text += "\n";
  for (std::size_t i = 1; i < lines.size(); ++i) text += MarkdownLine(lines[i]);
  return text;
}

// Returns the rate relative to one thread; empty without such a row.
std::string Scaling(const std::vector<ThroughputRow>& rows, const ThroughputRow& row) {
  const ThroughputRow* one = OneThreadRow(rows, row);
  return one ? fmt::format("{:.2f}", row.Rate().value / one->Rate().value) : "";
}

double Lanes(const ThroughputRow& row) {
  std::uint64_t items = 0, slots = 0;
  for (const StageProfile& s : row.counts.stages) {
    items += s.items;
    slots += s.lane_slots;
  }
  return slots ? double(items) / double(slots) : 0;
}

std::string Millions(double value) { return fmt::format("{:.3g}", 1e-6 * value); }

Cells RateCells(const std::vector<ThroughputRow>& rows, const ThroughputRow& row) {
  const double seconds = row.Seconds().value;
  const std::string spread = std::isfinite(row.RelativeHalfWidth())
                                 ? fmt::format("{:.1f} %", 100 * row.RelativeHalfWidth())
                                 : "unknown";
  return {row.scene,
          row.target,
          std::to_string(row.threads),
          Millions(row.Rate().value),
          spread,
          Millions(row.CpuRate().value),
          Scaling(rows, row),
          Millions(double(row.counts.rays_closest) / seconds),
          Millions(double(row.counts.rays_shadow) / seconds),
          fmt::format("{:.0f} %", 100 * Lanes(row)),
          std::to_string(row.bytes_per_path),
          std::to_string(row.spp),
          std::to_string(row.seconds.size())};
}

// Lists each scene and target once: times per sample hardly depend on threads.
std::string GroupTable(const std::vector<ThroughputRow>& rows, const TableStyle& style) {
  std::vector<bool> used(std::size(kProfileGroups));
  for (const ThroughputRow& row : rows) {
    const std::vector<StageGroup> groups = StageGroups(row);
    for (std::size_t i = 0; i < used.size(); ++i) {
      used[i] = used[i] || groups[i].ns_per_sample > 0;
    }
  }
  std::vector<Cells> lines = {{"ns per sample", "target"}};
  for (std::size_t i = 0; i < used.size(); ++i) {
    if (used[i]) lines[0].push_back(kProfileGroups[i].name);
  }
  std::set<std::string> seen;
  for (const ThroughputRow& row : rows) {
    if (!seen.insert(row.scene + " " + row.target).second) continue;
    Cells& line = lines.emplace_back(Cells{row.scene, row.target});
    const std::vector<StageGroup> groups = StageGroups(row);
    for (std::size_t i = 0; i < used.size(); ++i) {
      if (used[i]) line.push_back(fmt::format("{:.0f}", groups[i].ns_per_sample));
    }
  }
  return Table(lines, style);
}

std::string WarningLines(const std::vector<ThroughputRow>& rows, double within,
                         std::size_t width) {
  const std::vector<std::string> warnings = ThroughputWarnings(rows, within);
  if (warnings.empty()) {
    return Wrapped(fmt::format("All medians are known within {:.3g} % (95 % intervals).",
                               100 * within),
                   width) +
           "\n";
  }
  std::string text;
  for (const std::string& warning : warnings) {
    text += Wrapped("warning: " + warning, width) + "\n";
  }
  return text;
}

}  // namespace

std::string ThroughputText(const std::vector<ThroughputRow>& rows, double within,
                           const TableStyle& style) {
  if (rows.empty()) return "Nothing was measured.\n";
  std::vector<Cells> lines = {{"scene", "target", "threads", "Msamples/s", "+-",
                               "per cpu s", "scaling", "closest M/s", "shadow M/s",
                               "lanes", "bytes/path", "spp", "repeats"}};
  for (const ThroughputRow& row : rows) lines.push_back(RateCells(rows, row));
  const std::string gap = style.markdown ? "\n" : "";
  const std::size_t width = style.markdown ? std::string::npos : style.width;
  return LabelledRow("machine", MachineText(ThisMachine()), width, kLabel) + gap +
         LabelledRow("program", FullVersion(), width, kLabel) + "\n" +
         Table(lines, style) + "\n" + GroupTable(rows, style) + "\n" +
         WarningLines(rows, within, width);
}

std::string ThroughputCsv(const std::vector<ThroughputRow>& rows) {
  std::string text =
      "scene,target,threads,width_pixels,height_pixels,spp,repeats,seconds,"
      "samples_per_second,samples_per_second_low,samples_per_second_high,"
      "samples_per_cpu_second,"
      "rays_closest_per_second,rays_shadow_per_second,bytes_per_path,strategy," +
      MachineCsvHeader() + "\n";
  for (const ThroughputRow& row : rows) {
    const Interval rate = row.Rate();
    const double seconds = row.Seconds().value;
    text +=
        fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n",
                    CsvField(row.scene), row.target, row.threads, row.width, row.height,
                    row.spp, row.seconds.size(), seconds, rate.value, rate.low, rate.high,
                    row.CpuRate().value, double(row.counts.rays_closest) / seconds,
                    double(row.counts.rays_shadow) / seconds, row.bytes_per_path,
                    CsvField(row.strategy), MachineCsvRow(ThisMachine()));
  }
  return text;
}

}  // namespace lanelight
