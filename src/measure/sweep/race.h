// Racing (sweep --race): strategies that are clearly less efficient than the best stop
// after a few seeds, and so do all where more seeds would not tell the best.
#pragma once

#include <cstddef>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "src/base/stat/interval.h"
#include "src/measure/sweep/race_rule.h"
#include "src/measure/sweep/sweep_file.h"
#include "src/measure/sweep/sweep_folder.h"

namespace lanelight {

/// The races of a sweep: one for each combination of the axes but strategy and seed.
class Race {
 public:
  explicit Race(const Sweep& sweep);

  /// Position of the cell's seed among all: lower ones come first.
  std::size_t Round(std::size_t cell) const { return rounds_[cell]; }
  /// Enters a finished cell: its relative MSE with a 95 % interval, and processor
  /// seconds.
  void Enter(std::size_t cell, const Interval& error, double seconds);
  bool HasEntered(std::size_t cell) const { return entered_[cell]; }
  /// Returns the cells of the race that a cell belongs to.
  const std::vector<std::size_t>& Rivals(std::size_t cell) const;
  /// Returns whether the cell's strategy has stopped before this seed.
  bool IsStopped(std::size_t cell) const;
  bool HasLost(std::size_t cell) const;
  /// Returns RaceResult::within of the cell's race.
  std::optional<double> Within(std::size_t cell) const;

 private:
  struct Context {
    std::vector<std::size_t> cells;
    std::map<std::string, std::size_t> racer_of;  // by strategy
    std::vector<Racer> racers;
    std::vector<std::map<std::size_t, double>> costs;  // of each, by round
    RaceResult result;
  };

  void Update(Context& context) const;

  std::size_t seeds_ = 0;
  std::vector<std::size_t> rounds_, context_of_, racer_of_;  // by cell
  std::vector<bool> entered_;
  std::vector<Context> contexts_;
};

/// Enters a cell if it is finished.
void EnterIfDone(Race& race, SweepFolder& folder, const SweepCell& cell);
/// Sets missing cells (of CellJson) that are not needed to kStopped and returns their
/// number. Sets "lost" of those whose strategy is clearly less efficient than the best,
/// and "within" of the others if their race ends undecided (RaceResult).
std::size_t MarkStopped(const Sweep& sweep, std::vector<nlohmann::json>& cells);

}  // namespace lanelight
