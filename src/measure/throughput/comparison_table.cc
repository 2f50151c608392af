// Ratios of two measurements as a table, and what follows from them.
#include <fmt/format.h>

#include "src/base/core/text_layout.h"
#include "src/measure/throughput/throughput_table.h"
#include "src/measure/throughput/throughput_warnings.h"

namespace lanelight {
namespace {

using Cells = std::vector<std::string>;

constexpr std::size_t kRowIndent = 8;

std::string IntervalText(const Interval& ratio) {
  return fmt::format("{:.3f} [{:.3f}, {:.3f}]", ratio.value, ratio.low, ratio.high);
}

std::string VerdictText(const RateComparison& comparison, double tolerance) {
  const std::string fast =
      comparison.rows.empty()
          ? ""
          : fmt::format("{:.3g} times as fast (geometric mean of {}); ",
                        comparison.Mean(), comparison.rows.size());
  std::string slower;
  for (const RateRatio& row : comparison.rows) {
    if (row.Regresses(tolerance)) slower += (slower.empty() ? "" : "; ") + row.row;
  }
  switch (comparison.Judge(tolerance)) {
    case RateComparison::Verdict::kSlower:
      return fast + "slower: " + slower + ".";
    case RateComparison::Verdict::kNotSlower:
      return fast +
             fmt::format("nothing is slower by more than {:.3g} %.", 100 * tolerance);
    case RateComparison::Verdict::kNotComparable:
      break;
  }
  std::string why = fmt::format("{}", fmt::join(comparison.busy, "; "));
  if (why.empty()) {
    why = comparison.refused.empty()
              ? "no row is in both"
              : "rows differ in samples, size, threads, target or strategy";
  }
  return "not comparable: " + why + ".";
}

}  // namespace

std::string ComparisonText(const RateComparison& comparison,
                           const KnownThroughput& before, double tolerance,
                           std::size_t width) {
  std::string text = LabelledRow("against", before.machine, width, kRowIndent) +
                     LabelledRow("", before.program, width, kRowIndent) + "\n";
  const auto line = [width](const std::string& words) {
    return Wrapped(words, width, kRowIndent) + "\n";
  };
  if (!comparison.rows.empty()) {
    std::vector<Cells> lines = {{"ratio of rates", "per second", "per processor s", ""}};
    const bool slow = comparison.Judge(tolerance) == RateComparison::Verdict::kSlower;
    for (const RateRatio& row : comparison.rows) {
      lines.push_back({row.row, IntervalText(row.ratio), IntervalText(row.cpu_ratio),
                       slow && row.Regresses(tolerance) ? "SLOWER" : ""});
    }
    text += TextTable(lines, {width, 1, 1});
  }
  for (const std::string& row : comparison.refused) text += line("refused: " + row);
  for (const std::string& row : comparison.only_in_one) {
    text += line("only in one of them: " + row);
  }
  return text + "\n" + Wrapped(VerdictText(comparison, tolerance), width) + "\n" +
         Wrapped(
             "Intervals tell how well each run knows its medians, not what else the "
             "machines did meanwhile.",
             width) +
         "\n";
}

}  // namespace lanelight
