// Distributes the samples of a round over threads: a tile gets one range of samples after
// the other, in turn with all other tiles. If there are few tiles for the threads, ranges
// of one tile run at the same time; those that end early wait for the ones before them,
// so the image does not depend on the order. Other ranks may take tiles out and put
// tiles in while threads work.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "src/base/image/pixel_rect.h"
#include "src/render/schedule/schedule.h"
#include "src/render/wave/run_state.h"
#include "src/render/wave/task_watcher.h"
#include "src/render/wave/tiles.h"

namespace lanelight {

/// A tile that this process renders.
struct TileProgress {
  std::uint64_t tile = 0;  // index into the tiles of the run, the same on all ranks
  std::uint64_t done = 0;  // samples of each of its pixels
};

/// Samples per pixel of the tile with the fewest, and of the tile with the most.
struct TileLevels {
  std::uint64_t minimum = ~std::uint64_t{0}, maximum = 0;
  void Add(const TileLevels& others);
};
TileLevels LevelsOf(const std::vector<TileProgress>& tiles);

class Scheduler {
 public:
  /// Owns all of these tiles, without samples.
  explicit Scheduler(std::vector<PixelRect> tiles)
      : tiles_(std::move(tiles)), done_(tiles_.size()), begun_(tiles_.size()) {}

  /// Returns all tiles, including those of other ranks.
  const std::vector<PixelRect>& tiles() const { return tiles_; }

  struct Limits {
    std::uint32_t ranges_per_tile = 1;  // that run at the same time
    bool may_adopt = false;             // tiles may come while ranges are in flight
  };
  /// Starts a round, while no range is in flight. Ranges that were cancelled are
  /// scheduled again.
  void Begin(const Round& round, const Limits& limits);

  // Safe from several threads:
  /// Returns the next range to render; nothing once all have begun, or the watcher has
  /// stopped the round. Waits if a range must not begin before others have ended.
  std::optional<SampleRange> Next(const TaskWatcher& watcher);
  /// Takes the samples of a rendered range: calls merge(samples) with them and with those
  /// that have waited for them, or moves them out of `samples` until it is their turn.
  using Merge = std::function<void(TaskSamples& samples)>;
  void FinishRange(const SampleRange& range, TaskSamples& samples, const Merge& merge);
  /// Begins no more ranges; threads that wait in Next() return.
  void Cancel();

  /// Returns the tiles that this process owns, with their samples.
  std::vector<TileProgress> Snapshot() const;
  /// Owns exactly these tiles from here on; between rounds.
  void Resume(const std::vector<TileProgress>& tiles);

  /// Gives up tiles without a range in flight that lack at most so many samples, summed
  /// over tiles and pixels, and returns them.
  std::vector<TileProgress> Release(std::uint64_t samples);
  /// Owns these tiles in addition.
  void AddTiles(const std::vector<TileProgress>& tiles);
  /// Returns the samples that these tiles lack to `end` samples per pixel.
  std::uint64_t MissingSamples(const std::vector<TileProgress>& tiles,
                               std::uint64_t end) const;

 private:
  /// Marks a tile that another rank owns.
  static constexpr std::uint64_t kNotOwned = ~std::uint64_t{0};

  const std::vector<PixelRect> tiles_;
  mutable std::mutex mutex_;  // of all that follows
  std::condition_variable ended_;
  std::vector<std::uint64_t> done_, begun_;  // samples per pixel by tile, or kNotOwned
  Round round_;
  Limits limits_;
  std::size_t next_ = 0;  // tile whose turn it is
  std::size_t in_flight_ = 0;
  bool cancelled_ = false;
  std::map<std::pair<std::size_t, std::uint64_t>, TaskSamples> early_;  // tile, first
};

}  // namespace lanelight
