// Ranks that talk by MPI (docs/mpi.md). Only the main thread of a process calls MPI, and
// nobody waits in it: all waiting is polling with naps, so that a rank that waits leaves
// its core to others.
//
// The leader sends batches of tiles, each with the sums of its pixels so far, and gets
// the sums back with more samples in them. The samples of a pixel are so always added in
// the same order, whoever renders them: the image has the bits of a single process.
#include <mpi.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstring>
#include <deque>
#include <exception>
#include <limits>
#include <list>
#include <mutex>
#include <optional>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "src/core/check.h"
#include "src/core/clock.h"
#include "src/core/error.h"
#include "src/core/parallel.h"
#include "src/ranks/ranks.h"
#include "src/wavefront/hand_out.h"
#include "src/wavefront/schedule.h"
#include "src/wavefront/stop_watcher.h"
#include "src/wavefront/tasks.h"
#include "src/wavefront/tile_rows.h"

namespace lanelight {
namespace {

using Clock = std::chrono::steady_clock;

enum Tag : int {
  kText,    // to the leader, of Agree
  kShared,  // from the leader
  kWork,    // from the leader: a batch of tiles
  kDone,    // to the leader: the same tiles, with more samples
  kFailed,  // to the leader: why
  kEnd      // from the leader
};

constexpr auto kShortestNap = std::chrono::microseconds(50);
constexpr auto kLongestNap = std::chrono::microseconds(2000);
// Batches that a rank has at most: it begins with the next one while the last one
// travels.
constexpr std::size_t kMostBatches = 2;
// After a signal mpirun leaves a second; for those who do not answer until then nobody
// waits.
constexpr double kPatienceSeconds = 0.6;
// The same after the time is over, where paths of other ranks do not end.
constexpr double kEndlessSeconds = 10;
// Rounds become longer, up to this: at the end of each, ranks wait for each other.
constexpr double kRoundSeconds = 4;

double Since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// Naps between looks at the mail, longer while nothing comes.
class Naps {
 public:
  /// `moved`: something has come, and more may follow soon.
  void Take(bool moved) {
    if (moved) {
      nap_ = kShortestNap;
      return;
    }
    std::this_thread::sleep_for(nap_);
    nap_ = std::min<std::chrono::microseconds>(2 * nap_, kLongestNap);
  }

 private:
  std::chrono::microseconds nap_ = kShortestNap;
};

// Bytes of a message, one value after the other.
template <class Value>
void Write(const Value& value, std::string& bytes) {
  static_assert(std::is_trivially_copyable_v<Value>);
  bytes.append(reinterpret_cast<const char*>(&value), sizeof(Value));
}

template <class Value>
Value Read(std::string_view& bytes) {
  LL_CHECK_GE(bytes.size(), sizeof(Value));
  Value value;
  std::memcpy(&value, bytes.data(), sizeof(Value));
  bytes.remove_prefix(sizeof(Value));
  return value;
}

struct Message {
  Tag tag = kEnd;
  std::string bytes;
};

struct WorkHead {
  RoundWork round;
  std::uint64_t ranges = 0;
};

struct DoneHead {
  RunCounts counts;
  std::uint64_t ranges = 0;
  double seconds = 0;  // of all threads together
  bool interrupted = false;
};

// Messages of one process, in both directions.
class Mail {
 public:
  Mail() {
    MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
    MPI_Comm_size(MPI_COMM_WORLD, &ranks_);
  }
  int rank() const { return rank_; }
  int ranks() const { return ranks_; }
  std::uint64_t bytes() const { return bytes_; }  // in both directions

  /// Returns at once; Sent() sees to it.
  void Send(int to, Tag tag, std::string bytes) {
    LL_CHECK_LE(bytes.size(), std::size_t(std::numeric_limits<int>::max()));
    bytes_ += bytes.size();
    Letter& letter = letters_.emplace_back();
    letter.bytes = std::move(bytes);
    MPI_Isend(letter.bytes.data(), static_cast<int>(letter.bytes.size()), MPI_BYTE, to,
              tag, MPI_COMM_WORLD, &letter.request);
  }

  /// Whether all that was sent is on its way.
  bool Sent() {
    letters_.remove_if([](Letter& letter) {
      int done = 0;
      MPI_Test(&letter.request, &done, MPI_STATUS_IGNORE);
      return done != 0;
    });
    return letters_.empty();
  }

