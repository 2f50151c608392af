#include "src/render/run/tile_queue.h"

#include <algorithm>

namespace lanelight {
namespace {

// At once: 27 to 200 MB of films, which no rank is busy with for longer than the time
// that a signal leaves it.
constexpr std::uint64_t kMostPixelsGiven = 1 << 18;

}  // namespace

std::optional<TileRange> TileQueue::Next(const TaskWatcher& watcher) {
  const std::uint64_t ahead = std::uint64_t{limits_.per_task} * limits_.at_once;
  std::unique_lock lock(mutex_);
  while (!stopped_ && !watcher.Stopped()) {
    bool left = false;
    for (std::size_t i = 0; i < begun_.size(); ++i) {
      const std::size_t tile = (next_ + i) % begun_.size();
      const std::uint64_t begin = begun_[tile];
      if (begin >= limits_.end) continue;
      left = true;
      if (begin >= done_[tile] + ahead) continue;
      next_ = tile + 1;
      begun_[tile] = std::min(limits_.end, begin + limits_.per_task);
      ++in_flight_;
      return TileRange{tile, begin, begun_[tile]};
    }
    if (!left && !(limits_.open && in_flight_ > 0)) break;
    ended_.wait(lock);
  }
  return std::nullopt;
}

void TileQueue::Ended(const TileRange& range, TaskSamples& samples, const Merge& merge) {
  std::unique_lock lock(mutex_);
  std::uint64_t& done = done_[range.tile];
  if (range.begin != done) {
    early_.emplace(std::pair(range.tile, range.begin), std::exchange(samples, {}));
    --in_flight_;  // there is the one that it waits for
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

std::vector<HeldTile> TileQueue::Give(std::uint64_t samples,
                                      const std::vector<PixelRect>& tiles) {
  std::vector<HeldTile> given;
  std::uint64_t pixels = 0;
  const std::lock_guard lock(mutex_);
  for (std::size_t tile = 0; tile < done_.size(); ++tile) {
    const std::uint64_t done = done_[tile];
    if (done >= limits_.end || begun_[tile] != done) continue;
    const std::uint64_t lacks = (limits_.end - done) * tiles[tile].pixels();
    if (lacks > samples) continue;
    samples -= lacks;
    pixels += tiles[tile].pixels();
    if (pixels > kMostPixelsGiven) break;
    given.push_back({tile, done});
    done_[tile] = begun_[tile] = kNotHeld;
  }
  return given;
}

void TileQueue::Take(const HeldTile& tile) {
  const std::lock_guard lock(mutex_);
  done_[tile.tile] = begun_[tile.tile] = tile.done;
  ended_.notify_all();
}

void TileQueue::Stop() {
  const std::lock_guard lock(mutex_);
  stopped_ = true;
  ended_.notify_all();
}

}  // namespace lanelight
