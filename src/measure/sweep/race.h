// Racing (sweep --race): strategies that are clearly less efficient than the best stop
// after a few seeds.
#pragma once

#include <cstddef>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "src/measure/sweep/sweep_file.h"
#include "src/measure/sweep/sweep_folder.h"

namespace lanelight {

/// A strategy in a race.
struct Racer {
  /// Natural logarithms of error times seconds, a number for each finished seed, in the
  /// order of the seeds.
  std::vector<double> log_costs;
  bool stays = false;  // never stops: the baseline
};

/// Returns after how many of the `seeds` each strategy stops; `seeds`: it does not. A
/// function of the costs alone, so that all processes decide alike.
///
/// Looks after each seed from the second to the last but one. At each, a strategy stops
/// if its mean is above that of the best by enough standard errors. These are chosen so
/// that any strategy stops by chance in at most 5 % of races (Bonferroni over looks and
/// strategies, Student's t). Costs of one seed have much in common, so differences
/// between strategies count. Their variance is moderated: the strategy's own, pooled with
/// that of all (Smyth 2004, "Linear models and empirical Bayes methods").
std::vector<std::size_t> StopsOf(const std::vector<Racer>& racers, std::size_t seeds);

/// The races of a sweep: one for each combination of the axes but strategy and seed.
class Race {
 public:
  explicit Race(const Sweep& sweep);

  /// Position of the cell's seed among all: lower ones come first.
  std::size_t Round(std::size_t cell) const { return rounds_[cell]; }
  /// Enters a finished cell: its relative MSE and processor seconds.
  void Enter(std::size_t cell, double error, double seconds);
  bool HasEntered(std::size_t cell) const { return entered_[cell]; }
  /// Returns the cells of the race that a cell belongs to.
  const std::vector<std::size_t>& Rivals(std::size_t cell) const;
  /// Returns whether the cell's strategy has stopped before this seed.
  bool IsStopped(std::size_t cell) const;

 private:
  struct Context {
    std::vector<std::size_t> cells;
    std::map<std::string, std::size_t> racer_of;  // by strategy
    std::vector<Racer> racers;
    std::vector<std::map<std::size_t, double>> costs;  // of each, by round
    std::vector<std::size_t> stops;
  };

  void Update(Context& context) const;

  std::size_t seeds_ = 0;
  std::vector<std::size_t> rounds_, context_of_, racer_of_;  // by cell
  std::vector<bool> entered_;
  std::vector<Context> contexts_;
};

/// Enters a cell if it is finished.
void EnterIfDone(Race& race, SweepFolder& folder, const SweepCell& cell);
/// Sets missing cells (of CellJson) that are not needed to kStopped; returns their
/// number.
std::size_t MarkStopped(const Sweep& sweep, std::vector<nlohmann::json>& cells);

}  // namespace lanelight