  std::optional<Message> Receive(int from) {
    int there = 0, size = 0;
    MPI_Message handle;
    MPI_Status status;
    MPI_Improbe(from, MPI_ANY_TAG, MPI_COMM_WORLD, &there, &handle, &status);
    if (!there) return std::nullopt;
    MPI_Get_count(&status, MPI_BYTE, &size);
    Message message = {static_cast<Tag>(status.MPI_TAG),
                       std::string(static_cast<std::size_t>(size), '\0')};
    bytes_ += message.bytes.size();
    MPI_Mrecv(message.bytes.data(), size, MPI_BYTE, &handle, MPI_STATUS_IGNORE);
    return message;
  }

  Message Await(int from) {
    for (Naps naps;; naps.Take(false)) {
      Sent();
      if (auto message = Receive(from)) return std::move(*message);
    }
  }

  void AwaitSent() {
    for (Naps naps; !Sent();) naps.Take(false);
  }

 private:
  struct Letter {
    std::string bytes;
    MPI_Request request = MPI_REQUEST_NULL;
  };
  int rank_ = 0, ranks_ = 1;
  std::uint64_t bytes_ = 0;
  std::list<Letter> letters_;  // stay where they are until they are sent
};

// What the leader knows of another rank.
struct Member {
  std::string name;  // "rank 2 on node7"
  int threads = 1;
  bool gone = false;
  std::deque<Message> texts;                   // that nobody has asked for yet
  std::deque<std::vector<TileRange>> batches;  // that it has not sent back
};

PixelRect WindowOf(const Films& films) {
  const FilmAccumulator& film = films.film();
  return {film.x0(), film.y0(), film.x0() + film.width(), film.y0() + film.height()};
}

// The leader's side of one round.
class RoundOfLeader {
 public:
  RoundOfLeader(const RoundWork& work, Tasks& tasks, TaskWatcher& watcher, Films& films,
                Mail& mail, std::vector<Member>& members, HandOut& queue)
      : work_(work),
        tasks_(tasks),
        watcher_(watcher),
        films_(films),
        mail_(mail),
        members_(members),
        queue_(queue),
        rows_(films.Columns(), WindowOf(films)) {}

  /// Until all is done, or nothing is in flight after a stop. `on_trouble` is told of
  /// ranks that were interrupted (nothing) or have failed (why).
  template <class OnTrouble>
  void Run(OnTrouble&& on_trouble) {
    tasks_.BeginRound(work_);
    std::thread own([this] { RenderOwn(); });
    try {
      Serve(on_trouble);
    } catch (...) {
      ended_ = true;
      own.join();
      throw;
    }
    own.join();
    if (problem_) std::rethrow_exception(problem_);
  }
  /// Some did not answer in time after a signal.
  bool gave_up() const { return gave_up_; }

 private:
  bool Stopped() const { return ended_ || watcher_.Stopped(); }

  // The leader renders too; its threads take one tile after the other.
  void RenderOwn() {
    try {
      ParallelFor(static_cast<std::size_t>(MaxThreads()), [this](std::size_t) {
        while (!Stopped()) {
          const std::vector<TileRange> ranges = queue_.NextOne();
          if (ranges.empty()) return;
          const Clock::time_point start = Clock::now();
          tasks_.BringOn(ranges[0], watcher_, films_);
          if (tasks_.Done(ranges[0].tile) == ranges[0].end) {
            queue_.Took(ranges[0].samples, Since(start), 1);
          }
        }
      });
    } catch (...) {
      problem_ = std::current_exception();
      ended_ = true;
    }
    own_done_ = true;
  }

  template <class OnTrouble>
  void Serve(OnTrouble& on_trouble) {
    std::optional<Clock::time_point> signal, over;
    const auto is_late = [](const auto& since, double patience) {
      return since && Since(*since) > patience;
    };
    Naps naps;
    while (true) {
      bool moved = false;
      for (std::size_t r = 1; r < members_.size(); ++r) {
        moved |= Take(static_cast<int>(r), on_trouble);
        moved |= Give(static_cast<int>(r));
      }
      mail_.Sent();
      if (own_done_ && !InFlight()) return;
      if (!signal && watcher_.Interrupted()) signal = Clock::now();
      if (!over && watcher_.PutsDown()) over = Clock::now();
      if (own_done_ &&
          (is_late(signal, kPatienceSeconds) || is_late(over, kEndlessSeconds))) {
        gave_up_ = true;
        return;
      }
      naps.Take(moved);
    }
  }

  bool InFlight() const {
    return std::any_of(members_.begin(), members_.end(),
                       [](const Member& m) { return !m.batches.empty(); });
  }

