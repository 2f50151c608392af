// Results of several machines beside each other.
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "src/base/core/text_layout.h"
#include "src/measure/throughput/throughput_comparison.h"

namespace lanelight {
namespace {

using Cells = std::vector<std::string>;

int MostThreads(const KnownThroughput& result) {
  int most = 0;
  for (const KnownRow& row : result.rows) most = std::max(most, row.threads);
  return most;
}

// Returns the row of the reference that does the same work with as many threads, or with
// the most threads of both results; of the same target if possible. Null without one.
const KnownRow* Counterpart(const KnownRow& row, const KnownThroughput& result,
                            const KnownThroughput& reference) {
  const bool all = row.threads > 1 && row.threads == MostThreads(result);
  const KnownRow* best = nullptr;
  int best_score = 0;
  for (const KnownRow& other : reference.rows) {
    const bool same = other.threads == row.threads;
    if (!row.SameWork(other) ||
        !(same || (all && other.threads == MostThreads(reference))))
      continue;
    const int score = 1 + 2 * int(same) + int(other.target == row.target);
    if (score > best_score) best = &other;
    best_score = std::max(best_score, score);
  }
  return best;
}

std::string RatioText(const std::vector<Interval>& ratios) {
  const Interval mean = GeometricMean(ratios);
  if (ratios.empty()) return "-";
  return fmt::format("{:.2f} [{:.2f}, {:.2f}]", mean.value, mean.low, mean.high);
}

// Adds a line for each target and number of threads.
void AddLines(const std::string& number, const KnownThroughput& result,
              const KnownThroughput& reference, std::vector<Cells>& table) {
  struct Line {
    Cells cells;
    std::vector<Interval> ratios, cpu_ratios;
  };
  std::map<std::pair<std::string, int>, Line> lines;
  for (const KnownRow& row : result.rows) {
    Line& line = lines[{row.target, row.threads}];
    line.cells.resize(table[0].size(), "-");
    const KnownRow* const other = Counterpart(row, result, reference);
    const auto column = std::ranges::find(table[0], row.label) - table[0].begin();
    line.cells[std::size_t(column)] =
        fmt::format("{:.3g}{}", 1e-6 * row.rate.value, other ? "" : "*");
    if (other == nullptr) continue;
    line.ratios.push_back(RateRatioOf(row.rate, other->rate));
    line.cpu_ratios.push_back(RateRatioOf(row.cpu_rate, other->cpu_rate));
  }
  const bool itself = &result == &reference;
  for (auto& [key, line] : lines) {
    std::ranges::copy(Cells{number, key.first, std::to_string(key.second)},
                      line.cells.begin());
    line.cells.end()[-2] = itself ? "1" : RatioText(line.ratios);
    line.cells.end()[-1] = itself ? "1" : RatioText(line.cpu_ratios);
    table.push_back(std::move(line.cells));
  }
}

}  // namespace

std::string ListText(const std::vector<KnownThroughput>& results, std::size_t reference,
                     std::size_t width) {
  std::vector<Cells> table = {{"result", "target", "threads"}};
  for (const KnownThroughput& result : results) {
    for (const KnownRow& row : result.rows) {
      Cells& head = table[0];
      if (std::ranges::find(head, row.label) == head.end()) head.push_back(row.label);
    }
  }
  table[0].insert(table[0].end(), {"wall ratio", "CPU ratio"});
  std::string text;
  for (std::size_t i = 0; i < results.size(); ++i) {
    const KnownThroughput& r = results[i];
    const std::string busy =
        r.busy.empty() ? "" : fmt::format("; busy: {}", fmt::join(r.busy, "; "));
    text += LabelledRow(
        std::to_string(i + 1),
        fmt::format("{}, {}, {}, {}{}", r.name, r.date, r.machine, r.program, busy),
        width, 2);
    AddLines(std::to_string(i + 1), r, results[reference], table);
  }
  const std::string note = fmt::format(
      "Millions of samples per wall second. Ratios to result {}: geometric means with "
      "95 % intervals, per wall and per processor second. AVX3 is AVX-512.",
      reference + 1);
  const char* const mark =
      "* not comparable: another scene file, size, samples per pixel or strategy.";
  text += "\n" + TextTable(table, {width, 3, 0}) + "\n" + Wrapped(note, width) + "\n";
  const bool marked = std::ranges::any_of(table, [](const Cells& line) {
    return std::ranges::any_of(line,
                               [](const auto& cell) { return cell.ends_with("*"); });
  });
  return marked ? text + Wrapped(mark, width) + "\n" : text;
}

}  // namespace lanelight
