#include "src/ranks/leader_round.h"

#include <algorithm>
#include <chrono>
#include <optional>
#include <thread>
#include <utility>

#include "src/core/check.h"
#include "src/core/parallel.h"
#include "src/ranks/batch_bytes.h"
#include "src/ranks/naps.h"
#include "src/wavefront/run_clock.h"

namespace lanelight {
namespace {

using Clock = std::chrono::steady_clock;

// Batches that a rank has at most: it begins with the next one while the last one
// travels.
constexpr std::size_t kMostBatches = 2;
// After a signal mpirun leaves a second; for those who do not answer until then nobody
// waits.
constexpr double kPatienceSeconds = 0.6;
// The same after the time is over, where paths of other ranks do not end.
constexpr double kEndlessSeconds = 10;

bool IsLate(const std::optional<Clock::time_point>& since, double patience) {
  return since && SecondsSince(*since) > patience;
}

}  // namespace

LeaderRound::LeaderRound(const RoundWork& work, Tasks& tasks, TaskWatcher& watcher,
                         Films& films, Mail& mail, std::vector<Member>& members,
                         HandOut& queue)
    : work_(work),
      tasks_(tasks),
      watcher_(watcher),
      films_(films),
      mail_(mail),
      members_(members),
      queue_(queue),
      rows_(films.Columns(), WindowOf(films)) {}

void LeaderRound::Run(const OnTrouble& on_trouble) {
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

// The leader renders too; its threads take one tile after the other.
void LeaderRound::RenderOwn() {
  try {
    ParallelFor(static_cast<std::size_t>(MaxThreads()),
                [this](std::size_t) { RenderInThread(); });
  } catch (...) {
    problem_ = std::current_exception();
    ended_ = true;
  }
  own_done_ = true;
}

void LeaderRound::RenderInThread() {
  while (!Stopped()) {
    const std::vector<TileRange> ranges = queue_.NextOne();
    if (ranges.empty()) return;
    const Clock::time_point start = Clock::now();
    tasks_.BringOn(ranges[0], watcher_, films_);
    if (tasks_.Done(ranges[0].tile) == ranges[0].end) {
      queue_.Took(ranges[0].samples, SecondsSince(start), 1);
    }
  }
}

void LeaderRound::Serve(const OnTrouble& on_trouble) {
  std::optional<Clock::time_point> signal, over;
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
        (IsLate(signal, kPatienceSeconds) || IsLate(over, kEndlessSeconds))) {
      gave_up_ = true;
      return;
    }
    naps.Take(moved);
  }
}

bool LeaderRound::InFlight() const {
  return std::any_of(members_.begin(), members_.end(),
                     [](const Member& m) { return !m.batches.empty(); });
}

bool LeaderRound::Give(int rank) {
  Member& member = members_[static_cast<std::size_t>(rank)];
  if (member.gone || Stopped() || member.batches.size() >= kMostBatches) return false;
  // Towards the end a second batch would wait for the first.
  if (!member.batches.empty() && queue_.left() < queue_.Team() * 2) return false;
  std::vector<TileRange> batch = queue_.Next(member.threads);
  if (batch.empty()) return false;
  mail_.Send(rank, Tag::kWork, Pack(batch));
  member.batches.push_back(std::move(batch));
  return true;
}

std::string LeaderRound::Pack(const std::vector<TileRange>& batch) const {
  std::string bytes;
  Write(WorkHead{work_, batch.size()}, bytes);
  for (const TileRange& range : batch) Write(range, bytes);
  for (const TileRange& range : batch) {
    if (range.begin > 0) rows_.Append(tasks_.rects()[range.tile], bytes);
  }
  return bytes;
}

bool LeaderRound::Take(int rank, const OnTrouble& on_trouble) {
  Member& member = members_[static_cast<std::size_t>(rank)];
  const std::optional<Message> message = mail_.Receive(rank);
  if (!message) return false;
  if (message->tag == Tag::kFailed) {
    member.gone = true;
    member.batches.clear();  // the leader's film has these tiles as they were
    on_trouble(member.name + ": " + message->bytes);
    return true;
  }
  CheckTag(*message, Tag::kDone);
  LL_CHECK(!member.batches.empty());
  TakeBatch(member, message->bytes, on_trouble);
  return true;
}

void LeaderRound::TakeBatch(Member& member, std::string_view bytes,
                            const OnTrouble& on_trouble) {
  const std::vector<TileRange> batch = std::move(member.batches.front());
  member.batches.pop_front();
  const auto head = Read<DoneHead>(bytes);
  LL_CHECK_EQ(head.ranges, batch.size());
  for (const TileRange& range : batch) Unpack(range, bytes);
  tasks_.Credit(head.counts);
  queue_.Took(head.counts.samples, head.seconds, 1);
  watcher_.TaskDone();
  if (head.interrupted) on_trouble("");
}

void LeaderRound::Unpack(const TileRange& range, std::string_view& bytes) {
  const auto done = Read<std::uint64_t>(bytes);
  LL_CHECK(done >= range.begin && done <= range.end);
  const PixelRect& rect = tasks_.rects()[range.tile];
  const std::size_t size = rows_.BytesOf(rect);
  LL_CHECK_GE(bytes.size(), size);
  rows_.Put(rect, bytes.substr(0, size));
  bytes.remove_prefix(size);
  tasks_.Put(range.tile, done);
}

}  // namespace lanelight
