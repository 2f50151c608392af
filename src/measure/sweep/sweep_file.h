// A sweep read from its TOML file (docs/sweep.md).
#pragma once

#include <map>
#include <string>
#include <vector>

#include "src/base/core/error.h"
#include "src/base/core/source_location.h"
#include "src/measure/sweep/axes.h"
#include "src/render/job/settings.h"

namespace lanelight {

/// Place of a strategy on the page. A strategy of a pattern has parameters.
struct StrategyPlace {
  std::string family;  // the pattern with "*" in its open parts: "roulette=throughput:*"
  /// Values of the open parts, by the text before them: {"roulette=throughput", "0.05"}.
  std::map<std::string, std::string> parameters;

  bool operator==(const StrategyPlace&) const = default;
};

struct PatternStrategy {
  std::string text;  // for StrategyNamed()
  StrategyPlace place;
};

/// Expands a pattern; the last open part changes fastest. "{a, b}" is expanded to each of
/// these texts, "*" to each choice of its axis ("points=*"). Throws InputError at `where`
/// for braces that are empty or not closed, for a "*" elsewhere, and for more than
/// 10 000 strategies.
std::vector<PatternStrategy> ExpandStrategy(const std::string& text,
                                            const SourceLocation& where);

struct GridValue {
  std::string text;  // see CanonicalValue()
  SourceLocation where;
  std::vector<StrategyPlace> places = {};  // of a strategy
};

/// Values of some axes: [grid], or a table of [[include]] or [[exclude]].
struct SubGrid {
  SourceLocation where;
  std::map<Axis, std::vector<GridValue>> axes;
};

struct SweepCell {
  std::size_t index = 0;  // in grid order
  AxisValues values;
  /// Name of its directory: readable, unique, and a function of the values only, so that
  /// it does not depend on the grid.
  std::string name;

  bool operator==(const SweepCell&) const = default;
};

/// Returns the places of all strategies, by text, each place once.
std::map<std::string, std::vector<StrategyPlace>> PlacesOf(
    const std::vector<SubGrid>& grids);

/// Returns the cells of all grids in order, each once, without those that match all axes
/// of a table of `exclude`. Throws InputError for more than a million, for a table of
/// `exclude` that is empty or matches no cell, and if no cell is left.
std::vector<SweepCell> ExpandGrid(const std::vector<SubGrid>& grids,
                                  const std::vector<SubGrid>& exclude);

/// Returns e.g. "box_64x48_points=halton_16spp_seed1-83a1c09b52".
std::string CellName(const AxisValues& values);

/// [settings]: settings of all cells.
struct SweepSettings {
  RenderSettings render;
  /// Canonical texts by key; part of the identity of a cell.
  std::map<std::string, std::string> texts;
};

struct Sweep {
  std::string path, text;  // of the file
  SweepSettings settings;
  std::vector<SweepCell> cells;
  /// Places by the text of a strategy.
  std::map<std::string, std::vector<StrategyPlace>> places;
  std::size_t excluded = 0;  // combinations that are left out

  /// Returns the path of a cell's scene. The sweep file has relative names.
  std::string ScenePath(const SweepCell& cell) const;
  /// Returns the axes that any cell has, in order.
  std::vector<Axis> UsedAxes() const;
};

/// Reads the file. Throws InputError with file, line and column.
Sweep ReadSweep(const std::string& path);

/// Parses a text as the content of the file `path`.
Sweep ParseSweep(const std::string& path, const std::string& text);

}  // namespace lanelight
