// The leader's side of one round: it sends batches of tiles, each with the sums of its
// pixels so far, gets the sums back with more samples in them, and renders tiles itself.
#pragma once

#include <atomic>
#include <deque>
#include <exception>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "src/ranks/mail.h"
#include "src/wavefront/films.h"
#include "src/wavefront/hand_out.h"
#include "src/wavefront/task_watcher.h"
#include "src/wavefront/tasks.h"
#include "src/wavefront/tile_columns.h"

namespace lanelight {

/// What the leader knows of another rank.
struct Member {
  std::string name;  // "rank 2 on node7"
  int threads = 1;
  bool gone = false;
  std::deque<Message> texts;                   // that nobody has asked for yet
  std::deque<std::vector<TileRange>> batches;  // that it has not sent back
};

class LeaderRound {
 public:
  /// Refers to all but the work for as long as it lives. `members`: by rank, the leader's
  /// own first.
  LeaderRound(const RoundWork& work, Tasks& tasks, TaskWatcher& watcher, Films& films,
              Mail& mail, std::vector<Member>& members, HandOut& queue);

  /// Is told of ranks that were interrupted (nothing) or have failed (why).
  using OnTrouble = std::function<void(const std::string& why)>;
  /// Until all is done, or nothing is in flight after a stop.
  void Run(const OnTrouble& on_trouble);
  /// Some did not answer in time after a signal.
  bool gave_up() const { return gave_up_; }

 private:
  bool Stopped() const { return ended_ || watcher_.Stopped(); }
  void RenderOwn();
  void RenderInThread();
  void Serve(const OnTrouble& on_trouble);
  bool InFlight() const;
  bool Give(int rank);
  std::string Pack(const std::vector<TileRange>& batch) const;
  bool Take(int rank, const OnTrouble& on_trouble);
  void TakeBatch(Member& member, std::string_view bytes, const OnTrouble& on_trouble);
  void Unpack(const TileRange& range, std::string_view& bytes);

  const RoundWork work_;
  Tasks& tasks_;
  TaskWatcher& watcher_;
  Films& films_;
  Mail& mail_;
  std::vector<Member>& members_;
  HandOut& queue_;
  const TileColumns rows_;
  std::exception_ptr problem_;
  std::atomic<bool> ended_{false}, own_done_{false};
  bool gave_up_ = false;
};

}  // namespace lanelight
