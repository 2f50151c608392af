// The decisions of renders without a fixed number of samples, played through with an
// imaginary clock.
#include "src/wavefront/schedule.h"

#include <catch2/catch.hpp>
#include <cmath>

namespace lanelight {

TEST_CASE("groups fit at least four times into what is predicted", "[schedule]") {
  for (Points points : {Points::kStratified, Points::kCmj, Points::kPmj02, Points::kSobol,
                        Points::kHalton, Points::kLattice}) {
    for (Pairs pairs : {Pairs::kNone, Pairs::kAntithetic}) {
      Strategy strategy;
      strategy.points = points;
      strategy.pairs = pairs;
      const std::uint32_t first = FirstGroupSize(strategy);
      CHECK(first == (pairs == Pairs::kNone ? 1u : 2u));
      for (double spp : {1.0, 10.0, 100.0, 1000.0, 1e6, double(INFINITY)}) {
        const std::uint32_t size = ChooseGroupSize(strategy, spp, 2 * first);
        CHECK(size > 2 * first);
        if (spp >= 100) CHECK(4.0 * size <= spp);
        if (spp >= 100 && spp <= 1e4) CHECK(16.0 * size >= spp);
      }
    }
  }
  Strategy independent;
  independent.points = Points::kIndependent;
  CHECK(ChooseGroupSize(independent, 1e6, 2) == 1);
}

TEST_CASE("looks are whole groups, few, and not before four groups", "[schedule]") {
  for (std::uint32_t group : {1u, 4u, 10u, 64u}) {
    std::uint64_t look = FirstLook(group);
    CHECK(look >= 16);
    CHECK(look >= 4 * group);
    CHECK(look % group == 0);
    const double needed = 5000;
    int looks = 1;
    while (double(look) < needed) {
      const std::uint64_t next = NextLook(look, needed, group);
      CHECK(next > look);
      CHECK(next <= 2 * look + group);
      CHECK(next % group == 0);
      look = next;
      ++looks;
    }
    CHECK(looks <= 10);
    // What is needed is overshot by the margin and a group.
    CHECK(double(look) <= 1.02 * needed + group);
    // An estimate that says "just a little more" gets at least a group.
    CHECK(NextLook(look, double(look) + 1, group) >= look + group);
    CHECK(NextLook(look, INFINITY, group) <= 2 * look + group);
  }
}

namespace {

struct Played {
  double end = 0;  // when the last round ended that fitted into the budget
  int rounds = 0;
  double task = 0;  // seconds of the longest task, but for the first round's
};

// A machine of `threads` threads that takes `per_sample` thread seconds for one sample of
// all pixels, and starts every round with `overhead` seconds.
Played Play(double budget, double per_sample, double overhead, const Pace::Tasks& tasks) {
  Pace pace(budget, tasks);
  Played played;
  double now = 0;
  while (true) {
    const Round round = pace.Next(now);
    const double seconds =
        overhead + per_sample * double(round.samples()) / tasks.threads;
    if (now + seconds > budget) break;
    if (played.rounds > 0) {
      played.task =
          std::max(played.task, per_sample * round.per_task / double(tasks.tiles));
    }
    CHECK(round.per_task % tasks.unit == 0);
    now += seconds;
    ++played.rounds;
    pace.Took(round.samples(), seconds);
  }
  played.end = now;
  return played;
}

}  // namespace

TEST_CASE("rounds fill a time budget", "[schedule]") {
  for (int threads : {1, 2, 16}) {
    for (double per_sample : {0.001, 0.01, 0.1}) {
      for (std::uint32_t unit : {1u, 2u}) {
        const Pace::Tasks tasks{1000, threads, {32, 1}, unit};
        const Played played = Play(10, per_sample, 1e-4, tasks);
        // Only less than one round of the smallest kind is left to a part of the tiles.
        CHECK(played.end >= 10 - 2 * (unit * per_sample / threads + 1e-4));
        CHECK(played.task <= 0.006 * 10);
        // The number of rounds is that of full ones and a few.
        CHECK(played.rounds <= 10 * threads / (32 * per_sample) + 60);
      }
    }
  }
}

TEST_CASE("a first round that takes too long is the only one", "[schedule]") {
  Pace pace(1, {100, 2, {32, 1}, 1});
  CHECK(pace.Next(0).samples() == 1);
  pace.Took(1, 5);
  CHECK(pace.Reach(5) == 0);
  CHECK(pace.Next(5).samples() == 1);  // the caller sees that the time is over
}

TEST_CASE("few tiles are shared out among threads by sample ranges", "[schedule]") {
  Pace pace(10, {1, 2, {32, 16}, 1});
  pace.Took(1, 1e-4);
  const Round round = pace.Next(0.1);
  CHECK(round.chunks == 16);
  CHECK(round.per_task > 1);
}

}  // namespace lanelight
