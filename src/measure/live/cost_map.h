// What samples cost by places of the image: rays, counted by tasks.
#pragma once

#include <cstdint>
#include <vector>

#include "src/base/image/pixel_rect.h"
#include "src/render/wave/run_state.h"

namespace lanelight::live {

/// Counts are known of the tiles of tasks alone. Each is spread over the cells that the
/// tile covers; tiles begin at multiples of kCell, and later ones are small.
class CostMap {
 public:
  static constexpr int kCell = 16;  // pixels of a side

  CostMap(int width, int height);

  /// Safe for one call at a time.
  void Add(const PixelRect& tile, const RunCounts& counts);

  /// Returns the mean of the pixel's cell; 0 if nothing has been counted yet.
  double RaysPerSample(int x, int y) const;
  /// Rays that look for the nearest surface: the mean number of segments of a path.
  double SegmentsPerSample(int x, int y) const;

 private:
  struct Cell {
    double samples = 0, closest = 0, shadow = 0;
  };
  const Cell& At(int x, int y) const;

  int columns_;
  std::vector<Cell> cells_;
};

}  // namespace lanelight::live
