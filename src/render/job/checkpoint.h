// Keeps a render on the disk while it goes on: state files (src/base/state,
// docs/state.md), and the image so far.
#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <future>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "src/base/state/state_file.h"
#include "src/render/job/job.h"
#include "src/render/job/parts.h"
#include "src/render/job/state_lock.h"

namespace lanelight {

/// True if a render goes on from a state.
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

/// What the state that a render is to go on from says of decide=; nothing if there is no
/// state to go on from. Throws InputError for one that is damaged.
std::optional<Decide> DecisionOfState(const CheckpointSettings& settings);

class Checkpoint : public RunKeeper {
 public:
  /// `head`: what a report says of this render whatever it comes to. `on_problem` is told
  /// at once, from any thread, of states that cannot be written. Throws InputError if the
  /// state to go on from is missing, damaged, or of another render (naming each
  /// difference), if one is there that must not be, or if another process keeps it.
  Checkpoint(const Job& job, const CheckpointSettings& settings,
             const nlohmann::json& head,
             std::function<void(const std::string&)> on_problem);
  ~Checkpoint() override;

  /// What this render is to render: its part, in the order of the state.
  const std::vector<PixelRect>& tiles() const { return tiles_; }
  bool resumed() const { return from_ != nullptr; }

  bool Restore(RunState& state) override;
  bool Due() const override;
  void Keep(RunState& state) override;
  /// After the last Keep: waits for what is being written. If the state cannot be written
  /// where it should be, it goes to the temporary directory. Messages about that.
  std::vector<std::string> Finish();
  /// Returns whether the last state that was to be kept is on the disk.
  bool kept() const { return kept_; }
  /// Of all calls of Keep: how often, and how long the render stood still for them.
  int count() const { return count_; }
  double pause_seconds() const { return pause_seconds_; }

 private:
  void Open();
  void CheckSame(const StateFile& file);
  void CheckNotTooMany(const Films& films) const;
  std::unique_ptr<StateCopy> Copy(RunState& state) const;
  /// What writes the image so far; nothing if nobody watches.
  std::function<void()> Watch(RunState& state) const;
  /// False after an exception, of which on_problem is told, once until all is well.
  bool Try(const std::function<void()>& write);

  const Job& job_;
  CheckpointSettings settings_;
  const nlohmann::json identity_, head_;
  std::function<void(const std::string&)> on_problem_;
  std::set<std::string> told_;  // problems
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
