// What a run renders next: parts after which it may look at its error, keep its state, or
// end.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

#include "src/render/run/convergence_checks.h"
#include "src/render/run/run_setting.h"
#include "src/render/run/run_watch.h"
#include "src/render/run/schedule.h"

namespace lanelight {

/// Samples of every pixel from `begin` up to `end`, in tasks of `per_task`; indices in
/// kernels begin with `first`.
struct RunPart {
  std::uint64_t first = 0, begin = 0, end = 0;
  std::uint32_t per_task = 1;
  std::chrono::steady_clock::time_point start;
};

class RunParts {
 public:
  /// Refers to all of these for as long as it lives.
  RunParts(const RunSetting& setting, ConvergenceChecks& checks, RunWatch& watch)
      : setting_(setting), checks_(checks), watch_(watch) {}

  /// Before the first part, after any training.
  void Start();
  /// What to render next; nothing once the render is done.
  std::optional<RunPart> Next();
  /// A part has been rendered to its end.
  void Finish(const RunPart& part);

 private:
  void TimeFit();

  const RunSetting& setting_;
  ConvergenceChecks& checks_;
  RunWatch& watch_;
  std::optional<Pace> pace_;  // with a time budget
};

}  // namespace lanelight
