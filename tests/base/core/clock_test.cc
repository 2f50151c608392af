#include "src/base/core/clock.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <thread>

namespace lanelight {

TEST_CASE("ticks run forward at a steady rate", "[clock]") {
  const TickScale scale;
  std::uint64_t last = Ticks();
  for (int i = 0; i < 10000; ++i) {
    const std::uint64_t now = Ticks();
    REQUIRE(now >= last);
    last = now;
  }
  const auto start = std::chrono::steady_clock::now();
  const std::uint64_t ticks = Ticks();
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  const std::uint64_t passed = Ticks() - ticks;
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  // The two clocks are not read at the same moment; a busy machine may come between.
  const double measured = double(passed) * scale.SecondsPerTick();
  CHECK(measured <= seconds.count() * 1.01);
  CHECK(measured > 0.019);
}

TEST_CASE("processor time excludes sleep", "[clock]") {
  const double process = ProcessCpuSeconds(), thread = ThreadCpuSeconds();
  CHECK(process > 0);
  std::this_thread::sleep_for(std::chrono::milliseconds(30));
  CHECK(ThreadCpuSeconds() - thread < 0.02);
  volatile double x = 1;
  for (int i = 0; i < 2000000; ++i) x = std::sqrt(x + 1);
  CHECK(ThreadCpuSeconds() - thread > 0.001);
  CHECK(ProcessCpuSeconds() - process > 0.001);
}

}  // namespace lanelight
