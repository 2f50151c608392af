// In which order threads bring the tiles of a round to their samples. Each tile gets one
// range after the other, in turn with all others. Where there are few tiles for the
// threads, ranges of the same tile run at once; those that end early wait for the ones
// before them, so that the image does not depend on it. Tiles may be given away to
// another rank, and come from there, while threads are at work.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "src/render/run/held_tiles.h"
#include "src/render/wave/task_watcher.h"
#include "src/render/wave/workspace.h"

namespace lanelight {

/// Samples per pixel of a tile that another rank has.
inline constexpr std::uint64_t kNotHeld = ~std::uint64_t{0};

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
    bool open = false;           // tiles may come for as long as ranges are in flight
  };

  /// `done`: samples per pixel that tiles have; kept up to date for as long as this
  /// lives. Tiles that are to be left alone have kNotHeld.
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
  /// Takes tiles out of which no range is in flight, as many as lack no more than so many
  /// samples of all their pixels together. `tiles`: their places.
  std::vector<HeldTile> Give(std::uint64_t samples, const std::vector<PixelRect>& tiles);
  /// A tile is there from now on.
  void Take(const HeldTile& tile);

 private:
  std::mutex mutex_;  // of all that follows
  std::condition_variable ended_;
  std::vector<std::uint64_t>& done_;
  std::vector<std::uint64_t> begun_;
  const Limits limits_;
  std::size_t next_ = 0;
  std::size_t in_flight_ = 0;
  bool stopped_ = false;
  std::map<std::pair<std::size_t, std::uint64_t>, TaskSamples> early_;  // tile, begin
};

}  // namespace lanelight