  bool Give(int rank) {
    Member& member = members_[static_cast<std::size_t>(rank)];
    if (member.gone || Stopped() || member.batches.size() >= kMostBatches) return false;
    // Towards the end a second batch would wait for the first.
    if (!member.batches.empty() && queue_.left() < queue_.Team() * 2) return false;
    std::vector<TileRange> batch = queue_.Next(member.threads);
    if (batch.empty()) return false;
    std::string bytes;
    Write(WorkHead{work_, batch.size()}, bytes);
    for (const TileRange& range : batch) Write(range, bytes);
    for (const TileRange& range : batch) {
      if (range.begin > 0) rows_.Append(tasks_.rects()[range.tile], bytes);
    }
    mail_.Send(rank, kWork, std::move(bytes));
    member.batches.push_back(std::move(batch));
    return true;
  }

  template <class OnTrouble>
  bool Take(int rank, OnTrouble& on_trouble) {
    Member& member = members_[static_cast<std::size_t>(rank)];
    const std::optional<Message> message = mail_.Receive(rank);
    if (!message) return false;
    if (message->tag == kFailed) {
      member.gone = true;
      member.batches.clear();  // the leader's film has these tiles as they were
      on_trouble(member.name + ": " + message->bytes);
      return true;
    }
    LL_CHECK_EQ(int{message->tag}, int{kDone});
    LL_CHECK(!member.batches.empty());
    TakeBatch(member, message->bytes, on_trouble);
    return true;
  }

  template <class OnTrouble>
  void TakeBatch(Member& member, std::string_view bytes, OnTrouble& on_trouble) {
    const std::vector<TileRange> batch = std::move(member.batches.front());
    member.batches.pop_front();
    const auto head = Read<DoneHead>(bytes);
    LL_CHECK_EQ(head.ranges, batch.size());
    for (const TileRange& range : batch) {
      const auto done = Read<std::uint64_t>(bytes);
      LL_CHECK(done >= range.begin && done <= range.end);
      const PixelRect& rect = tasks_.rects()[range.tile];
      const std::size_t size = rows_.BytesOf(rect);
      LL_CHECK_GE(bytes.size(), size);
      rows_.Put(rect, bytes.substr(0, size));
      bytes.remove_prefix(size);
      tasks_.Put(range.tile, done);
    }
    tasks_.Credit(head.counts);
    queue_.Took(head.counts.samples, head.seconds, 1);
    watcher_.TaskDone();
    if (head.interrupted) on_trouble("");
  }

  const RoundWork work_;
  Tasks& tasks_;
  TaskWatcher& watcher_;
  Films& films_;
  Mail& mail_;
  std::vector<Member>& members_;
  HandOut& queue_;
  const TileRows rows_;
  std::exception_ptr problem_;
  std::atomic<bool> ended_{false}, own_done_{false};
  bool gave_up_ = false;
};

// Of a rank that serves: renders batches as they come. Its threads go from one to the
// next without waiting for each other.
class Workshop {
 public:
  explicit Workshop(const Service& service)
      : service_(service),
        signal_(service.stop),
        rows_(service.films.Columns(), WindowOf(service.films)),
        thread_([this] { Work(); }) {}
  ~Workshop() {
    End();
    thread_.join();
  }

  void Add(std::string_view bytes) {
    const auto head = Read<WorkHead>(bytes);
    Batch batch;
    for (std::size_t i = 0; i < head.ranges; ++i) {
      batch.ranges.push_back(Read<TileRange>(bytes));
    }
    for (const TileRange& range : batch.ranges) Unpack(range, bytes);
    const std::lock_guard lock(mutex_);
    if (batches_.empty()) {
      // Of another round, perhaps; nobody reads these now.
      service_.begin(head.round.first);
      service_.tasks.BeginRound(head.round);
      cpu_ = ProcessCpuSeconds();
    }
    batches_.push_back(std::move(batch));
    more_.notify_all();
  }

  /// The answer to the oldest batch, once it is done. Throws what a thread has thrown.
  std::optional<std::string> Finished() {
    const std::lock_guard lock(mutex_);
    if (problem_) std::rethrow_exception(problem_);
    if (batches_.empty() || batches_.front().done < batches_.front().ranges.size()) {
      return std::nullopt;
    }
    const Batch batch = std::move(batches_.front());
    batches_.pop_front();
    return Answer(batch);
  }

 private:
  struct Batch {
    std::vector<TileRange> ranges;
    std::size_t begun = 0, done = 0;
    double seconds = 0;
    RunCounts counts;
  };

  void Unpack(const TileRange& range, std::string_view& bytes) {
    service_.tasks.Put(range.tile, range.begin);
    const PixelRect& rect = service_.tasks.rects().at(range.tile);
    if (range.begin > 0) {
      rows_.Put(rect, bytes.substr(0, rows_.BytesOf(rect)));
      bytes.remove_prefix(rows_.BytesOf(rect));
    }
    LL_CHECK_EQ(service_.films.film().Samples(rect.x0, rect.y0), range.begin);
  }

