#include "src/run/tile_queue.h"

#include <algorithm>

namespace lanelight {

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
      return TileRange{tile, begin, begun_[tile]};
    }
    if (!left) break;
    ended_.wait(lock);
  }
  return std::nullopt;
}

void TileQueue::Ended(const TileRange& range, TaskSamples& samples, const Merge& merge) {
  std::unique_lock lock(mutex_);
  std::uint64_t& done = done_[range.tile];
  if (range.begin != done) {
    early_.emplace(std::pair(range.tile, range.begin), std::exchange(samples, {}));
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
  ended_.notify_all();
}

void TileQueue::Stop() {
  const std::lock_guard lock(mutex_);
  stopped_ = true;
  ended_.notify_all();
}

}  // namespace lanelight
