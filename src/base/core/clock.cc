#include "src/base/core/clock.h"

#include <ctime>

namespace lanelight {
namespace {

double Seconds(clockid_t clock) {
  timespec t{};
  if (clock_gettime(clock, &t) != 0) return 0;
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

}  // namespace

TickScale::TickScale() : time_(std::chrono::steady_clock::now()), ticks_(Ticks()) {}

double TickScale::SecondsPerTick() const {
  using std::chrono::steady_clock;
  constexpr std::chrono::microseconds kMinTime(100);
  auto now = steady_clock::now();
  while (now - time_ < kMinTime) now = steady_clock::now();
  const std::uint64_t ticks = Ticks();
  const std::chrono::duration<double> seconds = now - time_;
  return seconds.count() / static_cast<double>(ticks - ticks_);
}

double ProcessCpuSeconds() { return Seconds(CLOCK_PROCESS_CPUTIME_ID); }
double ThreadCpuSeconds() { return Seconds(CLOCK_THREAD_CPUTIME_ID); }

}  // namespace lanelight
