// A race names the winner of the full grid, for a part of its cells. Known curves: log
// costs of strategies and seeds, with noise that the seeds of all strategies share in
// part.
#include "src/measure/sweep/race.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "tests/base/image/temporary_folder.h"

namespace lanelight {
namespace {

struct Curves {
  int strategies = 16, seeds = 16;
  double spread = 0.5;  // of the strategies' means: standard deviation
  double noise = 0.1;   // of a seed, by itself
  double shared = 0.3;  // of a seed, in all strategies
  bool heavy = false;   // a strategy's noise is log-normal, and wider for some
};

struct Outcome {
  bool same_winner = false, best_lost = false;
  double share = 1;  // of the cells that were rendered
};

std::vector<Racer> Draw(const Curves& c, std::mt19937& random) {
  std::normal_distribution<double> normal;
  std::vector<double> of_seed(std::size_t(c.seeds));
  for (double& s : of_seed) s = c.shared * normal(random);
  std::vector<Racer> racers(std::size_t(c.strategies));
  for (std::size_t i = 0; i < racers.size(); ++i) {
    const double mean = c.spread * normal(random);
    const double noise = c.heavy ? c.noise * double(1 + i % 4) : c.noise;
    for (const double s : of_seed) {
      const double x = normal(random);
      racers[i].log_costs.push_back(mean + s + noise * (c.heavy ? std::exp(x) - 1.6 : x));
    }
  }
  // The first costs scatter by what their deviations say, beside that of the time.
  for (Racer& racer : racers) {
    const bool unknown = c.heavy;
    racer.deviation = unknown ? NAN : std::hypot(c.noise, c.shared);
  }
  racers[0].stays = true;
  return racers;
}

double MeanOf(const Racer& racer) {
  double sum = 0;
  for (const double cost : racer.log_costs) sum += cost;
  return sum / double(racer.log_costs.size());
}

Outcome RaceOf(const std::vector<Racer>& racers) {
  const std::size_t seeds = racers[0].log_costs.size();
  const RaceResult result = StopsOf(racers, seeds);
  std::size_t full = 0, cells = 0, winner = racers.size();
  for (std::size_t i = 0; i < racers.size(); ++i) {
    cells += result.stops[i];
    if (MeanOf(racers[i]) < MeanOf(racers[full])) full = i;
    if (result.lost[i]) continue;
    if (winner == racers.size() || MeanOf(racers[i]) < MeanOf(racers[winner])) winner = i;
  }
  return {winner == full, result.lost[full],
          double(cells) / double(racers.size() * seeds)};
}

// Over 200 races: how often the winner is that of the full grid, and the share of cells.
std::pair<int, double> Races(const Curves& curves) {
  std::mt19937 random(11);
  int same = 0;
  double share = 0;
  for (int i = 0; i < 200; ++i) {
    const Outcome outcome = RaceOf(Draw(curves, random));
    CHECK(outcome.same_winner != outcome.best_lost);
    same += outcome.same_winner;
    share += outcome.share / 200;
  }
  return {same, share};
}

}  // namespace

TEST_CASE("race: the winner is that of the full grid, for a quarter of its cells",
          "[sweep]") {
  const auto [same, share] = Races({});
  CHECK(same >= 190);
  CHECK(share < 0.25);
  const auto [few, few_share] = Races({.strategies = 6, .seeds = 8});
  CHECK(few >= 190);
  CHECK(few_share < 0.5);
  const auto [heavy, heavy_share] = Races({.heavy = true});
  CHECK(heavy >= 190);
  CHECK(heavy_share < 0.75);  // noise of up to 0.9, of a strategy by itself
}

TEST_CASE("race: equal strategies hardly ever stop", "[sweep]") {
  const auto [same, share] = Races({.spread = 0});
  CHECK(same >= 190);
  CHECK(share > 0.97);
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
  std::vector<Racer> racers = Draw({.strategies = 4, .seeds = 6, .spread = 3}, random);
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
  const TemporaryFolder folder;
  folder.Write("a.pbrt", "");
  const Sweep sweep = ParseSweep(folder.File("s.toml"), R"([grid]
scene = "a.pbrt"
strategy = ["default", "points=cmj", "points=halton"]
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
    const double own = Get(cell.values, Axis::kStrategy) == "points=cmj" ? 1.01 : 1;
    const double error = (bad ? 1 : 0.01) * (1 + 0.1 * seed) * std::pow(own, seed);
    race.Enter(cell.index, WithoutBounds(error), 2);
  }
  for (const SweepCell& cell : sweep.cells) {
    const bool bad = Get(cell.values, Axis::kStrategy) == "points=halton" &&
                     Get(cell.values, Axis::kSpp) == "16";
    CHECK(race.IsStopped(cell.index) == (bad && race.Round(cell.index) > 1));
    CHECK(race.Rivals(cell.index).size() == 12);
  }
}

}  // namespace lanelight
