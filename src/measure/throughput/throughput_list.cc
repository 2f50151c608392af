// Results of several machines beside each other.
#include <fmt/format.h>

#include <algorithm>
#include <tuple>

#include "src/base/core/text_layout.h"
#include "src/measure/throughput/throughput_comparison.h"

namespace lanelight {
namespace {

using Cells = std::vector<std::string>;

// The rows of a result with the same target and threads.
struct Line {
  std::string target;
  int threads = 0;
  bool all_cores = false;  // no line of the result has more threads
  std::vector<const KnownRow*> rows;
};

std::vector<Line> LinesOf(const KnownThroughput& result) {
  std::vector<Line> lines;
  int most = 0;
  for (const KnownRow& row : result.rows) {
    most = std::max(most, row.threads);
    auto line = std::ranges::find_if(lines, [&](const Line& l) {
      return l.target == row.target && l.threads == row.threads;
    });
    if (line == lines.end()) {
      line = lines.insert(line, {row.target, row.threads, false, {}});
    }
    line->rows.push_back(&row);
  }
  for (Line& line : lines) line.all_cores = line.threads == most;
  return lines;
}

// Returns the line with as many threads, or if both are on all cores, that line; of the
// same target if there is one. Null without one.
const Line* Counterpart(const Line& line, const std::vector<Line>& reference) {
  const Line* best = nullptr;
  int best_score = 0;
  for (const Line& other : reference) {
    const bool same = other.threads == line.threads;
    if (!same && !(line.threads > 1 && line.all_cores && other.all_cores)) continue;
    const int score = 1 + 2 * int(same) + int(other.target == line.target);
    if (score > best_score) std::tie(best, best_score) = std::tuple(&other, score);
  }
  return best;
}

std::string RatioText(const std::vector<Interval>& ratios) {
  if (ratios.empty()) return "-";
  const Interval mean = GeometricMean(ratios);
  return fmt::format("{:.2f} [{:.2f}, {:.2f}]", mean.value, mean.low, mean.high);
}

Cells CellsOf(const std::string& number, const Line& line,
              const std::vector<Line>& reference, const Cells& scenes, bool& marked) {
  const Line* const other = Counterpart(line, reference);
  Cells cells = {number, line.target, std::to_string(line.threads)};
  std::vector<Interval> ratios, cpu_ratios;
  for (const std::string& scene : scenes) {
    const auto row = std::ranges::find(line.rows, scene, &KnownRow::label);
    if (row == line.rows.end()) {
      cells.push_back("-");
      continue;
    }
    const KnownRow* before = nullptr;
    for (const KnownRow* r : other ? other->rows : std::vector<const KnownRow*>()) {
      if ((*row)->SameWork(*r)) before = r;
    }
    marked |= before == nullptr;
    cells.push_back(
        fmt::format("{:.3g}{}", 1e-6 * (*row)->rate.value, before ? "" : "*"));
    if (before == nullptr) continue;
    ratios.push_back(RateRatioOf((*row)->rate, before->rate));
    cpu_ratios.push_back(RateRatioOf((*row)->cpu_rate, before->cpu_rate));
  }
  const bool itself = other != nullptr && other->rows == line.rows;
  cells.push_back(itself ? "1" : RatioText(ratios));
  cells.push_back(itself ? "1" : RatioText(cpu_ratios));
  return cells;
}

}  // namespace

std::string ListText(const std::vector<KnownThroughput>& results,
                     const KnownThroughput& reference, std::size_t width) {
  std::string text;
  Cells scenes;
  for (const KnownThroughput& result : results) {
    for (const KnownRow& row : result.rows) {
      const bool known = std::ranges::find(scenes, row.label) != scenes.end();
      if (!known) scenes.push_back(row.label);
    }
  }
  Cells head = {"result", "target", "threads"};
  head.insert(head.end(), scenes.begin(), scenes.end());
  head.insert(head.end(), {"wall ratio", "processor ratio"});
  std::vector<Cells> table = {head};
  const std::vector<Line> reference_lines = LinesOf(reference);
  bool marked = false;
  for (std::size_t i = 0; i < results.size(); ++i) {
    const KnownThroughput& r = results[i];
    const std::string number = std::to_string(i + 1);
    const bool itself = &r == &reference;
    text += LabelledRow(number, fmt::format("{}, {}", r.name, r.machine), width, 2) +
            LabelledRow("", fmt::format("{} {}", r.date, r.program), width, 2);
    if (!r.busy.empty()) {
      text += LabelledRow("", fmt::format("busy: {}", fmt::join(r.busy, "; ")), width, 2);
    }
    const std::vector<Line> lines = itself ? reference_lines : LinesOf(r);
    for (const Line& line : lines) {
      table.push_back(CellsOf(number, line, reference_lines, scenes, marked));
    }
  }
  text +=
      "\n" + TextTable(table, {width, 3, 0}) + "\n" +
      Wrapped(
          fmt::format(
              "Millions of samples per wall second. Ratios to '{}': "
              "geometric means with 95 % intervals, per wall and per "
              "processor second. The most threads are compared with the most threads.",
              reference.name),
          width) +
      "\n";
  if (marked) {
    text += Wrapped(
                "* not comparable: the reference has no such row with the same scene "
                "file, size, samples per pixel and strategy.",
                width) +
            "\n";
  }
  return text;
}

}  // namespace lanelight
