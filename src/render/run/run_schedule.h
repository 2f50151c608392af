// Decides what a run renders next, and when a run with a target checks its error: at
// certain numbers of samples per pixel (src/render/schedule/schedule.h).
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>

#include "src/base/core/stopwatch.h"
#include "src/render/run/run.h"
#include "src/render/schedule/schedule.h"
#include "src/render/schedule/thread_work.h"
#include "src/render/wave/films.h"
#include "src/render/wave/run_options.h"

namespace lanelight {

struct RunContext {
  const RunOptions& options;
  const RunClock& clock;
  Films& films;
  ThreadWork& threads;  // of this process
  RoundRunner& work;    // `threads`, or all ranks

  /// Samples per pixel at most.
  std::uint64_t limit() const {
    return options.spp > 0 ? options.spp : kMaxSamplesPerPixel;
  }
  /// Samples that belong together.
  std::uint32_t unit() const { return films.film().groups().unit; }
  /// Pixels of all tiles of all ranks.
  std::uint64_t pixels() const { return PixelsOf(threads.scheduler().tiles()); }
};

class RunSchedule {
 public:
  /// Keeps a reference to the context.
  explicit RunSchedule(const RunContext& context) : context_(context) {}

  /// Called before the first round, after any training. `resumed`: the films have
  /// samples, whose error is checked again.
  void Start(bool resumed);
  /// Returns the next round; nothing once the samples or the target are reached.
  std::optional<Round> Next();
  /// Notes that a round has been rendered to its end.
  void Finish(const Round& round);

  /// Returns the seconds of a time budget that are reserved for the work after the last
  /// task.
  double reserved() const { return reserved_; }
  /// Returns the samples per pixel that the image needs, by the last check; infinite
  /// before.
  double needed() const { return needed_; }
  bool reached() const { return reached_; }
  /// Returns whether no number of samples is expected to reach the target.
  bool hopeless() const { return hopeless_; }
  /// Returns the number of checks up to the samples that are done.
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
