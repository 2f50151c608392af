// Pilot passes: short renders whose samples never enter the image, from which the
// roulettes that split learn what paths are worth.
//   adjoint     one pass that records: brightness of the pixels, values of the cells
//   efficiency  the same; then the fixed point of variance and cost by passes with
//               splitting, and a comparison of the strategy with no roulette and with
//               roulette on the throughput, all with the same pixels and random numbers
// They take about 4 percent of the planned samples and stop growing at 240 000 paths.
// Results do not depend on the number of threads: sums run in the order of the samples,
// costs are counted in rays.
#pragma once

#include <string>

#include "src/prepare/tables.h"
#include "src/wavefront/run.h"

namespace lanelight {

struct PilotOutcome {
  Roulette roulette = Roulette::kThroughput;  // that the image is to be rendered with
  std::string note;                           // what was found, one line
  std::uint64_t samples = 0, rays = 0;
};

struct PilotOptions {
  std::uint64_t planned_samples = 0;  // of the image
  bool keep_roulette = false;         // even where another would be more efficient
  const std::atomic<bool>* stop = nullptr;
};

/// Runs the passes that the roulette of the scene's strategy needs and fills
/// tables.path_values. `plan` and `run` are those of the image.
PilotOutcome RunPilot(const CompiledScene& scene, const Plan& plan,
                      const RunParameters& run, const PilotOptions& options,
                      StrategyTables& tables);

}  // namespace lanelight
