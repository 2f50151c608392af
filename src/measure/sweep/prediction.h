// What a sweep will take, from short renders of a few of its cells.
#pragma once

#include <atomic>
#include <string>
#include <vector>

#include "src/measure/sweep/sweep_file.h"

namespace lanelight {

struct CellPrediction {
  bool done = false;      // already there: nothing of what follows
  bool measured = false;  // by a probe of its own scene and strategy; else by others'
  double seconds = 0;     // wall clock on this machine; NaN: not known
  double bytes = 0;       // of its files; NaN: not known
  std::string message;    // why it will fail; empty: it will not
};

struct SweepPrediction {
  std::vector<CellPrediction> cells;         // of all cells, in order
  std::size_t probes = 0, combinations = 0;  // rendered; of scene and strategy
};

/// Renders at most `max_probes` probes, of different scenes and strategies, in windows
/// that are spread over the image. Where there are fewer probes than combinations, a
/// strategy is taken to cost by what factor it did on other scenes. Seconds of loading
/// and building count once per scene, for its first cell. Ends early once `stop` is set.
SweepPrediction Predict(const Sweep& sweep, const std::string& out, int max_probes,
                        const std::atomic<bool>& stop);

/// A table of the cells, and the sums.
std::string PredictionText(const Sweep& sweep, const SweepPrediction& prediction);

}  // namespace lanelight
