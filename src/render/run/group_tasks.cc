#include "src/render/run/group_tasks.h"

#include <algorithm>
#include <cstring>
#include <future>
#include <optional>
#include <string>
#include <utility>

#include "src/base/core/check.h"
#include "src/base/core/parallel.h"
#include "src/base/core/stopwatch.h"
#include "src/render/run/held_tiles.h"
#include "src/render/run/listening.h"
#include "src/render/run/rank_balance.h"
#include "src/render/wave/stop_watcher.h"

namespace lanelight {
namespace {

using Clock = std::chrono::steady_clock;

// After a signal mpirun leaves a second; for those who do not answer until then nobody
// waits.
constexpr double kAnswerSeconds = 0.6;

template <class Value>
std::span<char> BytesOf(Value& value) {
  static_assert(std::is_trivially_copyable_v<Value>);
  return {reinterpret_cast<char*>(&value), sizeof(Value)};
}

template <class Value>
std::string ToString(const Value& value) {
  static_assert(std::is_trivially_copyable_v<Value>);
  return {reinterpret_cast<const char*>(&value), sizeof(Value)};
}

// Of a worker: a signal to this rank, and what others have said.
class WorkerWatch : public TaskWatcher {
 public:
  explicit WorkerWatch(const std::atomic<bool>* stop) : signal_(stop) {}
  bool Interrupted() const override { return signal_.Stopped(); }
  bool Stopped() const override { return signal_.Stopped() || stopped_; }
  bool Cancelled() const override { return signal_.Cancelled() || cancelled_; }
  void TaskDone() override {}
  void Hear(const RankStatus& all) {
    stopped_ = all.stopped > 0;
    cancelled_ = all.cancelled > 0;
  }

 private:
  const StopWatcher signal_;
  std::atomic<bool> stopped_{false}, cancelled_{false};
};

}  // namespace

// A round of this rank, on threads of its own.
class GroupTasks::OwnRound {
 public:
  OwnRound(GroupTasks& group, const RoundWork& work, TaskWatcher& watcher)
      : group_(group), work_(work), watcher_(watcher), taken_before_(Taken()) {
    total_ = group.tasks_.Missing(group.tasks_.Held(), work.limit);
    Start();
  }

  /// Whether it has ended, in no more than this time.
  bool Wait(std::chrono::duration<double> most) {
    const bool done = running_.wait_for(most) == std::future_status::ready;
    const double seconds = since_.Lap();
    if (!done) busy_ += seconds;
    return done;
  }
  RankLoad load() const {
    const std::uint64_t taken = Taken() - taken_before_;
    return {total_ - taken, busy_ > 0 ? double(taken) / busy_ : 0};
  }
  std::vector<HeldTile> Give(std::uint64_t samples) {
    std::vector<HeldTile> given = group_.tasks_.Give(samples);
    total_ -= group_.tasks_.Missing(given, work_.limit);
    return given;
  }
  void Take(const std::vector<HeldTile>& tiles) {
    if (tiles.empty()) return;
    group_.tasks_.Take(tiles);
    total_ += group_.tasks_.Missing(tiles, work_.limit);
    if (running_.wait_for(std::chrono::seconds(0)) == std::future_status::ready) Start();
  }

 private:
  std::uint64_t Taken() const { return group_.tasks_.own_taken(); }
  void Start() {
    running_ = std::async(std::launch::async, [this] {
      try {
        group_.tasks_.RunRound(work_, watcher_, group_.films_);
      } catch (...) {
        group_.problem_ = std::current_exception();
      }
    });
  }

