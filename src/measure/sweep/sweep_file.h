// A sweep as its TOML file says (docs/sweep.md).
#pragma once

#include <map>
#include <string>
#include <vector>

#include "src/measure/sweep/grid.h"
#include "src/render/job/settings.h"

namespace lanelight {

/// [settings]: what is the same for all cells.
struct SweepSettings {
  RenderSettings render;
  /// What the file says, by key, in one form each: part of what a cell is.
  std::map<std::string, std::string> texts;
};

struct Sweep {
  std::string path, text;  // of the file
  SweepSettings settings;
  std::vector<SweepCell> cells;
  /// Of each strategy, by its text: at least one where the file names it.
  std::map<std::string, std::vector<StrategyPlace>> places;
  std::size_t excluded = 0;  // combinations that are left out

  /// Where the scene of a cell is: names are relative to the sweep file.
  std::string ScenePath(const SweepCell& cell) const;
  /// Axes that some cell has, in order.
  std::vector<Axis> UsedAxes() const;
};

/// Reads the file. Throws InputError with file, line and column for whatever is not as
/// docs/sweep.md says.
Sweep ReadSweep(const std::string& path);

/// The same of a text that stands in for the file `path`.
Sweep ParseSweep(const std::string& path, const std::string& text);

}  // namespace lanelight