  std::string Answer(const Batch& batch) {
    DoneHead head;
    head.counts = batch.counts;
    const double now = ProcessCpuSeconds();
    head.counts.cpu_seconds = now - std::exchange(cpu_, now);
    head.ranges = batch.ranges.size();
    head.seconds = batch.seconds;
    head.interrupted = signal_.Stopped();
    std::string bytes;
    Write(head, bytes);
    for (const TileRange& range : batch.ranges) {
      Write(std::uint64_t{service_.tasks.Done(range.tile)}, bytes);
      rows_.Append(service_.tasks.rects()[range.tile], bytes);
    }
    return bytes;
  }

  void End() {
    const std::lock_guard lock(mutex_);
    ended_ = true;
    more_.notify_all();
  }

  void Work() {
    try {
      ParallelFor(static_cast<std::size_t>(MaxThreads()), [this](std::size_t) {
        try {
          WorkInThread();
        } catch (...) {
          End();
          throw;
        }
      });
    } catch (...) {
      const std::lock_guard lock(mutex_);
      problem_ = std::current_exception();
    }
  }

  void WorkInThread() {
    std::unique_lock lock(mutex_);
    while (!ended_) {
      const auto open =
          std::find_if(batches_.begin(), batches_.end(),
                       [](const Batch& b) { return b.begun < b.ranges.size(); });
      if (open == batches_.end()) {
        more_.wait(lock);
        continue;
      }
      Batch& batch = *open;
      const TileRange range = batch.ranges[batch.begun++];
      lock.unlock();
      const Clock::time_point start = Clock::now();
      const RunCounts counts = service_.tasks.BringOn(range, signal_, service_.films);
      lock.lock();
      batch.counts.Add(counts);
      batch.seconds += Since(start);
      ++batch.done;
    }
  }

  const Service& service_;
  StopWatcher signal_;  // to this rank: ends its batches
  const TileRows rows_;
  std::mutex mutex_;  // of all that follows
  std::condition_variable more_;
  std::list<Batch> batches_;
  double cpu_ = 0;  // of the process, when it was last told
  bool ended_ = false;
  std::exception_ptr problem_;
  std::thread thread_;
};

class MpiCrew : public Crew {
 public:
  MpiCrew() : threads_(MaxThreads()) {
    char own[MPI_MAX_PROCESSOR_NAME] = {};
    int size = 0;
    MPI_Get_processor_name(own, &size);
    std::vector<char> hosts(sizeof(own) * static_cast<std::size_t>(ranks()));
    MPI_Allgather(own, sizeof(own), MPI_CHAR, hosts.data(), sizeof(own), MPI_CHAR,
                  MPI_COMM_WORLD);
    for (int r = 0; r < ranks(); ++r) {
      Member& member = members_.emplace_back();
      member.name = fmt::format("rank {} on {}", r,
                                &hosts[sizeof(own) * static_cast<std::size_t>(r)]);
    }
  }

  int rank() const override { return mail_.rank(); }
  int ranks() const override { return mail_.ranks(); }
  int threads() const override { return threads_; }
  bool Stopped() const override { return stopped_; }
  std::uint64_t bytes() const override { return mail_.bytes(); }
  bool gave_up() const { return gave_up_; }
  const std::string& Name(int rank) const {
    return members_[static_cast<std::size_t>(rank)].name;
  }

  void Agree(const std::string& what, const std::string& text,
             const Difference& difference) override {
    if (!leads()) {
      std::string bytes;
      Write(std::int32_t{MaxThreads()}, bytes);
      mail_.Send(0, kText, bytes + text);
      return mail_.AwaitSent();
    }
    threads_ = MaxThreads();
    for (int r = 1; r < ranks(); ++r) {
      const Message message = AwaitFromMember(r);
      std::string_view bytes = message.bytes;
      Member& member = members_[static_cast<std::size_t>(r)];
      member.threads = Read<std::int32_t>(bytes);
      threads_ += member.threads;
      const std::string differs = difference(text, std::string(bytes));
      if (differs.empty()) continue;
      throw InputError(fmt::format("{} {}:{}", member.name, what, differs));
    }
  }

  std::string Share(const std::string& bytes) override {
    if (!leads()) return mail_.Await(0).bytes;
    for (int r = 1; r < ranks(); ++r) mail_.Send(r, kShared, bytes);
    mail_.AwaitSent();
    return bytes;
  }

