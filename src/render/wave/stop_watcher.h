// The watcher of work that nothing but a signal ends early.
#pragma once

#include <atomic>

#include "src/base/core/stopwatch.h"
#include "src/render/wave/task_watcher.h"
#include "src/render/wave/time_limit.h"

namespace lanelight {

class StopWatcher : public TaskWatcher {
 public:
  /// `stop` is set by a signal; null: never.
  explicit StopWatcher(const std::atomic<bool>* stop) : stop_(stop) {}

  bool Stopped() const override { return stop_ != nullptr && *stop_; }
  void TaskDone() override {}
  bool Interrupted() const override { return Stopped(); }
  bool Cancelled() const override {
    if (!Stopped()) return false;
    return limit_.IsOver(true, false, watch_.Seconds());
  }

 private:
  const std::atomic<bool>* stop_;
  const Stopwatch watch_;
  mutable TimeLimit limit_;
};

}  // namespace lanelight
