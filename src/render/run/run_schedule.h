// What a run renders next, and when a run with a target checks its own error: at certain
// numbers of samples per pixel (src/render/schedule/schedule.h).
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>

#include "src/base/core/stopwatch.h"
#include "src/render/run/run_context.h"
#include "src/render/schedule/schedule.h"

namespace lanelight {

class RunSchedule {
 public:
  /// Refers to the context for as long as it lives.
  explicit RunSchedule(const RunContext& context) : context_(context) {}

  /// Before the first round, after any training. `resumed`: the films have samples, whose
  /// error is checked again.
  void Start(bool resumed);
  /// Returns the next round; nothing once the samples or the target are reached.
  std::optional<Round> Next();
  /// A round has been rendered to its end.
  void Finish(const Round& round);

  /// Seconds of a time budget that the work after the last task takes.
  double reserved() const { return reserved_; }
  /// Samples per pixel that the image needs, by the last check; infinite before.
  double needed() const { return needed_; }
  /// The target is reached.
  bool reached() const { return reached_; }
  /// No number of samples reaches the target.
  bool hopeless() const { return hopeless_; }
  /// Number of checks up to the samples that are done.
  int Checks() const;

 private:
  std::uint64_t NextCheck(std::uint64_t done) const;
  std::uint64_t LastLevel() const;
  void CheckIfDue(std::uint64_t done);
  void TimeFit();

  const RunContext& context_;
  std::optional<Pace> pace_;  // with a time budget
  Stopwatch round_watch_;
  double reserved_ = 0;
  double needed_ = INFINITY;
  bool reached_ = false, hopeless_ = false;
};

}  // namespace lanelight
