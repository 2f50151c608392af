// The decisions of renders without a fixed number of samples, played through with an
// imaginary clock.
#include "src/render/schedule/schedule.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <iterator>

namespace lanelight {

TEST_CASE("error checks are at fixed, few, whole sample counts", "[schedule]") {
  const std::uint64_t expected[] = {16, 20, 24, 28, 32, 40, 48, 56, 64, 80, 96, 112, 128};
  for (std::uint32_t unit : {1u, 2u}) {
    CHECK(FirstCheck(unit) == 16 * unit);
    CHECK(ChecksUpTo(16 * unit - 1, unit) == 0);
    std::uint64_t done = 0;
    for (std::uint64_t look : expected) {
      CHECK(CheckFrom(done + 1, unit) == look * unit);
      done = look * unit;
      CHECK(CheckFrom(done, unit) == done);
    }
    CHECK(ChecksUpTo(done, unit) == std::ssize(expected));
    CHECK(ChecksUpTo(done - 1, unit) == std::ssize(expected) - 1);
    for (int i = 0; i < 130; ++i) {
      const std::uint64_t next = CheckFrom(done + 1, unit);
      REQUIRE(next > done);
      REQUIRE(next <= done + done / 4);
      REQUIRE(next % unit == 0);
      done = next;
    }
    CHECK(done > std::uint64_t{1} << 38);
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
    const Round round = pace.Next(0, now);
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
    pace.AddMeasurement(round.samples(), seconds);
  }
  played.end = now;
  return played;
}

}  // namespace

TEST_CASE("rounds fill a time budget", "[schedule]") {
  for (int threads : {1, 2, 16}) {
    for (double per_sample : {0.001, 0.01, 0.1}) {
      for (std::uint32_t unit : {1u, 2u}) {
        const Pace::Tasks tasks{1000, threads, 32, unit};
        const Played played = Play(10, per_sample, 1e-4, tasks);
        // Only less than one round of the smallest kind is left to a part of the tiles.
        CHECK(played.end >= 10 - 2 * (unit * per_sample / threads + 1e-4));
        CHECK(played.task <= 0.006 * 10);
        // Each takes half of what is left.
        CHECK(played.rounds <= 60);
      }
    }
  }
}

TEST_CASE("a first round that takes too long is the only one", "[schedule]") {
  Pace pace(1, {100, 2, 32, 1});
  CHECK(pace.Next(0, 0).samples() == 1);
  pace.AddMeasurement(1, 5);
  CHECK(pace.RemainingSamples(5) == 0);
  CHECK(pace.Next(0, 5).samples() == 1);  // the caller sees that the time is over
}

}  // namespace lanelight
