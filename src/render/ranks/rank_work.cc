#include "src/render/ranks/rank_work.h"

#include <algorithm>
#include <cstring>
#include <future>
#include <optional>
#include <string>
#include <utility>

#include "src/base/core/check.h"
#include "src/base/core/parallel.h"
#include "src/base/core/stopwatch.h"
#include "src/render/ranks/rank_balance.h"
#include "src/render/ranks/rank_messages.h"
#include "src/render/wave/task_watcher.h"

namespace lanelight {
namespace {

using Clock = std::chrono::steady_clock;

// mpirun leaves a second after a signal. The leader does not wait longer than this for
// ranks that do not answer.
constexpr double kAnswerSeconds = 0.6;

template <class Value>
std::string ToString(const Value& value) {
  static_assert(std::is_trivially_copyable_v<Value>);
  return {reinterpret_cast<const char*>(&value), sizeof(Value)};
}

// Adds the rows that a worker has sent.
void AddBytes(const MutableStateColumn& rows, std::string_view bytes) {
  LL_CHECK_EQ(bytes.size(), rows.Bytes());
  std::vector<char> memory(bytes.begin(), bytes.end());
  MutableStateColumn sent = rows;
  sent.data = memory.data();
  AddColumn(rows, sent);
}

// Stops the tasks of a worker: for a signal to this rank, or if another rank stops.
class WorkerWatch : public TaskWatcher {
 public:
  explicit WorkerWatch(const std::atomic<bool>* stop) : signal_(stop) {}
  bool IsInterrupted() const override { return signal_.IsStopped(); }
  bool IsStopped() const override { return signal_.IsStopped() || stopped_; }
  bool IsCancelled() const override { return signal_.IsCancelled() || cancelled_; }
  void TaskDone() override {}
  void Update(const RankStatus& all) {
    stopped_ = all.stopped > 0;
    cancelled_ = all.cancelled > 0;
  }

 private:
  const StopWatcher signal_;
  std::atomic<bool> stopped_{false}, cancelled_{false};
};

}  // namespace

// A round of this rank, on threads of its own.
class RankWork::OwnRound {
 public:
  OwnRound(RankWork& work, const Round& round, TaskWatcher& watcher)
      : work_(work),
        round_(round),
        watcher_(watcher),
        rendered_before_(RenderedSamples()) {
    total_ = scheduler().MissingSamples(scheduler().Snapshot(), round.end);
    Start();
  }

  /// Waits at most this long; returns whether the round has ended.
  bool Wait(std::chrono::duration<double> timeout) {
    const bool done = running_.wait_for(timeout) == std::future_status::ready;
    const double seconds = since_.Lap();
    if (!done) busy_ += seconds;
    return done;
  }
  RankLoad load() const {
    const std::uint64_t rendered = RenderedSamples() - rendered_before_;
    return {total_ - rendered, busy_ > 0 ? double(rendered) / busy_ : 0};
  }
  std::vector<TileProgress> Release(std::uint64_t samples) {
    std::vector<TileProgress> tiles = scheduler().Release(samples);
    total_ -= scheduler().MissingSamples(tiles, round_.end);
    return tiles;
  }
  void AddTiles(const std::vector<TileProgress>& tiles) {
    if (tiles.empty()) return;
    scheduler().AddTiles(tiles);
    total_ += scheduler().MissingSamples(tiles, round_.end);
    if (running_.wait_for(std::chrono::seconds(0)) == std::future_status::ready) Start();
  }

 private:
  Scheduler& scheduler() { return work_.threads_.scheduler(); }
  std::uint64_t RenderedSamples() const { return work_.threads_.RenderedSamples(); }
  void Start() {
    running_ = std::async(std::launch::async, [this] {
      try {
        work_.threads_.RunRound(round_, watcher_);
      } catch (...) {
        work_.problem_ = std::current_exception();
      }
    });
  }

