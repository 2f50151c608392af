// One render among many of a compiled scene: what sweeps and studies run.
#pragma once

#include <atomic>
#include <functional>

#include "src/estimate/estimate.h"
#include "src/render/job.h"

namespace lanelight {

/// In what the renders of a compiled scene may differ.
struct CellSettings {
  Strategy strategy;
  std::uint64_t spp = 0;  // these three as in Job
  double seconds = 0;
  ErrorTarget target;
  std::uint64_t seed = 0;
};

/// Makes the job the cell's. Throws InputError if the scene does not take the strategy;
/// then the job is to be set to another cell.
void SetCell(Job& job, const CellSettings& cell);

struct CellRun {
  FilmAccumulator film;
  RunResult result;
  double cpu_seconds =
      0;  // of the whole process; the wall clock counts other programs too
};

/// Renders the job as it is set.
CellRun RunCell(const Job& job, const std::function<void(const Progress&)>& on_progress,
                const std::atomic<bool>* stop);

}  // namespace lanelight
