#include "src/measure/sweep/race_rule.h"

#include <algorithm>
#include <cmath>

#include "src/base/stat/distributions.h"
#include "src/base/stat/hypothesis.h"
#include "src/measure/sweep/results.h"

namespace lanelight {
namespace {

// Levels of any wrong stop at the first look, and at the others.
constexpr double kFirstLevel = 0.01, kLevel = 0.04;
// Level of the intervals that the full grid ranks by, and of RaceResult::within.
constexpr double kRankLevel = 0.05;
// Probability of a decision by the full grid below which the race ends undecided.
constexpr double kMinPower = 0.05;
// Degrees of freedom that other strategies add at most to a strategy's own.
constexpr double kMaxPooledDof = 8;

// The strategies that have not stopped, at a look.
class Look {
 public:
  Look(const std::vector<Racer>& racers, const std::vector<std::size_t>& alive,
       std::size_t seeds)
      : alive_(alive), seeds_(double(seeds)), means_(alive.size()), own_(alive.size()) {
    std::vector<double> of_seed(seeds);
    for (std::size_t i = 0; i < alive.size(); ++i) {
      for (std::size_t s = 0; s < seeds; ++s) {
        const double cost = racers[alive[i]].log_costs[s];
        means_[i] += cost / seeds_;
        of_seed[s] += cost / double(alive.size());
      }
      mean_ += means_[i] / double(alive.size());
    }
    for (std::size_t i = 0; i < alive.size(); ++i) {
      for (std::size_t s = 0; s < seeds; ++s) {
        const double cost = racers[alive[i]].log_costs[s];
        const double rest = cost - means_[i] - of_seed[s] + mean_;
        own_[i] += rest * rest;
      }
      all_ += own_[i];
    }
    best_ = std::size_t(std::ranges::min_element(means_) - means_.begin());
    const double others = double(alive.size()) - 1;
    pooled_dof_ = others * (seeds_ - 1);
    prior_ = std::min(pooled_dof_ - (seeds_ - 1), kMaxPooledDof);
    dof_ = prior_ + seeds_ - 1;
  }

  // Appends the strategies that are worse than the best at this level.
  void FindWorse(double level, std::vector<std::size_t>& worse) const {
    const double quantile = stat::StudentTwoSidedQuantile(2 * level, dof_);
    for (std::size_t i = 0; i < alive_.size(); ++i) {
      if (i != best_ && Difference(i) > quantile * Error(i)) worse.push_back(alive_[i]);
    }
  }

  // Returns the probability that after `all` seeds the difference between the best and
  // the closest other strategy exceeds `quantile` standard errors.
  double MinPower(std::size_t all, double quantile) const {
    double power = 1;
    for (std::size_t i = 0; i < alive_.size(); ++i) {
      if (i == best_) continue;
      const double final_error = Error(i) * std::sqrt(seeds_ / double(all));
      const double scatter = Error(i) * std::sqrt(1 - seeds_ / double(all));
      const double t = (quantile * final_error - Difference(i)) / scatter;
      const double tail = stat::StudentTwoSided(std::abs(t), dof_) / 2;
      power = std::min(power, t > 0 ? tail : 1 - tail);
    }
    return power;
  }

  // Returns the upper limit of the cost of a strategy over that of the best, minus 1;
  // all limits hold together.
  double MaxExcess() const {
    const double level = kRankLevel / (double(alive_.size()) - 1);
    const double quantile = stat::StudentTwoSidedQuantile(2 * level, dof_);
    double excess = 0;
    for (std::size_t i = 0; i < alive_.size(); ++i) {
      if (i == best_) continue;
      excess = std::max(excess, std::expm1(Difference(i) + quantile * Error(i)));
    }
    return excess;
  }

 private:
  double Difference(std::size_t i) const { return means_[i] - means_[best_]; }
  // Returns the standard error of Difference().
  double Error(std::size_t i) const {
    return std::sqrt((Variance(i) + Variance(best_)) / seeds_);
  }
  double Variance(std::size_t i) const {
    // Residuals of a strategy have lost a share of its variance to the seeds' means.
    const double share = (double(alive_.size()) - 1) / double(alive_.size());
    return (prior_ * all_ / pooled_dof_ + own_[i] / share) / dof_;
  }

