// A race names the winner of the full grid, for a part of its cells. Known curves: log
// costs of strategies and seeds, with noise that the seeds of all strategies share in
// part.
#include "src/measure/sweep/race.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>
#include <random>

#include "src/base/stat/distributions.h"
#include "src/base/stat/hypothesis.h"
#include "tests/base/image/temporary_folder.h"

namespace lanelight {
namespace {

struct Curves {
  int strategies = 16, seeds = 16;
  double spread = 0.5;  // of the strategies' means: standard deviation
  double lead = 0;      // of the first strategy over the mean of all
  double noise = 0.1;   // of a seed, by itself
  double shared = 0.3;  // of a seed, in all strategies
  bool heavy = false;   // a strategy's noise is log-normal, and wider for some
};

// Strategies with their true means.
struct Drawn {
  std::vector<Racer> racers;
  std::vector<double> means;
};

Drawn Draw(const Curves& c, std::mt19937& random) {
  std::normal_distribution<double> normal;
  std::vector<double> of_seed(std::size_t(c.seeds));
  for (double& s : of_seed) s = c.shared * normal(random);
  Drawn drawn;
  for (std::size_t i = 0; i < std::size_t(c.strategies); ++i) {
    Racer racer;
    drawn.means.push_back(c.spread * normal(random) - (i == 0 ? c.lead : 0));
    const double noise = c.heavy ? c.noise * double(1 + i % 4) : c.noise;
    for (const double s : of_seed) {
      const double x = normal(random);
      racer.log_costs.push_back(drawn.means[i] + s +
                                noise * (c.heavy ? std::exp(x) - std::exp(0.5) : x));
    }
    // The first costs scatter by what their deviations say, beside that of the time.
    racer.deviation = c.heavy ? NAN : std::hypot(c.noise, c.shared);
    racer.stays = i == 0;
    drawn.racers.push_back(racer);
  }
  return drawn;
}

double MeanOf(const Racer& racer, std::size_t seeds) {
  return std::accumulate(racer.log_costs.begin(), racer.log_costs.begin() + long(seeds),
                         0.0) /
         double(seeds);
}

// Returns the strategy with the least mean of so many seeds.
std::size_t BestOf(const std::vector<Racer>& racers, const std::vector<bool>& lost,
                   std::size_t seeds) {
  std::size_t best = racers.size();
  for (std::size_t i = 0; i < racers.size(); ++i) {
    if (lost[i]) continue;
    if (best == racers.size() || MeanOf(racers[i], seeds) < MeanOf(racers[best], seeds)) {
      best = i;
    }
  }
  return best;
}

// Returns whether all seeds separate this strategy from every other, by paired t-tests
// that hold for all pairs together: what the full grid ranks by, without its bootstrap.
bool IsDecided(const std::vector<Racer>& racers, std::size_t best) {
  const std::size_t seeds = racers[0].log_costs.size(), n = racers.size();
  const double level = stat::SidakLevel(0.05, int(n * (n - 1) / 2));
  const double quantile = stat::StudentTwoSidedQuantile(level, double(seeds) - 1);
  for (std::size_t i = 0; i < n; ++i) {
    if (i == best) continue;
    double squares = 0;
    const double mean = MeanOf(racers[i], seeds) - MeanOf(racers[best], seeds);
    for (std::size_t s = 0; s < seeds; ++s) {
      const double d = racers[i].log_costs[s] - racers[best].log_costs[s] - mean;
      squares += d * d;
    }
    const double n_seeds = double(seeds);
    if (mean <= quantile * std::sqrt(squares / (n_seeds - 1) / n_seeds)) return false;
  }
  return true;
}

struct Outcomes {
  int same_winner = 0;  // the full grid's best has not lost
  int decided = 0;      // by the full grid
  int missed = 0;       // of these, the race ends undecided, or names another
  int undecided = 0;    // the race ends so
  int beyond = 0;       // of these, a strategy costs more than the race says
  double share = 0;     // of the cells that were rendered
};

// Counts over 200 races.
Outcomes Races(const Curves& curves) {
  std::mt19937 random(11);
  Outcomes out;
  for (int i = 0; i < 200; ++i) {
    const Drawn drawn = Draw(curves, random);
    const std::vector<Racer>& racers = drawn.racers;
    const std::size_t n = racers.size(), seeds = racers[0].log_costs.size();
    const RaceResult result = StopsOf(racers, seeds);
    const std::size_t full = BestOf(racers, std::vector<bool>(n), seeds);
    out.same_winner += !result.lost[full];
    const bool decided = IsDecided(racers, full);
    out.decided += decided;
    out.missed += decided && (result.lost[full] || result.within);
    const auto cells =
        std::accumulate(result.stops.begin(), result.stops.end(), std::size_t{0});
    out.share += double(cells) / double(n * seeds) / 200;
    if (!result.within) continue;
    ++out.undecided;
    const std::size_t looked = *std::ranges::max_element(result.stops);
    const std::size_t best = BestOf(racers, result.lost, looked);
    double excess = 0;
    for (std::size_t k = 0; k < n; ++k) {
      if (!result.lost[k]) excess = std::max(excess, drawn.means[k] - drawn.means[best]);
    }
    out.beyond += excess > std::log1p(*result.within);
  }
  return out;
}

}  // namespace

TEST_CASE("race: the winner is that of the full grid, for a quarter of its cells",
          "[sweep]") {
  const Outcomes many = Races({});
  CHECK(many.same_winner >= 190);
  CHECK(many.missed <= 10);
  CHECK(many.share < 0.2);
  const Outcomes few = Races({.strategies = 6, .seeds = 8});
  CHECK(few.same_winner >= 190);
  CHECK(few.missed <= 10);
  CHECK(few.share < 0.45);
  const Outcomes heavy = Races({.heavy = true});
  CHECK(heavy.same_winner >= 190);
  CHECK(heavy.missed <= 10);
  CHECK(heavy.share < 0.34);  // noise of up to 0.9, of a strategy by itself
}

TEST_CASE("race: a winner that the full grid decides is named in 95 of 100 races",
          "[sweep]") {
  for (const double lead : {0.0, 0.02, 0.05, 0.1, 0.15, 0.2, 0.3, 0.5, 1.0}) {
    for (const auto& [strategies, seeds] :
         {std::pair{2, 8}, {3, 8}, {6, 6}, {9, 8}, {9, 16}, {16, 16}}) {
      for (const bool heavy : {false, true}) {
        CAPTURE(lead, strategies, seeds, heavy);
        const Outcomes out = Races({.strategies = strategies,
                                    .seeds = seeds,
                                    .spread = 0,
                                    .lead = lead,
                                    .heavy = heavy});
        CHECK(out.missed <= 10);
        CHECK(out.same_winner >= 190);
        CHECK(out.beyond <= 10);
      }
    }
  }
}

TEST_CASE("race: strategies within 5 % end undecided after a third of the cells",
          "[sweep]") {
  for (const double lead : {0.0, 0.02, 0.05}) {
    for (const bool heavy : {false, true}) {
      CAPTURE(lead, heavy);
      for (const int seeds : {8, 16}) {
        const Outcomes out = Races(
            {.strategies = 9, .seeds = seeds, .spread = 0, .lead = lead, .heavy = heavy});
        CHECK(out.decided <= 2);
        CHECK(out.undecided >= 190);
        CHECK(out.share < 0.34);
      }
    }
  }
}

TEST_CASE("race: a small difference is found if the noise is smaller", "[sweep]") {
  const Outcomes out =
      Races({.strategies = 9, .seeds = 8, .spread = 0, .lead = 0.05, .noise = 0.01});
  CHECK(out.decided >= 190);
  CHECK(out.missed <= 10);
}

TEST_CASE("race: one seed suffices for a large difference, four end the race",
          "[sweep]") {
  std::vector<Racer> racers = {{{0.5, 0.5, 0.5, 0.5, 0.5, 0.5}, 0.1, true},
                               {{0, 0.01, 0, 0.01, 0, 0.01}, 0.1, false},
                               {{2, 2, 2, 2, 2, 2}, 0.1, false}};
  RaceResult result = StopsOf(racers, 6);
  CHECK(result.lost == std::vector<bool>{true, false, true});
  CHECK(result.stops == std::vector<std::size_t>{4, 4, 1});
  racers[2].deviation = NAN;  // no interval
  CHECK(StopsOf(racers, 6).stops[2] > 1);
}

TEST_CASE("race: nothing stops without a full look, or by costs that are no numbers",
          "[sweep]") {
  std::mt19937 random(3);
  std::vector<Racer> racers =
      Draw({.strategies = 4, .seeds = 6, .spread = 3}, random).racers;
  const auto never = [](const RaceResult& result) {
    return result.stops == std::vector<std::size_t>(result.stops.size(), 6);
  };
  REQUIRE_FALSE(never(StopsOf(racers, 6)));
  CHECK(StopsOf(racers, 6).stops[0] >= 4);  // it stays
  std::vector<Racer> late = racers, unknown = racers;
  late[2].log_costs.clear();
  CHECK(never(StopsOf(late, 6)));
  unknown[1].log_costs[0] = NAN;
  CHECK(never(StopsOf(unknown, 6)));
}

TEST_CASE("race: cells are stopped by strategy, seed and the other axes", "[sweep]") {
  // Nothing separates the strategies with 4 samples, so that all of them stop.
  const TemporaryFolder folder;
  folder.Write("a.pbrt", "");
  const Sweep sweep = ParseSweep(folder.File("s.toml"), R"([grid]
scene = "a.pbrt"
strategy = ["default", "points=stratified", "points=halton"]
spp = [4, 16]
seed = [5, 6, 7, 8]
)");
  Race race(sweep);
  // 100 times the cost of the others with 16 samples.
  for (const SweepCell& cell : sweep.cells) {
    if (race.Round(cell.index) > 1) continue;
    const bool bad = Get(cell.values, Axis::kStrategy) == "points=halton" &&
                     Get(cell.values, Axis::kSpp) == "16";
    const double seed = double(race.Round(cell.index));
    const double own =
        Get(cell.values, Axis::kStrategy) == "points=stratified" ? 1.01 : 1;
    const double error = (bad ? 1 : 0.01) * (1 + 0.1 * seed) * std::pow(own, seed);
    race.Enter(cell.index, WithoutBounds(error), 2);
  }
  for (const SweepCell& cell : sweep.cells) {
    const bool bad = Get(cell.values, Axis::kStrategy) == "points=halton" &&
                     Get(cell.values, Axis::kSpp) == "16";
    const bool open = Get(cell.values, Axis::kSpp) == "4";
    CHECK(race.IsStopped(cell.index) == ((bad || open) && race.Round(cell.index) > 1));
    CHECK(race.HasLost(cell.index) == bad);
    CHECK(race.Within(cell.index).has_value() == open);
    CHECK(race.Rivals(cell.index).size() == 12);
  }
}

}  // namespace lanelight
