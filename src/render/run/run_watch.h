// Watches the tasks of a run: when they have to end, and how far they have come.
#pragma once

#include <atomic>
#include <chrono>
#include <mutex>
#include <optional>

#include "src/render/run/convergence_checks.h"
#include "src/render/run/film_show.h"
#include "src/render/run/run_setting.h"
#include "src/render/wave/task_watcher.h"
#include "src/render/wave/time_limit.h"

namespace lanelight {

class RunWatch : public TaskWatcher {
 public:
  /// Refers to all of these for as long as it lives.
  RunWatch(const RunSetting& setting, const ConvergenceChecks& checks,
           const FilmShow& show)
      : setting_(setting), checks_(checks), show_(show) {}

  /// Tasks begin, after any training. Before it only Interrupted may be asked.
  void Start();
  /// Between rounds: whether the run ends here, before its samples are done.
  bool Ended();
  /// Between rounds: so many seconds of a time budget are needed after the last task.
  void Reserve(double seconds) { reserved_ = seconds; }
  double reserved() const { return reserved_; }
  /// Why the run has ended.
  StopReason Reason() const;

  /// By a signal, to this process or another one.
  bool Interrupted() const override {
    const std::atomic<bool>* const stop = setting_.options.stop;
    return (stop != nullptr && stop->load(std::memory_order_relaxed)) ||
           setting_.work.Stopped();
  }
  bool Stopped() const override;
  bool Cancelled() const override;
  void TaskDone() override;
  /// Reports the progress now.
  void Report();

 private:
  bool OutOfTime() const;
  double Fraction(double seconds, std::uint64_t samples) const;

  const RunSetting& setting_;
  const ConvergenceChecks& checks_;
  const FilmShow& show_;
  mutable std::optional<TimeLimit> limit_;
  mutable std::atomic<bool> cancelled_{false};  // tasks were; that ends the run
  bool every_pixel_ = false;                    // has a sample
  double reserved_ = 0;
  std::chrono::steady_clock::time_point last_report_;
  std::mutex progress_mutex_;
};

}  // namespace lanelight