  const std::vector<std::size_t>& alive_;
  const double seeds_;
  std::vector<double> means_, own_;  // own: sums of squared residuals
  double mean_ = 0, all_ = 0, pooled_dof_ = 0, prior_ = 0, dof_ = 0;
  std::size_t best_ = 0;
};

// Appends the strategies that are worse than the best by their first costs.
void FindWorseByFirst(const std::vector<Racer>& racers,
                      const std::vector<std::size_t>& alive, double level,
                      std::vector<std::size_t>& worse) {
  const auto cost = [&](std::size_t i) { return racers[i].log_costs[0]; };
  const std::size_t best = *std::ranges::min_element(alive, {}, cost);
  const double quantile = stat::NormalQuantile(1 - level);
  for (const std::size_t i : alive) {
    const double error = std::hypot(racers[i].deviation, racers[best].deviation,
                                    std::sqrt(2.0) * kTimeDeviation);
    if (i != best && cost(i) - cost(best) > quantile * error) worse.push_back(i);
  }
}

bool HaveSeeds(const std::vector<Racer>& racers, const std::vector<std::size_t>& which,
               std::size_t seeds) {
  return std::ranges::all_of(which, [&](std::size_t i) {
    const std::vector<double>& costs = racers[i].log_costs;
    return costs.size() >= seeds &&
           std::all_of(costs.begin(), costs.begin() + long(seeds),
                       [](double c) { return std::isfinite(c); });
  });
}

std::vector<std::size_t> Alive(const RaceResult& result) {
  std::vector<std::size_t> alive;
  for (std::size_t i = 0; i < result.lost.size(); ++i) {
    if (!result.lost[i]) alive.push_back(i);
  }
  return alive;
}

// Ends the race if all seeds would hardly decide it. Fewer than kMinRankedSeeds seeds
// never do, so that such grids render all of them.
bool EndsUndecided(const std::vector<Racer>& racers, std::size_t look, std::size_t seeds,
                   RaceResult& result) {
  if (look < 2 || seeds < kMinRankedSeeds) return false;
  const std::vector<std::size_t> alive = Alive(result);
  const int n = int(racers.size());
  const double level = stat::SidakLevel(kRankLevel, n * (n - 1) / 2);
  const Look now(racers, alive, look);
  if (now.MinPower(seeds, stat::StudentTwoSidedQuantile(level, double(seeds) - 1)) >=
      kMinPower) {
    return false;
  }
  result.within = now.MaxExcess();
  for (std::size_t& stop : result.stops) stop = std::min(stop, look);
  return true;
}

}  // namespace

RaceResult StopsOf(const std::vector<Racer>& racers, std::size_t seeds) {
  const std::size_t n = racers.size();
  RaceResult result = {std::vector<std::size_t>(n, seeds), std::vector<bool>(n), {}};
  if (n < 2) return result;
  const std::size_t enough = std::min<std::size_t>(kMinRankedSeeds, seeds);
  double level = kLevel / (double(n) - 1);
  for (std::size_t look = 1; look < seeds; ++look) {
    const std::vector<std::size_t> alive = Alive(result);
    if (!HaveSeeds(racers, alive, look)) break;
    std::vector<std::size_t> worse;
    if (look == 1) {
      FindWorseByFirst(racers, alive, kFirstLevel / (double(n) - 1), worse);
    } else {
      level /= 2;
      Look(racers, alive, look).FindWorse(level, worse);
    }
    for (const std::size_t i : worse) {
      result.lost[i] = true;
      result.stops[i] = racers[i].stays ? std::max(look, enough) : look;
    }
    if (worse.size() + 1 == alive.size()) {
      const auto winner = std::ranges::find(result.lost, false) - result.lost.begin();
      result.stops[std::size_t(winner)] = std::max(look, enough);
      break;
    }
    if (EndsUndecided(racers, look, seeds, result)) break;
  }
  return result;
}

}  // namespace lanelight
