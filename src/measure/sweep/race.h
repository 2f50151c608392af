// Racing (sweep --race): strategies that are clearly less efficient than the best stop
// after a few seeds.
#pragma once

#include <cstddef>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "src/base/stat/interval.h"
#include "src/measure/sweep/sweep_file.h"
#include "src/measure/sweep/sweep_folder.h"

namespace lanelight {

/// A strategy in a race.
struct Racer {
  /// Natural logarithms of error times seconds, a number for each finished seed, in the
  /// order of the seeds.
  std::vector<double> log_costs;
  /// Standard deviation of the first by the render's own interval of its error; NaN:
  /// unknown.
  double deviation = std::numeric_limits<double>::quiet_NaN();
  bool stays = false;  // the baseline: renders kMinRankedSeeds seeds even if it loses
};

struct RaceResult {
  /// After how many seeds each strategy stops; the number of all seeds: it does not.
  std::vector<std::size_t> stops;
  std::vector<bool> lost;  // clearly less efficient than the best
};

/// Returns who stops when, for `seeds` seeds. A function of the costs alone, so that all
/// processes decide alike.
///
/// Looks after each seed but the last. At each, a strategy loses if its mean is above
/// that of the best by enough standard errors. These are chosen so that the best loses by
/// chance in at most 5 % of races (Bonferroni over looks and strategies).
///
/// The first look, at a level of 1 %, uses the renders' own intervals of the error, and
/// kTimeDeviation for the time. The others use the scatter over seeds: costs of one seed
/// have much in common, so differences between strategies count. Their variance is
/// moderated: the strategy's own, pooled with that of all (Smyth 2004, "Linear models and
/// empirical Bayes methods"). They share 4 %, each look has half the level of the one
/// before.
///
/// The race ends when one strategy is left, which stops after kMinRankedSeeds seeds.
RaceResult StopsOf(const std::vector<Racer>& racers, std::size_t seeds);

/// Standard deviation of the logarithm of a render's processor time, on a busy machine.
inline constexpr double kTimeDeviation = 0.15;

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
/// Sets missing cells (of CellJson) that are not needed to kStopped, and "lost" of those
/// whose strategy is clearly less efficient than the best; returns their number.
std::size_t MarkStopped(const Sweep& sweep, std::vector<nlohmann::json>& cells);

}  // namespace lanelight
