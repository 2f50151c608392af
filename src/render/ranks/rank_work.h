// Renders rounds on several ranks: each renders its part of the tiles, and hands tiles
// over, with all that the films have of their pixels, where it would end later than
// others. The samples of a pixel are added in the same order as by one process, so the
// image is bit-identical.
#pragma once

#include <atomic>
#include <cstdint>
#include <exception>
#include <functional>
#include <string_view>
#include <vector>

#include "src/base/core/rank_group.h"
#include "src/render/schedule/thread_work.h"
#include "src/render/wave/films.h"
#include "src/render/wave/run_options.h"

namespace lanelight {

class RankWork : public RoundRunner {
 public:
  /// Keeps references to all of these.
  RankWork(RankGroup& group, const RunClock& clock, ThreadWork& threads, Films& films)
      : group_(group), clock_(clock), threads_(threads), films_(films) {}

  /// Gives each rank its part of the tiles; collective, before the first round.
  /// `have_samples`: workers receive the leader's samples first.
  void AssignTiles(bool have_samples, int min_tile_side);

  // Leader:
  void RunRound(const Round& round, TaskWatcher& watcher) override;
  /// Keeps the last samples of ranks that do not answer after a signal.
  void Gather() override;
  TileLevels Levels() const override;
  RunCounts Counts() const override;
  std::uint64_t RenderedSamples() const override {
    return threads_.RenderedSamples() + rendered_elsewhere_;
  }
  bool IsStopped() const override { return stopped_; }
  void Finish() override;

  /// Renders for the leader until it finishes; on workers. Calls begin(round) before each
  /// round; `stop`: a signal came to this rank.
  void Serve(const std::function<void(const Round&)>& begin,
             const std::atomic<bool>* stop);

 private:
  enum class Order : std::uint64_t { kRender, kGather, kLeave };
  struct Command {
    Order order = Order::kLeave;
    Round round;
  };
  using StopPredicate = std::function<bool()>;
  class OwnRound;
  using OnStatus = std::function<void(const RankStatus& all)>;

  Command Share(Command command);
  RankStatus Render(const Round& round, TaskWatcher& watcher, const OnStatus& on_status);
  RankStatus Status(const Round& round, const TaskWatcher& watcher, bool done) const;
  bool BalanceRanks(std::uint64_t step, OwnRound& own, const StopPredicate& should_stop);
  void SendTiles();
  void ReceiveTiles(std::string_view bytes);
  void MoveShared();
  int MaxPieces(int own);
  const std::vector<PixelRect>& tiles() const { return threads_.scheduler().tiles(); }

  RankGroup& group_;
  const RunClock& clock_;
  ThreadWork& threads_;
  Films& films_;
  // Counts and levels of the other ranks at the last round or Gather().
  RunCounts other_counts_;
  TileLevels other_levels_;
  std::atomic<std::uint64_t> rendered_elsewhere_{0};
  bool gathered_ = true;  // nothing has been rendered since
  std::atomic<bool> stopped_{false};
  bool failed_ = false;         // a rank has
  bool aborted_ = false;        // on a rank that has not answered
  std::exception_ptr problem_;  // of this rank's tasks
};

}  // namespace lanelight
