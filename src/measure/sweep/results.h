// Results of finished cells: sweep.csv, sweep.json and the page.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "src/measure/report/page.h"
#include "src/measure/sweep/runner.h"
#include "src/measure/sweep/sweep_file.h"
#include "src/measure/sweep/sweep_folder.h"
#include "src/render/job/render.h"

namespace lanelight {

/// Returns the report of a render with processor seconds, machine and program.
nlohmann::json CellReport(const Rendering& rendering);

/// A cell as its files have it.
struct CellResult {
  nlohmann::json json;  // by CellJson(); null: not read
  bool differs = false;
};
using CellResults = std::vector<CellResult>;  // of all cells, by index

/// Reads the cells that `results` lacks, in parallel. Throws InputError (ReadCell).
void ReadMissing(const Sweep& sweep, SweepFolder& folder, CellResults& results);

/// Reads the cells that `results` lacks, writes the table and the page, and adds the
/// state of the whole sweep to `outcome`. `race`: missing cells of strategies that have
/// lost are kStopped.
void WriteResults(const Sweep& sweep, SweepFolder& folder, bool race, CellResults results,
                  SweepOutcome& outcome);

/// Returns the names of stages of all cells, ascending.
std::vector<std::string> StageNames(const std::vector<nlohmann::json>& cells);

/// Returns whether the page shows this measure of cells.
bool IsOnPage(const std::string& measure);

/// Writes a cell (docs/sweep.md); unknown numbers are null.
nlohmann::json CellJson(const SweepCell& cell, const CellRecord& record);

/// Returns sweep.csv of cells by CellJson().
std::string SweepCsv(const std::vector<nlohmann::json>& cells);

/// Fewest seeds of a ranking.
inline constexpr int kMinRankedSeeds = 4;

/// Cells that differ in their seed only: repetitions of one render.
struct CellGroup {
  /// Texts by axis, without the seed. Open parts of a strategy are axes, and the strategy
  /// is its family.
  std::map<std::string, std::string> values;
  std::string strategy;            // empty if the sweep has no such axis
  std::size_t context = 0;         // equal for groups that differ in strategy only
  std::vector<std::size_t> cells;  // finished ones, by index
  bool lost = false;               // by --race: it is not among the best
  std::optional<double> within;    // of an undecided race (RaceResult::within)
};

/// Returns all groups in the order of the grid, with or without finished cells. A
/// strategy with several places (Sweep::places) is in several groups.
std::vector<CellGroup> GroupCells(const Sweep& sweep,
                                  const std::vector<nlohmann::json>& cells);

/// Returns the names of scenes on the page, by their texts in the sweep file.
std::map<std::string, std::string> NamesOfScenes(const Sweep& sweep);

/// Writes groups with finished cells: "values", "strategy", "cells", for several cells
/// "measured" (intervals of means), and "efficiency" relative to the baseline with the
/// same seeds (src/base/stat/efficiency.h); null if unknown.
nlohmann::json GroupsJson(const std::vector<CellGroup>& groups,
                          const std::vector<nlohmann::json>& cells,
                          const std::string& baseline);

/// Writes the most efficient strategy, and which may be as efficient, for the last
/// context of each scene with several strategies of known error; docs/sweep.md.
nlohmann::json LeadersJson(const std::vector<CellGroup>& groups,
                           const std::vector<nlohmann::json>& cells,
                           const std::string& baseline);

/// Returns values as text: "box, spp 64".
std::string ValuesText(const nlohmann::json& values);

/// Returns the leaders as text, a line for each scene; with fewer than four seeds, what a
/// ranking needs. Empty without leaders.
std::string AnswerText(const nlohmann::json& leaders);

/// Returns "default" or else the first strategy of the grid; empty without any.
std::string BaselineOf(const Sweep& sweep);

/// Writes sweep.json (docs/sweep.md); `cells` by CellJson().
nlohmann::json SweepJson(const Sweep& sweep, const std::vector<nlohmann::json>& cells,
                         const std::vector<CellGroup>& groups);

/// Returns sweep.json as the page has it: "packed" instead of "cells", with a column for
/// each member and numbers of six digits, so that a page can have 100 000 cells.
nlohmann::json PageJson(nlohmann::json sweep_json);

/// Returns a small image of the first finished cell of each of the first 1000 groups,
/// named like the cell; at most about 8 MB of text. Omits images that cannot be read.
std::vector<ReportImage> Thumbnails(const Sweep& sweep, const SweepFolder& folder,
                                    const std::vector<CellGroup>& groups);

}  // namespace lanelight
