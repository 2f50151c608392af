// What becomes of the finished cells: sweep.csv and the page.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "src/measure/sweep/runner.h"
#include "src/measure/sweep/sweep_folder.h"
#include "src/render/job/render.h"

namespace lanelight {

/// The report of a render with what sweeps add to it: processor seconds, the machine.
nlohmann::json CellReport(const Rendering& rendering);

/// Looks at all cells, writes the table and the page, and says in `outcome` how the whole
/// sweep stands.
void WriteResults(const Sweep& sweep, SweepFolder& folder, SweepOutcome& outcome);

/// Of all cells, ascending.
std::vector<std::string> StageNames(const std::vector<nlohmann::json>& cells);

/// Returns whether the page shows a measure, of those that a cell has.
bool IsOnPage(const std::string& measure);

/// A cell as the page has it (docs/sweep.md); numbers that are not known are null.
nlohmann::json CellJson(const SweepCell& cell, const CellRecord& record);

/// sweep.csv of such cells, in order.
std::string SweepCsv(const std::vector<nlohmann::json>& cells);

}  // namespace lanelight
