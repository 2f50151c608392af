// In which order threads bring the tiles of a round to their samples. Each tile gets one
// range after the other, in turn with all others. Where there are few tiles for the
// threads, ranges of the same tile run at once; those that end early wait for the ones
// before them, so that the image does not depend on it.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "src/wave/task_watcher.h"
#include "src/wave/workspace.h"

namespace lanelight {

/// Samples of the pixels of one tile.
struct TileRange {
  std::size_t tile = 0;
  std::uint64_t begin = 0, end = 0;  // samples of a pixel
};

class TileQueue {
 public:
  struct Limits {
    std::uint64_t end = 0;       // samples per pixel of all tiles
    std::uint32_t per_task = 1;  // of a range
    std::uint32_t at_once = 1;   // ranges of a tile
  };

  /// `done`: samples per pixel that tiles have; kept up to date for as long as this
  /// lives.
  TileQueue(std::vector<std::uint64_t>& done, const Limits& limits)
      : done_(done), begun_(done), limits_(limits) {}

  // Safe from several threads:
  /// The next range to render; nothing once all have begun, or the watcher has stopped
  /// it. Waits where ranges may not begin before others have ended.
  std::optional<TileRange> Next(const TaskWatcher& watcher);
  /// A range has been rendered: calls merge(samples) with its samples, and with those
  /// that have waited for it, or takes them from `samples` until it is their turn.
  using Merge = std::function<void(TaskSamples& samples)>;
  void Ended(const TileRange& range, TaskSamples& samples, const Merge& merge);
  /// No more ranges are to begin, and no thread waits any longer.
  void Stop();

 private:
  std::mutex mutex_;  // of all that follows
  std::condition_variable ended_;
  std::vector<std::uint64_t>& done_;
  std::vector<std::uint64_t> begun_;
  const Limits limits_;
  std::size_t next_ = 0;
  bool stopped_ = false;
  std::map<std::pair<std::size_t, std::uint64_t>, TaskSamples> early_;  // tile, begin
};

}  // namespace lanelight