  RankWork& work_;
  const Round round_;
  TaskWatcher& watcher_;
  const std::uint64_t rendered_before_;
  std::uint64_t total_ = 0;  // samples of this round
  double busy_ = 0;          // seconds
  Stopwatch since_;
  std::future<void> running_;  // ends before the rest
};

void RankWork::AssignTiles(bool have_samples, int min_tile_side) {
  if (have_samples) {
    for (const MutableStateColumn& column : films_.Columns()) {
      group_.Broadcast({static_cast<char*>(column.data), column.Bytes()});
    }
  }
  const auto parts =
      DistributeTiles(tiles(), group_.AllGather(MaxThreads()), min_tile_side);
  std::vector<PixelRect> all;
  std::vector<TileProgress> own;
  for (std::size_t rank = 0; rank < parts.size(); ++rank) {
    for (const PixelRect& tile : parts[rank]) {
      const std::uint64_t done = films_.film().Samples(tile.x0, tile.y0);
      if (rank == std::size_t(group_.rank())) {
        own.push_back({all.size(), done});
      } else {
        other_levels_.Add({done, done});
      }
      all.push_back(tile);
    }
  }
  threads_.ShareTiles(all, own);
}

TileLevels RankWork::Levels() const {
  TileLevels levels = threads_.Levels();
  levels.Add(other_levels_);
  return levels;
}

RunCounts RankWork::Counts() const {
  RunCounts counts = threads_.Counts();
  counts.Add(other_counts_);
  return counts;
}

RankWork::Command RankWork::Share(Command command) {
  static_assert(std::is_trivially_copyable_v<Command>);
  group_.Broadcast({reinterpret_cast<char*>(&command), sizeof(command)});
  return command;
}

void RankWork::RunRound(const Round& round, TaskWatcher& watcher) {
  Share({Order::kRender, round});
  gathered_ = false;
  const RankStatus all = Render(round, watcher, [&](const RankStatus& sum) {
    if (sum.failed + sum.interrupted > 0) stopped_ = true;
    failed_ |= sum.failed > 0;
    // Samples of other ranks are progress too.
    if (rendered_elsewhere_.exchange(sum.samples) != sum.samples) watcher.TaskDone();
  });
  if (problem_) std::rethrow_exception(problem_);
  if (aborted_) {
    stopped_ = true;
  } else if (all.behind > 0) {
    Gather();
  } else {
    other_levels_ = {round.end, std::max(round.end, other_levels_.maximum)};
  }
}

// Renders this rank's tiles and exchanges status until all ranks have ended; balances
// what is left.
RankStatus RankWork::Render(const Round& round, TaskWatcher& watcher,
                            const OnStatus& on_status) {
  std::optional<Clock::time_point> signal;
  const StopPredicate should_stop = [&] {
    if (!group_.is_leader() || !watcher.IsInterrupted()) return false;
    if (!signal) signal = Clock::now();
    return SecondsSince(*signal) > kAnswerSeconds;
  };
  OwnRound own(*this, round, watcher);
  PollInterval interval;
  for (std::uint64_t step = 0;; ++step) {
    const bool done = own.Wait(interval.TimeUntilNext());
    RankStatus status = Status(round, watcher, done);
    status.left = own.load().left;
    auto all = group_.Sum(status, should_stop);
    aborted_ = !all;
    if (aborted_) return {};
    interval.Update(*all);
    all->samples -= status.samples;  // of others
    on_status(*all);
    if (all->busy == 0) return *all;
    // All ranks have the same status, and decide alike.
    if (all->failed + all->interrupted + all->stopped > 0) continue;
    aborted_ = !BalanceRanks(step, own, should_stop);
    if (aborted_) return {};
  }
}

// Returns false if it gave up on the other rank.
bool RankWork::BalanceRanks(std::uint64_t step, OwnRound& own,
                            const StopPredicate& should_stop) {
  const int partner = BalancePartner(group_.rank(), group_.ranks(), step);
  if (partner < 0) return true;
  RankLoad mine = own.load(), theirs;
  const auto load = group_.Swap(partner, ToString(mine), should_stop);
  if (!load) return false;
  LL_CHECK_EQ(load->size(), sizeof(theirs));
  std::memcpy(&theirs, load->data(), sizeof(theirs));
  const std::uint64_t samples = SamplesToTransfer(mine, theirs);
  if (samples == 0 && SamplesToTransfer(theirs, mine) == 0) return true;
  std::string packed;
  SerializeTiles(own.Release(samples), tiles(), films_, packed);
  const auto bytes = group_.Swap(partner, std::move(packed), should_stop);
  if (!bytes) return false;
  own.AddTiles(DeserializeTiles(*bytes, tiles(), films_));
  return true;
}

RankStatus RankWork::Status(const Round& round, const TaskWatcher& watcher,
                            bool done) const {
  RankStatus status;
  status.failed = done && problem_;
  status.interrupted = watcher.IsInterrupted();
  status.stopped = watcher.IsStopped();
  status.cancelled = watcher.IsCancelled();
  status.busy = !done;
  status.behind = !done || threads_.Levels().minimum < round.end;
  status.samples = threads_.RenderedSamples();
  return status;
}

void RankWork::Gather() {
  if (gathered_ || aborted_) return;
  Share({Order::kGather, {}});
  other_counts_ = {};
  other_levels_ = {};
  for (int piece = MaxPieces(0); piece > 0; --piece) {
    group_.Gather("", [this](int, std::string_view bytes) { ReceiveTiles(bytes); });
  }
  MoveShared();
  gathered_ = true;
}

// Moves the sums of light subpaths to the leader, in pieces.
void RankWork::MoveShared() {
  for (const MutableStateColumn& column : films_.film().SharedColumns()) {
    for (std::size_t first = 0; first < column.rows; first += kPixelsOfPiece) {
      const auto count = std::min<std::size_t>(kPixelsOfPiece, column.rows - first);
      const MutableStateColumn rows = RowsOf(column, first, count);
      const std::string_view own(static_cast<char*>(rows.data), rows.Bytes());
      group_.Gather(group_.is_leader() ? "" : std::string(own),
                    [&](int, std::string_view bytes) { AddBytes(rows, bytes); });
      if (!group_.is_leader()) std::memset(rows.data, 0, rows.Bytes());
    }
  }
}

// Adds the counts of a worker and some of its tiles.
void RankWork::ReceiveTiles(std::string_view bytes) {
  RunCounts counts;
  LL_CHECK_GE(bytes.size(), sizeof(counts));
  std::memcpy(&counts, bytes.data(), sizeof(counts));
  other_counts_.Add(counts);
  other_levels_.Add(
      LevelsOf(DeserializeTiles(bytes.substr(sizeof(counts)), tiles(), films_)));
}

void RankWork::SendTiles() {
  const std::vector<TileProgress> owned = threads_.scheduler().Snapshot();
  const auto pieces = InPieces(owned, tiles());
  RunCounts counts = threads_.Counts();
  counts.cpu_seconds = clock_.CpuSeconds();
  std::string bytes;
  const auto all = std::size_t(MaxPieces(int(pieces.size())));
  for (std::size_t i = 0; i < all; ++i) {
    bytes.clear();
    bytes += ToString(std::exchange(counts, {}));
    SerializeTiles(i < pieces.size() ? pieces[i] : std::span<const TileProgress>(),
                   tiles(), films_, bytes);
    group_.Gather(bytes, nullptr);
  }
  MoveShared();
}

// Returns the largest number of pieces of any rank.
int RankWork::MaxPieces(int own) {
  const std::vector<int> all = group_.AllGather(own);
  return *std::ranges::max_element(all);
}

// All ranks meet once more, so that the leader learns of a failure.
void RankWork::Finish() {
  if (!aborted_) {
    Share({Order::kLeave, {}});
    group_.AllGather(0);
  } else if (failed_) {
    throw RankFailure(
        "error: a rank has failed, and other ranks do not finish their tasks");
  }
}

void RankWork::Serve(const std::function<void(const Round&)>& begin,
                     const std::atomic<bool>* stop) {
  while (true) {
    const Command command = Share({});
    if (command.order == Order::kLeave) break;
    if (command.order == Order::kGather) {
      SendTiles();
      continue;
    }
    begin(command.round);
    WorkerWatch watch(stop);
    Render(command.round, watch, [&](const RankStatus& all) { watch.Update(all); });
  }
  if (problem_) std::rethrow_exception(problem_);
  group_.AllGather(0);
}

}  // namespace lanelight
