#include "src/run/group_tasks.h"

#include <cstring>
#include <future>
#include <optional>
#include <string>

#include "src/core/check.h"
#include "src/core/parallel.h"
#include "src/wave/stop_watcher.h"

namespace lanelight {
namespace {

using Clock = std::chrono::steady_clock;

// How often ranks hear of each other while they render: a few times within what a signal
// leaves them, and seldom enough to cost nothing.
constexpr auto kBetweenSums = std::chrono::milliseconds(50);
// After a signal mpirun leaves a second; for those who do not answer until then nobody
// waits.
constexpr double kAnswerSeconds = 0.6;

// Before the pixels of a worker's tiles.
struct PartHead {
  RunCounts counts;
  TileLevels levels;
};

template <class Value>
std::span<char> BytesOf(Value& value) {
  static_assert(std::is_trivially_copyable_v<Value>);
  return {reinterpret_cast<char*>(&value), sizeof(Value)};
}

// Calls copy(address, bytes) for each row of each tile in each column of the films.
template <class Copy>
void ForEachRow(Films& films, const std::vector<PixelRect>& tiles, const Copy& copy) {
  const FilmAccumulator& film = films.film();
  for (const MutableStateColumn& column : films.Columns()) {
    for (const PixelRect& tile : tiles) {
      for (int y = tile.y0; y < tile.y1; ++y) {
        const auto row = static_cast<std::size_t>(y - film.y0()) *
                             static_cast<std::size_t>(film.width()) +
                         static_cast<std::size_t>(tile.x0 - film.x0());
        copy(static_cast<char*>(column.data) + row * column.RowBytes(),
             static_cast<std::size_t>(tile.width()) * column.RowBytes());
      }
    }
  }
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

void GroupTasks::Deal(bool have_samples) {
  if (alone()) return;
  if (have_samples) {
    for (const MutableStateColumn& column : films_.Columns()) {
      group_.Broadcast({static_cast<char*>(column.data), column.Bytes()});
    }
  }
  parts_ = tasks_.Deal(group_.AllGather(MaxThreads()), group_.rank(), films_);
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

// Renders this rank's part, and hears what the others do until all have ended.
RankStatus GroupTasks::Render(const RoundWork& work, TaskWatcher& watcher,
                              const Hear& hear) {
  const auto own = std::async(std::launch::async, [&] {
    try {
      tasks_.RunRound(work, watcher, films_);
    } catch (...) {
      problem_ = std::current_exception();
    }
  });
  std::optional<Clock::time_point> signal;
  const auto gives_up = [&] {
    if (!group_.leads() || !watcher.Interrupted()) return false;
    if (!signal) signal = Clock::now();
    return SecondsSince(*signal) > kAnswerSeconds;
  };
  RankStatus all;
  do {
    const bool done = own.wait_for(kBetweenSums) == std::future_status::ready;
    const RankStatus status = Status(work, watcher, done);
    const auto sum = group_.Sum(status, gives_up);
    gave_up_ = !sum;
    if (gave_up_) return {};
    all = *sum;
    all.samples -= status.samples;  // of others
    hear(all);
  } while (all.busy > 0);
  return all;
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
  group_.Gather("", [this](int rank, std::string_view bytes) { TakePart(rank, bytes); });
  gathered_ = true;
}

void GroupTasks::TakePart(int rank, std::string_view bytes) {
  const auto take = [&bytes](void* to, std::size_t size) {
    LL_CHECK_GE(bytes.size(), size);
    std::memcpy(to, bytes.data(), size);
    bytes.remove_prefix(size);
  };
  PartHead head;
  take(&head, sizeof(head));
  ForEachRow(films_, parts_[static_cast<std::size_t>(rank)], take);
  LL_CHECK(bytes.empty());
  tasks_.AddOthers(head.counts, head.levels);
}

void GroupTasks::SendPart() {
  PartHead head = {tasks_.counts(), tasks_.Levels()};
  head.counts.cpu_seconds = clock_.CpuSeconds();
  const std::span<char> first = BytesOf(head);
  std::string bytes(first.begin(), first.end());
  ForEachRow(films_, tasks_.tiles(),
             [&](const char* from, std::size_t size) { bytes.append(from, size); });
  group_.Gather(bytes, nullptr);
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
      SendPart();
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
