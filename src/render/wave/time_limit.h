// When tasks in flight are cancelled: a path may take minutes, or never end (a closed
// room that absorbs nothing, without roulette). Their samples are not taken, as if they
// had not begun. Decisions only: no clock and no image, so that tests can play through
// them.
#pragma once

#include <atomic>

namespace lanelight {

class TimeLimit {
 public:
  /// Seconds that tasks in flight have after a stop; less than what mpirun leaves between
  /// SIGTERM and SIGKILL.
  static constexpr double kAfterStop = 0.5;

  /// `budget`: seconds of the run; 0: none. It begins, or goes on, at `now`.
  explicit TimeLimit(double budget = 0, double now = 0) : budget_(budget), last_(now) {}

  /// A task has ended, `now` seconds into the run. Safe from any thread, as is the next.
  void Ended(double now) { last_ = now; }
  /// Returns whether what is in flight is to be cancelled. After a stop (`stopped`) or
  /// the budget it has kAfterStop. While pixels have no sample yet (not `every_pixel`),
  /// time may be over without a stop; then tasks go on as long as one ends within Wait().
  bool IsOver(bool stopped, bool every_pixel, double now);

  /// Seconds: the budget, but at least 1 and at most 10.
  double Wait() const;

 private:
  double budget_;
  std::atomic<double> last_;      // when a task has ended
  std::atomic<double> stop_{-1};  // first seen; before that -1
};

}  // namespace lanelight
