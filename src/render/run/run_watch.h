// Watches the tasks of a run: stops them in time, reports progress, and shows the film.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <mutex>
#include <optional>

#include "src/render/run/run_schedule.h"
#include "src/render/wave/task_watcher.h"

namespace lanelight {

/// Tasks wait while the film is shown, which takes at most kMaxDisplayFraction of the
/// run's time if it takes as long as the last time; the first time is estimated by
/// kDisplaySecondsPerPixel per pixel.
inline constexpr double kMaxDisplayFraction = 0.005, kDisplaySecondsPerPixel = 2e-7;

class RunWatch : public TaskWatcher {
 public:
  /// Keeps references to both.
  RunWatch(const RunContext& context, const RunSchedule& schedule)
      : context_(context), schedule_(schedule) {}

  /// Called before the first round, after any training; until then only Interrupted may
  /// be called.
  void Start();
  /// Returns, between rounds, whether the run ends before all samples are done.
  bool HasEnded();
  /// Calls RunOptions::on_film between rounds, if it is due; in one process only.
  void ShowIfDue();
  /// Returns why the run has ended.
  StopReason Reason() const;

  /// Returns whether a signal came, to this process or another rank.
  bool IsInterrupted() const override {
    const std::atomic<bool>* const stop = context_.options.stop;
    return (stop != nullptr && stop->load(std::memory_order_relaxed)) ||
           context_.work.IsStopped();
  }
  bool IsStopped() const override;
  bool IsCancelled() const override;
  void TaskDone() override;
  /// Reports the progress now.
  void Report();

 private:
  bool OutOfTime() const;
  bool ShowDue() const { return context_.clock.Elapsed() >= show_at_; }
  double Fraction(double seconds, std::uint64_t samples) const;

  const RunContext& context_;
  const RunSchedule& schedule_;
  std::uint64_t pixels_ = 0;
  mutable std::optional<TimeLimit> limit_;
  mutable std::atomic<bool> cancelled_{false};  // tasks were; that ends the run
  bool every_pixel_ = false;                    // has a sample
  std::atomic<double> show_at_{0};              // seconds of the run's clock
  std::chrono::steady_clock::time_point last_report_;
  std::mutex progress_mutex_;
};

}  // namespace lanelight