  GroupTasks& group_;
  const RoundWork work_;
  TaskWatcher& watcher_;
  const std::uint64_t taken_before_;
  std::uint64_t total_ = 0;  // samples of this round
  double busy_ = 0;          // seconds
  Stopwatch since_;
  std::future<void> running_;  // ends before the rest
};

void GroupTasks::Deal(bool have_samples) {
  if (alone()) return;
  if (have_samples) {
    for (const MutableStateColumn& column : films_.Columns()) {
      group_.Broadcast({static_cast<char*>(column.data), column.Bytes()});
    }
  }
  tasks_.Deal(group_.AllGather(MaxThreads()), group_.rank(), films_);
}

GroupTasks::Command GroupTasks::Tell(Command command) {
  group_.Broadcast(BytesOf(command));
  return command;
}

void GroupTasks::RunRound(const RoundWork& work, TaskWatcher& watcher) {
  Tell({Order::kRender, work});
  gathered_ = false;
  const RankStatus all = Render(work, watcher, [&](const RankStatus& sum) {
    if (sum.failed + sum.interrupted > 0) stopped_ = true;
    failed_ |= sum.failed > 0;
    // Samples of others are progress too.
    if (tasks_.OthersHaveTaken(sum.samples)) watcher.TaskDone();
  });
  if (problem_) std::rethrow_exception(problem_);
  if (gave_up_) {
    stopped_ = true;
  } else if (all.behind > 0) {
    Gather();
  } else {
    tasks_.OthersAreAt(work.limit);
  }
}

// Renders this rank's tiles, hears what the others do until all have ended, and evens out
// what is left to each of them.
RankStatus GroupTasks::Render(const RoundWork& work, TaskWatcher& watcher,
                              const Hear& hear) {
  std::optional<Clock::time_point> signal;
  const GivesUp gives_up = [&] {
    if (!group_.leads() || !watcher.Interrupted()) return false;
    if (!signal) signal = Clock::now();
    return SecondsSince(*signal) > kAnswerSeconds;
  };
  OwnRound own(*this, work, watcher);
  Listening listening;
  for (std::uint64_t turn = 0;; ++turn) {
    const bool done = own.Wait(listening.UntilNext());
    RankStatus status = Status(work, watcher, done);
    status.left = own.load().left;
    auto all = group_.Sum(status, gives_up);
    gave_up_ = !all;
    if (gave_up_) return {};
    listening.Hear(*all);
    all->samples -= status.samples;  // of others
    hear(*all);
    if (all->busy == 0) return *all;
    // All ranks see the same, and go on alike.
    if (all->failed + all->interrupted + all->stopped > 0) continue;
    gave_up_ = !Balance(turn, own, gives_up);
    if (gave_up_) return {};
  }
}

bool GroupTasks::Balance(std::uint64_t turn, OwnRound& own, const GivesUp& gives_up) {
  const int partner = BalancePartner(group_.rank(), group_.ranks(), turn);
  if (partner < 0) return true;
  RankLoad mine = own.load(), theirs;
  const auto load = group_.Swap(partner, ToString(mine), gives_up);
  if (!load) return false;
  LL_CHECK_EQ(load->size(), sizeof(theirs));
  std::memcpy(&theirs, load->data(), sizeof(theirs));
  const std::uint64_t samples = SamplesToGive(mine, theirs);
  if (samples == 0 && SamplesToGive(theirs, mine) == 0) return true;
  const std::vector<HeldTile> given = own.Give(samples);
  std::string gift;
  PackTiles(given, tasks_.tiles(), films_, gift);
  const auto bytes = group_.Swap(partner, std::move(gift), gives_up);
  if (!bytes) return false;
  own.Take(UnpackTiles(*bytes, tasks_.tiles(), films_));
  return true;
}

RankStatus GroupTasks::Status(const RoundWork& work, const TaskWatcher& watcher,
                              bool done) const {
  RankStatus status;
  status.failed = done && problem_;
  status.interrupted = watcher.Interrupted();
  status.stopped = watcher.Stopped();
  status.cancelled = watcher.Cancelled();
  status.busy = !done;
  status.behind = !done || tasks_.Levels().least < work.limit;
  status.samples = tasks_.own_taken();
  return status;
}

void GroupTasks::Gather() {
  if (alone() || gathered_ || gave_up_) return;
  Tell({Order::kGather, {}});
  tasks_.ForgetOthers();
  for (int piece = MostPieces(0); piece > 0; --piece) {
    group_.Gather("", [this](int, std::string_view bytes) { TakePiece(bytes); });
  }
  gathered_ = true;
}

// What a worker has counted, and some of its tiles.
void GroupTasks::TakePiece(std::string_view bytes) {
  RunCounts counts;
  LL_CHECK_GE(bytes.size(), sizeof(counts));
  std::memcpy(&counts, bytes.data(), sizeof(counts));
  tasks_.AddOthers(counts,
                   UnpackTiles(bytes.substr(sizeof(counts)), tasks_.tiles(), films_));
}

void GroupTasks::SendPieces() {
  const std::vector<HeldTile> held = tasks_.Held();
  const auto pieces = InPieces(held, tasks_.tiles());
  RunCounts counts = tasks_.counts();
  counts.cpu_seconds = clock_.CpuSeconds();
  std::string bytes;
  const auto all = static_cast<std::size_t>(MostPieces(static_cast<int>(pieces.size())));
  for (std::size_t i = 0; i < all; ++i) {
    bytes.clear();
    bytes += ToString(std::exchange(counts, {}));
    PackTiles(i < pieces.size() ? pieces[i] : std::span<const HeldTile>(), tasks_.tiles(),
              films_, bytes);
    group_.Gather(bytes, nullptr);
  }
}

// Of any rank.
int GroupTasks::MostPieces(int own) {
  const std::vector<int> all = group_.AllGather(own);
  return *std::max_element(all.begin(), all.end());
}

// All meet once more, so that the leader hears of a failure.
void GroupTasks::Dismiss() {
  if (alone()) return;
  if (!gave_up_) {
    Tell({Order::kLeave, {}});
    group_.AllGather(0);
  } else if (failed_) {
    throw RankFailure("error: a rank has failed, and others do not end their tasks");
  }
}

void GroupTasks::Serve(const std::function<void(std::uint64_t)>& begin,
                       const std::atomic<bool>* stop) {
  while (true) {
    const Command command = Tell({});
    if (command.order == Order::kLeave) break;
    if (command.order == Order::kGather) {
      SendPieces();
      continue;
    }
    begin(command.work.first);
    WorkerWatch watch(stop);
    Render(command.work, watch, [&](const RankStatus& all) { watch.Hear(all); });
  }
  if (problem_) std::rethrow_exception(problem_);
  group_.AllGather(0);
}

}  // namespace lanelight
