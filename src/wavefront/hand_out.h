// How the tiles of a round are dealt out to ranks: in batches that take about
// kBatchSeconds each, smaller ones towards the end, so that nobody waits long for the
// last. Decisions only; it does not matter to the image who renders what.
#pragma once

#include <cstdint>
#include <mutex>
#include <utility>
#include <vector>

namespace lanelight {

/// Samples of the pixels of one tile.
struct TileRange {
  std::uint32_t tile = 0;
  std::uint64_t begin = 0, end = 0;  // samples of a pixel
  std::uint64_t samples = 0;         // of all its pixels together
};

class HandOut {
 public:
  /// Few messages, and a signal is answered soon.
  static constexpr double kBatchSeconds = 0.2;

  /// `threads`: of all ranks together. `cost`: processor seconds of a sample; 0 = not
  /// known yet.
  HandOut(std::vector<TileRange> ranges, int threads, double cost)
      : ranges_(std::move(ranges)), threads_(threads), cost_(cost) {}

  /// The next batch for a rank of so many threads; nothing once all are given away. Safe
  /// from several threads.
  std::vector<TileRange> Next(int threads);
  /// So many samples took so many seconds of each of `threads` threads.
  void Took(std::uint64_t samples, double seconds, int threads);

  /// One of them, for a thread of this process.
  std::vector<TileRange> NextOne();

  std::size_t left() const;
  std::size_t Team() const { return static_cast<std::size_t>(threads_); }
  /// What the longest range is expected to take.
  double LongestSeconds() const;
  double cost() const;

 private:
  mutable std::mutex mutex_;
  std::vector<TileRange> ranges_;
  std::size_t next_ = 0;
  int threads_;
  double cost_;
};

}  // namespace lanelight