  Round Widen(const Round& round) const override {
    return {round.per_task, round.chunks * widen_};
  }

  void RunRound(const RoundWork& work, Tasks& tasks, TaskWatcher& watcher,
                Films& films) override {
    const Clock::time_point start = Clock::now();
    HandOut queue(tasks.Behind(work.limit), threads_, cost_);
    RoundOfLeader round(work, tasks, watcher, films, mail_, members_, queue);
    round.Run([this](const std::string& failure) {
      stopped_ = true;
      if (failure_.empty()) failure_ = failure;
    });
    cost_ = queue.cost();
    if (round.gave_up()) stopped_ = gave_up_ = true;
    if (Since(start) < kRoundSeconds / 2 && queue.LongestSeconds() < kLongestTask) {
      widen_ = std::min(2 * widen_, kMostWidened);
    }
  }

  void Dismiss() override {
    if (!failure_.empty()) throw RankFailure("error: " + failure_);
    for (int r = 1; r < ranks(); ++r) mail_.Send(r, kEnd, "");
    if (!gave_up_) mail_.AwaitSent();
  }

  void Serve(const Service& service) override {
    Workshop workshop(service);
    Naps naps;
    while (true) {
      const std::optional<Message> message = mail_.Receive(0);
      if (message && message->tag == kEnd) return;
      if (message) {
        LL_CHECK_EQ(int{message->tag}, int{kWork});
        workshop.Add(message->bytes);
      }
      const std::optional<std::string> answer = workshop.Finished();
      if (answer) mail_.Send(0, kDone, *answer);
      mail_.Sent();
      naps.Take(message || answer);
    }
  }

  /// Of a rank that has failed: tells the leader, who will end it.
  [[noreturn]] void Confess(const std::string& message) {
    mail_.Send(0, kFailed, message);
    for (Naps naps;; naps.Take(false)) mail_.Sent();
  }

 private:
  static constexpr double kLongestTask = HandOut::kBatchSeconds / 2;
  static constexpr std::uint32_t kMostWidened = 1024;

  Message AwaitFromMember(int r) {
    for (Naps naps;; naps.Take(false)) {
      // Whoever has failed is heard at once, even while another one takes its time.
      for (int other = 1; other < ranks(); ++other) {
        auto message = mail_.Receive(other);
        if (!message) continue;
        if (message->tag == kFailed) {
          throw RankFailure("error: " + Name(other) + ": " + message->bytes);
        }
        LL_CHECK_EQ(int{message->tag}, int{kText});
        members_[static_cast<std::size_t>(other)].texts.push_back(std::move(*message));
      }
      auto& texts = members_[static_cast<std::size_t>(r)].texts;
      if (!texts.empty()) {
        Message message = std::move(texts.front());
        texts.pop_front();
        return message;
      }
      mail_.Sent();
    }
  }

  Mail mail_;
  std::vector<Member> members_;  // by rank; the leader's own first
  int threads_;
  double cost_ = 0;  // processor seconds of a sample
  std::uint32_t widen_ = 1;
  std::atomic<bool> stopped_{false};
  std::string failure_;  // the first one
  bool gave_up_ = false;
};

class MpiRanks : public Ranks {
 public:
  Crew& crew() override { return crew_; }

  std::string WhoDiffers(int number) override {
    std::vector<int> numbers(static_cast<std::size_t>(crew_.ranks()));
    MPI_Allgather(&number, 1, MPI_INT, numbers.data(), 1, MPI_INT, MPI_COMM_WORLD);
    for (int r = 1; r < crew_.ranks(); ++r) {
      if (crew_.leads() && numbers[static_cast<std::size_t>(r)] != number) {
        return crew_.Name(r);
      }
    }
    return "";
  }

  // A rank that has not answered will not come to the end either.
  int Leave(int exit_code) override {
    if (crew_.gave_up()) MPI_Abort(MPI_COMM_WORLD, exit_code);
    MPI_Finalize();
    return exit_code;
  }

  int Fail(int exit_code, const std::string& message) override {
    if (!crew_.leads()) crew_.Confess(message);
    if (crew_.ranks() > 1) MPI_Abort(MPI_COMM_WORLD, exit_code);
    MPI_Finalize();
    return exit_code;
  }

 private:
  MpiCrew crew_;
};

}  // namespace

std::unique_ptr<Ranks> JoinRanks(int* argc, char*** argv) {
  int provided = 0;
  MPI_Init_thread(argc, argv, MPI_THREAD_FUNNELED, &provided);
  LL_CHECK_GE(provided, int{MPI_THREAD_FUNNELED});
  return std::make_unique<MpiRanks>();
}

}  // namespace lanelight
