// Stops the tasks of a run, and decides when tasks in flight are cancelled.
#pragma once

#include <algorithm>
#include <atomic>

#include "src/base/core/stopwatch.h"

namespace lanelight {

/// Tells tasks when to stop. All functions may be called from any thread.
class TaskWatcher {
 public:
  virtual ~TaskWatcher() = default;
  /// Returns whether tasks that have not begun are omitted.
  virtual bool IsStopped() const = 0;
  virtual void TaskDone() = 0;
  /// Returns whether a signal has stopped the work: tasks in flight must end soon.
  virtual bool IsInterrupted() const { return false; }
  /// Returns whether tasks in flight are cancelled (TimeLimit); called after each wave.
  virtual bool IsCancelled() const { return false; }
};

/// Decides when tasks in flight are cancelled: a path may take minutes, or never end (a
/// closed room that absorbs nothing, without roulette). Cancelled samples are discarded.
/// Uses no clock and no image, so that tests can play through its decisions.
class TimeLimit {
 public:
  /// Seconds that tasks in flight have after a stop; less than what mpirun leaves between
  /// SIGTERM and SIGKILL.
  static constexpr double kAfterStop = 0.5;

  /// `budget`: seconds of the run; 0: none. It begins, or goes on, at `now`.
  explicit TimeLimit(double budget = 0, double now = 0) : budget_(budget), last_(now) {}

  /// Notes that a task has ended, `now` seconds into the run. Safe from any thread, as is
  /// IsOver.
  void NoteTaskEnd(double now) { last_ = now; }
  /// Returns whether tasks in flight are to be cancelled: kAfterStop seconds after a stop
  /// (`stopped`) or the budget. While pixels have no sample yet (not `every_pixel`), time
  /// may be over without a stop; tasks then go on as long as one ends within Wait().
  bool IsOver(bool stopped, bool every_pixel, double now) {
    if (stopped) {
      double first = -1;
      // Whoever sees it first sets it; the others get that.
      if (stop_.compare_exchange_strong(first, now)) first = now;
      return now > first + kAfterStop;
    }
    if (budget_ <= 0 || now < budget_) return false;
    if (every_pixel) return now > budget_ + kAfterStop;
    return now > std::max(budget_, last_.load()) + Wait();
  }

  /// Returns the budget in seconds, clamped to 1 ... 10.
  double Wait() const { return std::clamp(budget_, 1.0, 10.0); }

 private:
  double budget_;
  std::atomic<double> last_;      // when a task has ended
  std::atomic<double> stop_{-1};  // first seen; before that -1
};

/// Watches work that only a signal ends early.
class StopWatcher : public TaskWatcher {
 public:
  /// `stop` is set by a signal; null: never.
  explicit StopWatcher(const std::atomic<bool>* stop) : stop_(stop) {}

  bool IsStopped() const override { return stop_ != nullptr && *stop_; }
  void TaskDone() override {}
  bool IsInterrupted() const override { return IsStopped(); }
  bool IsCancelled() const override {
    if (!IsStopped()) return false;
    return limit_.IsOver(true, false, watch_.Seconds());
  }

 private:
  const std::atomic<bool>* stop_;
  const Stopwatch watch_;
  mutable TimeLimit limit_;
};

}  // namespace lanelight
