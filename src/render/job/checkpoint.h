// Stores a running render on disk: state files (src/base/state,
// docs/state.md), and the image so far.
#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <future>
#include <memory>
#include <nlohmann/json.hpp>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "src/base/core/file_lock.h"
#include "src/base/state/state_file.h"
#include "src/render/job/job.h"
#include "src/render/job/parts.h"
#include "src/render/wave/run_state.h"

namespace lanelight {

/// Locks a state: no other process keeps `path` meanwhile. The lock is a file PATH.lock,
/// which is removed at the end. After a SIGKILL it stays, without effect.
class StateLock {
 public:
  /// Throws InputError, naming the owner, if another process keeps the state. Removes
  /// temporary files that killed writers have left (PATH.*.*.tmp). Calls `on_problem` if
  /// the file system has no locks.
  StateLock(const std::string& path,
            const std::function<void(const std::string&)>& on_problem);
  ~StateLock();
  StateLock(const StateLock&) = delete;
  StateLock& operator=(const StateLock&) = delete;

 private:
  std::optional<LockFile> file_;  // none: no locks here
  std::optional<ScopedLock> lock_;
};

/// Makes the content of a state, without tiles and window. `about`: further members of
/// its report. Keeps references to the films and to the tables of `run`.
StateContent ContentOf(const nlohmann::json& identity, nlohmann::json about, Films& films,
                       const RunRecord& run);

/// Reads the record of a run; `report` is the file's. Throws nlohmann::json::exception
/// where it differs from what ContentOf writes.
RunRecord ReadRecord(const StateFile& file, const nlohmann::json& report);

/// The ways to resume from a state.
enum class Resume {
  kNever,  // a state that is there already is an error: it would be lost
  kIfAny,  // from the state if there is one
  kMust,   // a state must be there
};

struct CheckpointSettings {
  std::string from;     // state to go on from
  std::string path;     // state to keep; empty: none
  double seconds = 60;  // between two of them
  Resume resume = Resume::kNever;
  /// The image so far, EXR or PNG by the end of the name, written with each state.
  std::vector<std::string> watch;
  double exposure = 0;   // of the PNG, stops
  Part part;             // of the render
  bool finished = true;  // the state of a render that is finished is kept too

  bool Any() const { return !path.empty() || !watch.empty(); }
};

/// Returns the decide= of the state that a render is to resume from; nothing without such
/// a state. Throws InputError for a damaged one.
std::optional<Decide> DecisionOfState(const CheckpointSettings& settings);

class Checkpoint : public Checkpointer {
 public:
  /// Opens the state. `head` is the head of the report (HeadJson). `on_problem` is called
  /// at once, from any thread, for states that cannot be written. Throws InputError if
  /// the state to resume from is missing, damaged, or of another render (naming each
  /// difference). Also throws if a state would be lost, or if another process writes it.
  Checkpoint(const Job& job, const CheckpointSettings& settings,
             const nlohmann::json& head,
             std::function<void(const std::string&)> on_problem);
  ~Checkpoint() override;

  /// Returns the tiles of this render, in the order of the state.
  const std::vector<PixelRect>& tiles() const { return tiles_; }
  bool resumed() const { return from_ != nullptr; }

  bool Restore(RunState& state) override;
  bool IsDue() const override;
  void Save(RunState& state) override;
  /// Waits for the last state to be written. If that fails, writes it to the temporary
  /// directory. Returns messages about that.
  std::vector<std::string> Finish();
  /// Returns whether the last state is on the disk.
  bool kept() const { return kept_; }
  /// Number of calls of Keep, and the seconds for which they stopped the render.
  int count() const { return count_; }
  double pause_seconds() const { return pause_seconds_; }

 private:
  void Open();
  void CheckSame(const StateFile& file);
  void CheckNotTooMany(const Films& films) const;
  std::unique_ptr<StateCopy> Copy(RunState& state) const;
  /// Returns the function that writes the image so far; empty if none is asked for.
  std::function<void()> WatchWriter(RunState& state) const;
  /// Calls write(). Reports an exception to on_problem, each message once until a write
  /// succeeds. Returns whether it succeeded.
  bool WriteOrReport(const std::function<void()>& write);

  const Job& job_;
  CheckpointSettings settings_;
  const nlohmann::json identity_, head_;
  std::function<void(const std::string&)> on_problem_;
  std::set<std::string> reported_;  // problems
  std::vector<PixelRect> tiles_;
  std::optional<StateLock> lock_;
  std::unique_ptr<StateFile> from_;
  std::atomic<std::int64_t> next_{0};  // milliseconds of the steady clock
  std::unique_ptr<StateCopy> last_;    // of the last Keep, until it is on the disk
  std::future<bool> writing_;          // of last_; whether it is on the disk
  bool kept_ = false;
  int count_ = 0;
  double pause_seconds_ = 0;
};

}  // namespace lanelight
