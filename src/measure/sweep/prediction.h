// Predicts the time and disk space of a sweep from short renders of some cells.
#pragma once

#include <atomic>
#include <string>
#include <vector>

#include "src/measure/sweep/sweep_file.h"

namespace lanelight {

struct CellPrediction {
  bool done = false;      // exists already; the other members are not set
  bool measured = false;  // by a probe of the same scene and strategy
  double seconds = 0;     // wall clock on this machine; NaN if unknown
  double bytes = 0;       // of its files; NaN if unknown
  std::string message;    // why it will fail; may be empty
};

struct SweepPrediction {
  std::vector<CellPrediction> cells;         // of all cells, in order
  std::size_t probes = 0, combinations = 0;  // of scene and strategy
};

/// Renders at most `max_probes` probes of different scenes and strategies. For
/// combinations without a probe, the relative cost of a strategy is that on other scenes.
/// The first cell of a scene includes the time of loading and building. Ends early once
/// `stop` is set.
SweepPrediction Predict(const Sweep& sweep, const std::string& out, int max_probes,
                        const std::atomic<bool>& stop);

/// Returns a table of the cells, and sums.
std::string PredictionText(const Sweep& sweep, const SweepPrediction& prediction);

}  // namespace lanelight
