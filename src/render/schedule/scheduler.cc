#include "src/render/schedule/scheduler.h"

#include <algorithm>

namespace lanelight {
namespace {

// Pixels released at once. Their films take 27 to 200 MB, which a rank sends in less time
// than a signal leaves it.
constexpr std::uint64_t kMaxPixelsReleased = 1 << 18;

}  // namespace

void TileLevels::Add(const TileLevels& others) {
  minimum = std::min(minimum, others.minimum);
  maximum = std::max(maximum, others.maximum);
}

TileLevels LevelsOf(const std::vector<TileProgress>& tiles) {
  TileLevels levels;
  for (const TileProgress& tile : tiles) levels.Add({tile.done, tile.done});
  return levels;
}

void Scheduler::Begin(const Round& round, const Limits& limits) {
  const std::lock_guard lock(mutex_);
  round_ = round;
  limits_ = limits;
  begun_ = done_;
  next_ = in_flight_ = 0;
  cancelled_ = false;
  early_.clear();
}

std::optional<SampleRange> Scheduler::Next(const TaskWatcher& watcher) {
  std::unique_lock lock(mutex_);
  const std::uint64_t ahead = std::uint64_t{round_.per_task} * limits_.ranges_per_tile;
  while (!cancelled_ && !watcher.IsStopped()) {
    bool left = false;
    for (std::size_t i = 0; i < begun_.size(); ++i) {
      const std::size_t tile = (next_ + i) % begun_.size();
      const std::uint64_t first = begun_[tile];
      if (first >= round_.end) continue;
      left = true;
      if (first >= done_[tile] + ahead) continue;
      next_ = tile + 1;
      begun_[tile] = std::min(round_.end, first + round_.per_task);
      ++in_flight_;
      return SampleRange{tile, first, std::uint32_t(begun_[tile] - first)};
    }
    if (!left && !(limits_.may_adopt && in_flight_ > 0)) break;
    ended_.wait(lock);
  }
  return std::nullopt;
}

void Scheduler::FinishRange(const SampleRange& range, TaskSamples& samples,
                            const Merge& merge) {
  std::unique_lock lock(mutex_);
  std::uint64_t& done = done_[range.tile];
  if (range.first != done) {
    early_.emplace(std::pair(range.tile, range.first), std::exchange(samples, {}));
    --in_flight_;  // the range that it waits for is in flight
    return;
  }
  TaskSamples waiting;
  // Until `done` has moved on, no other thread comes to this point with this tile.
  for (TaskSamples* next = &samples; next != nullptr;) {
    lock.unlock();
    merge(*next);
    lock.lock();
    done += next->count;
    const auto early = early_.extract({range.tile, done});
    if (early) waiting = std::move(early.mapped());
    next = early ? &waiting : nullptr;
  }
  --in_flight_;
  ended_.notify_all();
}

void Scheduler::Cancel() {
  const std::lock_guard lock(mutex_);
  cancelled_ = true;
  ended_.notify_all();
}

std::vector<TileProgress> Scheduler::Snapshot() const {
  const std::lock_guard lock(mutex_);
  std::vector<TileProgress> owned;
  for (std::size_t tile = 0; tile < done_.size(); ++tile) {
    if (done_[tile] != kNotOwned) owned.push_back({tile, done_[tile]});
  }
  return owned;
}

void Scheduler::Resume(const std::vector<TileProgress>& tiles) {
  std::ranges::fill(done_, kNotOwned);
  AddTiles(tiles);
}

std::vector<TileProgress> Scheduler::Release(std::uint64_t samples) {
  std::vector<TileProgress> released;
  std::uint64_t pixels = 0;
  const std::lock_guard lock(mutex_);
  for (std::size_t tile = 0; tile < done_.size(); ++tile) {
    const std::uint64_t done = done_[tile];
    if (done >= round_.end || begun_[tile] != done) continue;
    const std::uint64_t lacks = (round_.end - done) * tiles_[tile].pixels();
    if (lacks > samples) continue;
    samples -= lacks;
    pixels += tiles_[tile].pixels();
    if (pixels > kMaxPixelsReleased) break;
    released.push_back({tile, done});
    done_[tile] = begun_[tile] = kNotOwned;
  }
  return released;
}

void Scheduler::AddTiles(const std::vector<TileProgress>& tiles) {
  const std::lock_guard lock(mutex_);
  for (const TileProgress& tile : tiles) done_[tile.tile] = begun_[tile.tile] = tile.done;
  ended_.notify_all();
}

std::uint64_t Scheduler::MissingSamples(const std::vector<TileProgress>& tiles,
                                        std::uint64_t end) const {
  std::uint64_t samples = 0;
  for (const TileProgress& tile : tiles) {
    samples += (end - std::min(end, tile.done)) * tiles_[tile.tile].pixels();
  }
  return samples;
}

}  // namespace lanelight
