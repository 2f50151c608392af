// The stopwatch counts what it says: the wall clock, and the processor's time apart.
#include "src/base/core/stopwatch.h"

#include <catch2/catch.hpp>
#include <thread>

namespace lanelight {

TEST_CASE("a stopwatch measures wall-clock and processor time separately", "[core]") {
  Stopwatch watch;
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  CHECK(watch.Seconds() >= 0.05);
  // Asleep, the processor does nothing; other threads of the tests may.
  CHECK(watch.CpuSeconds() < watch.Seconds() * 64);
  const double cpu = watch.CpuSeconds();
  volatile double sum = 0;
  while (watch.CpuSeconds() < cpu + 0.01) sum = sum + 1;
  // A lap ends the one before.
  CHECK(watch.Lap() >= 0.05);
  CHECK(watch.Seconds() < 0.05);
  CHECK(watch.CpuSeconds() < 0.01);
}

}  // namespace lanelight
