// Records the profile of one thread: times of stage calls, processor counters, a trace.
// All memory is reserved beforehand.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include "src/base/core/clock.h"
#include "src/base/core/hardware_counters.h"
#include "src/render/wave/run_options.h"
#include "src/render/wave/run_result.h"

namespace lanelight {

/// Counts of one stage or part of a task on one thread. Small: every stage call touches
/// them after the stage has pushed them out of the first cache.
struct StageCounters {
  std::uint64_t items = 0, lane_slots = 0;  // lane_slots: vectors
  std::uint64_t ticks = 0;                  // of the current task
  std::uint64_t calls = 0;
};
static_assert(sizeof(StageCounters) == 32);

/// Counts that are updated once per task.
struct StageTotals {
  double seconds = 0;  // processor time, of the tasks that have ended
  // Over the waves in which the processor's counters are read.
  std::uint64_t counted_items = 0;
  CounterValues counted{};
};

/// Times what one thread does, piece by piece: each piece begins where the last one
/// ended, so one reading of the clock serves two pieces.
class StageClock {
 public:
  StageClock(std::size_t stages, const ProfileOptions& options);

  /// Begins a task; the time before it is not counted.
  void StartTask();
  /// Ends the task, shares its processor time among its pieces, and returns it.
  double EndTask();
  /// Begins a wave. One of 32, chosen without a pattern, reads the processor's counters;
  /// they take about 0.5 us per stage call, which no stage is charged with.
  void StartWave();
  /// Begin and end a wave of camera paths, whose cost is split by bounce. Do nothing
  /// without ProfileOptions::bounces.
  void StartBounces(Wave& wave);
  void EndBounces(Wave& wave);
  /// The piece that ends now was `row` (a stage, or stages + TaskPart).
  void Finish(std::size_t row, std::uint64_t items, std::uint64_t vectors) {
    const std::uint64_t now = Ticks();
    StageCounters& c = rows_[row];
    c.ticks += now - last_;
    ++c.calls;
    c.items += items;
    c.lane_slots += vectors;
    if (next_event_ != end_event_) {
      *next_event_++ = {last_, now, std::uint32_t(row), std::uint32_t(items),
                        std::uint32_t(vectors)};
    } else {
      ++without_event_;
    }
    last_ = now;
    if (counting_) Count(row, items);
  }
  void FinishPart(TaskPart part, std::uint64_t items) {
    Finish(stages_ + std::size_t(part), items, 0);
  }

  /// Return rows by stage, then by TaskPart; both have the same size.
  const std::vector<StageCounters>& rows() const { return rows_; }
  const std::vector<StageTotals>& totals() const { return totals_; }
  /// Returns costs with vectors for kBounceSlots. Empty without ProfileOptions::bounces.
  const std::vector<BounceProfile>& bounces() const { return bounces_; }
  /// Processor time of the tasks, and their ticks.
  double cpu_seconds() const { return cpu_seconds_; }
  std::uint64_t ticks() const { return ticks_; }
  /// Hands out the trace, once, after the last task.
  UntouchedVector<TraceEvent> ReleaseEvents();
  /// Events for which there was no room; 0 without a trace.
  std::uint64_t dropped() const { return events_.empty() ? 0 : without_event_; }
  /// errno if the processor's counters are missing; 0 if they are there or not wanted.
  int counter_error() const { return counter_error_; }

 private:
  BounceProfile CostsSoFar(const Wave& wave) const;
  void Count(std::size_t row, std::uint64_t items);
  bool ReadCounters(CounterValues* values);

  std::uint64_t last_ = 0;
  std::vector<StageCounters> rows_;
  TraceEvent *next_event_ = nullptr, *end_event_ = nullptr;  // of events_
  std::uint64_t without_event_ = 0;
  bool counting_ = false;

  std::size_t stages_;
  std::vector<StageTotals> totals_;
  UntouchedVector<TraceEvent> events_;
  std::uint64_t task_start_ = 0, ticks_ = 0;
  double task_cpu_ = 0, cpu_seconds_ = 0;
  // Counters follow the thread; threads may take over each other's workspaces.
  bool use_counters_, first_ = true;
  std::thread::id thread_;
  std::optional<CounterGroup> group_;
  CounterValues at_{};
  int counter_error_ = 0;
  std::uint64_t random_ = 1;

  std::vector<BounceProfile> bounces_;
  std::array<std::uint32_t, kMaxBounces> paths_{};  // of the current wave, by depth
  std::array<double, kMaxBounces> bounce_ticks_{};  // of the current task
  BounceProfile wave_start_{};                      // with ticks
};

}  // namespace lanelight
