// Machines without counters for programs are common (virtual ones); there the mechanism
// is tested with events that the kernel itself counts.
#include "src/base/core/hardware_counters.h"

#include <catch2/catch.hpp>
#include <cerrno>
#include <cmath>

#if defined(__linux__)
#include <linux/perf_event.h>
#endif

namespace lanelight {
namespace {

using Catch::Contains;

void Work() {
  volatile double x = 1;
  for (int i = 0; i < 1000000; ++i) x = std::sqrt(x + 1);
}

}  // namespace

TEST_CASE("hardware counters are available, or the reason is given", "[counters]") {
  const CounterGroup group(HardwareEvents());
  CounterValues before{}, after{};
  if (!group.available()) {
    CHECK(group.error() != 0);
    CHECK_FALSE(group.Read(&before));
    CHECK_THAT(CountersProblem(group.error()), Contains("perf_event_open"));
    return;
  }
  if (!group.Read(&before)) return;  // other programs have taken them
  Work();
  REQUIRE(group.Read(&after));
  const auto grown = [&](Counter c) {
    return after[static_cast<int>(c)] - before[static_cast<int>(c)];
  };
  CHECK(grown(Counter::kCycles) > 1000000);
  if (group.Has(Counter::kInstructions)) CHECK(grown(Counter::kInstructions) > 2000000);
}

#if defined(__linux__)
TEST_CASE("a group of the kernel's own events is read in order", "[counters]") {
  const CounterEvent clock = {PERF_TYPE_SOFTWARE, PERF_COUNT_SW_TASK_CLOCK};
  const CounterEvent faults = {PERF_TYPE_SOFTWARE, PERF_COUNT_SW_PAGE_FAULTS};
  const CounterEvent absent = {PERF_TYPE_SOFTWARE, 0xffffff};
  const CounterGroup group({clock, absent, faults, clock});
  if (!group.available()) {
    WARN("skipped: " << CountersProblem(group.error()));
    return;
  }
  CHECK(group.error() != 0);  // of the absent one
  CHECK(group.Has(Counter::kCycles));
  CHECK_FALSE(group.Has(Counter::kInstructions));
  CounterValues before{}, after{};
  REQUIRE(group.Read(&before));
  Work();
  REQUIRE(group.Read(&after));
  CHECK(after[0] - before[0] > 100000);  // nanoseconds
  CHECK(after[1] == 0);
  CHECK(after[2] - before[2] < 100000);  // faults
  CHECK(after[3] - before[3] > 100000);
}
#endif

TEST_CASE("missing hardware counters are reported with a remedy", "[counters]") {
  CHECK_THAT(CountersProblem(EACCES),
             Contains("perf_event_paranoid") && Contains("EACCES"));
  CHECK_THAT(CountersProblem(ENOENT), Contains("virtual"));
  CHECK_THAT(CountersProblem(EBUSY), Contains("watchdog"));
  CHECK_THAT(CountersProblem(ENOSYS), Contains("CONFIG_PERF_EVENTS"));
  CHECK_THAT(CountersProblem(EINVAL), Contains("EINVAL"));
}

}  // namespace lanelight
