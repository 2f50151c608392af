// The tasks of a run, shared out to the ranks of a group: each renders its part of the
// tiles, and gives some away, with all that there is of their pixels, where it would end
// later than others. The samples of a pixel are so added in the same order as by a
// process alone, and the image has the same bits.
#pragma once

#include <atomic>
#include <exception>
#include <functional>
#include <vector>

#include "src/base/core/rank_group.h"
#include "src/render/run/tasks.h"
#include "src/render/wave/films.h"
#include "src/render/wave/run_clock.h"
#include "src/render/wave/task_watcher.h"

namespace lanelight {

class GroupTasks {
 public:
  /// Refers to all of these for as long as it lives.
  GroupTasks(RankGroup& group, const RunClock& clock, Tasks& tasks, Films& films)
      : group_(group), clock_(clock), tasks_(tasks), films_(films) {}

  /// Collective, before the first round, when all ranks have the same tiles: from here on
  /// `tasks` has this rank's alone. `have_samples`: workers get the leader's first.
  void Deal(bool have_samples);

  // Leader:
  /// All of several ranks do the work, but for tasks that have not begun when the watcher
  /// stops it.
  void RunRound(const RoundWork& work, TaskWatcher& watcher);
  /// Brings what all ranks have rendered into the films and the counts of the tasks. If
  /// some do not answer, after a signal, theirs are those of the last time.
  void Gather();
  /// A rank was interrupted, or has failed: no more is to be begun.
  bool Stopped() const { return stopped_; }
  /// Lets the workers go. Throws RankFailure if one has failed.
  void Dismiss();

  /// Worker: does what the leader asks for until it lets it go. Calls begin(first) before
  /// tasks whose first sample that is; `stop`: a signal came to this rank.
  void Serve(const std::function<void(std::uint64_t first)>& begin,
             const std::atomic<bool>* stop);

 private:
  enum class Order : std::uint64_t { kRender, kGather, kLeave };
  struct Command {
    Order order = Order::kLeave;
    RoundWork work;
  };
  using GivesUp = std::function<bool()>;
  class OwnRound;
  using Hear = std::function<void(const RankStatus& all)>;

  bool alone() const { return group_.ranks() == 1; }
  Command Tell(Command command);
  RankStatus Render(const RoundWork& work, TaskWatcher& watcher, const Hear& hear);
  RankStatus Status(const RoundWork& work, const TaskWatcher& watcher, bool done) const;
  /// False: gave up.
  bool Balance(std::uint64_t turn, OwnRound& own, const GivesUp& gives_up);
  void SendPieces();
  void TakePiece(std::string_view bytes);
  int MostPieces(int own);

  RankGroup& group_;
  const RunClock& clock_;
  Tasks& tasks_;
  Films& films_;
  bool gathered_ = true;  // nothing has been rendered since
  std::atomic<bool> stopped_{false};
  bool failed_ = false;         // a rank has
  bool gave_up_ = false;        // on a rank that has not answered
  std::exception_ptr problem_;  // of this rank's tasks
};

}  // namespace lanelight
