// Who asks for the work of a run, and may have it stopped.
#pragma once

namespace lanelight {

/// Who asks for the work. All may be called from any thread.
class TaskWatcher {
 public:
  virtual ~TaskWatcher() = default;
  /// True: tasks that have not begun are left out.
  virtual bool Stopped() const = 0;
  virtual void TaskDone() = 0;
  /// Stopped by a signal: whatever is in flight must end soon.
  virtual bool Interrupted() const { return false; }
  /// True: tasks in flight are cancelled (src/render/wave/time_limit.h). Asked after each
  /// wave.
  virtual bool Cancelled() const { return false; }
};

}  // namespace lanelight
