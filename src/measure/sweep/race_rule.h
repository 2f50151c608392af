// When strategies of a race stop: a function of their costs.
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

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
  /// Set if the race ends undecided: with 95 % confidence, the cost of no strategy that
  /// has not lost exceeds that of the best by more than this fraction.
  std::optional<double> within;
};

/// Returns when each strategy stops, for `seeds` seeds. Depends on the costs alone, so
/// that all processes decide alike.
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
/// The race ends when one strategy is left, which stops after kMinRankedSeeds seeds. It
/// ends undecided when all seeds would separate the best from the closest other strategy
/// with a probability below 5 %, by the predictive distribution of their difference
/// (stopping for futility; Spiegelhalter, Freedman and Blackburn 1986, "Monitoring
/// clinical trials: conditional or predictive power?").
RaceResult StopsOf(const std::vector<Racer>& racers, std::size_t seeds);

/// Standard deviation of the logarithm of a render's processor time, on a busy machine.
inline constexpr double kTimeDeviation = 0.15;

}  // namespace lanelight
