// Writes throughput as tables: for a terminal, in Markdown, and as CSV.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "src/measure/throughput/throughput.h"

namespace lanelight {

/// Markdown without line breaks in rows, or text of at most `width` columns.
struct TableStyle {
  bool markdown = false;
  std::size_t width = 80;
};

/// Returns the machine and two tables: rates, and nanoseconds per sample by kind of
/// stage.
std::string ThroughputText(const std::vector<ThroughputRow>& rows, double within,
                           const TableStyle& style);
/// Returns one line per row, each with the machine.
std::string ThroughputCsv(const std::vector<ThroughputRow>& rows);
}  // namespace lanelight
