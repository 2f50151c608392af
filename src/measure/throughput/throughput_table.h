// Throughputs as tables: for a terminal, in Markdown, and as comma-separated values.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "src/measure/throughput/throughput_comparison.h"

namespace lanelight {

/// Markdown, its lines whole, or columns of text that fit `width`.
struct TableStyle {
  bool markdown = false;
  std::size_t width = 80;
};

/// Two tables, rates and nanoseconds per sample by kind of stage, below the machine.
std::string ThroughputText(const std::vector<ThroughputRow>& rows, double within,
                           const TableStyle& style);
/// One line per row, machine included.
std::string ThroughputCsv(const std::vector<ThroughputRow>& rows);
/// Ratios by row, and a sentence: which are slower by more than `tolerance`. Fits `width`
/// columns.
std::string ComparisonText(const RateComparison& comparison,
                           const KnownThroughput& before, double tolerance,
                           std::size_t width);

}  // namespace lanelight
