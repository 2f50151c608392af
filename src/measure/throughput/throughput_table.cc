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

// The first columns, which name the row, are left-aligned.
std::string Table(const std::vector<Cells>& lines, const TableStyle& style) {
  constexpr std::size_t kNames = 3;
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

std::string Millions(const Interval& rate) {
  const std::string median = Millions(rate.value);
  if (!rate.HasBounds()) return median;
  return fmt::format("{} [{}, {}]", median, Millions(rate.low), Millions(rate.high));
}

std::string RateTable(const std::vector<ThroughputRow>& rows, const TableStyle& style) {
  std::vector<Cells> lines = {
      {"scene", "target", "threads", "Msamples/wall s", "Msamples/CPU s", "scaling"}};
  for (const ThroughputRow& row : rows) {
    lines.push_back({SceneLabel(row.scene, rows), row.target, std::to_string(row.threads),
                     Millions(row.Rate()), Millions(row.CpuRate()), Scaling(rows, row)});
  }
  return Table(lines, style);
}

std::string WorkTable(const std::vector<ThroughputRow>& rows, const TableStyle& style) {
  std::vector<Cells> lines = {{"scene", "target", "threads", "Mrays/wall s", "lanes",
                               "bytes/path", "spp", "repeats"}};
  for (const ThroughputRow& row : rows) {
    lines.push_back({SceneLabel(row.scene, rows), row.target, std::to_string(row.threads),
                     Millions(double(row.rays()) / row.Seconds().value),
                     fmt::format("{:.0f} %", 100 * Lanes(row)),
                     std::to_string(row.bytes_per_path), std::to_string(row.spp),
                     std::to_string(row.seconds.size())});
  }
  return Table(lines, style);
}

std::string WarningLines(const std::vector<ThroughputRow>& rows, double within,
                         std::size_t width) {
  const std::vector<std::string> warnings = ThroughputWarnings(rows, within);
  if (warnings.empty()) {
    return Wrapped(
               fmt::format("Medians and 95 % intervals; per wall second within {:.3g} %.",
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
  const std::string gap = style.markdown ? "\n" : "";
  const std::size_t width = style.markdown ? std::string::npos : style.width;
  std::set<std::string> targets;
  for (const ThroughputRow& row : rows) targets.insert(TargetText(row.target));
  return LabelledRow("machine", MachineText(ThisMachine()), width, kLabel) + gap +
         LabelledRow("program", FullVersion(), width, kLabel) + gap +
         LabelledRow("target", fmt::format("{}", fmt::join(targets, ", ")), width,
                     kLabel) +
         "\n" + RateTable(rows, style) + "\n" + WorkTable(rows, style) + "\n" +
         WarningLines(rows, within, width);
}

std::string ThroughputCsv(const std::vector<ThroughputRow>& rows) {
  std::string text =
      "scene,target,threads,width_pixels,height_pixels,spp,repeats,seconds,"
      "samples_per_second,samples_per_second_low,samples_per_second_high,"
      "samples_per_cpu_second,samples_per_cpu_second_low,samples_per_cpu_second_high,"
      "rays_closest_per_second,rays_shadow_per_second,bytes_per_path,strategy," +
      MachineCsvHeader() + "\n";
  for (const ThroughputRow& row : rows) {
    const Interval rate = row.Rate(), cpu = row.CpuRate();
    const double seconds = row.Seconds().value;
    text += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n",
                        CsvField(row.scene), row.target, row.threads, row.width,
                        row.height, row.spp, row.seconds.size(), seconds, rate.value,
                        rate.low, rate.high, cpu.value, cpu.low, cpu.high,
                        double(row.counts.rays_closest) / seconds,
                        double(row.counts.rays_shadow) / seconds, row.bytes_per_path,
                        CsvField(row.strategy), MachineCsvRow(ThisMachine()));
  }
  return text;
}

}  // namespace lanelight
