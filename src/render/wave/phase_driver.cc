#include "src/render/wave/phase_driver.h"

namespace lanelight {
namespace {

// Runs the stages [first, last) whose queues have paths.
void RunStages(Wave& wave, const Phase& phase, std::size_t first, std::size_t last,
               StageClock* clock) {
  for (std::size_t i = first; i < last; ++i) {
    const PlannedStage& planned = phase.stages[i];
    if (phase.in_waves && wave.queue(planned.stage.input).size == 0) continue;
    wave.lanes = {};
    planned.kernel(wave);
    if (clock == nullptr) continue;
    clock->Finish(phase.first_row + i, wave.lanes.items, wave.lanes.vectors);
  }
}

// Runs all stages once, those of light candidates once for each candidate.
void RunOnce(Wave& wave, const Phase& phase, StageClock* clock) {
  const bool repeats = phase.first_repeated < phase.last_repeated;
  RunStages(wave, phase, 0, phase.last_repeated, clock);
  for (std::uint32_t i = 1; repeats && i < wave.run->candidates; ++i) {
    RunStages(wave, phase, phase.first_repeated, phase.last_repeated, clock);
  }
  RunStages(wave, phase, phase.last_repeated, phase.stages.size(), clock);
}

}  // namespace

bool RunPhase(Wave& wave, const Phase& phase, StageClock* clock,
              const TaskWatcher* watcher) {
  if (!phase.in_waves) {
    RunOnce(wave, phase, clock);
    return true;
  }
  while (wave.HasWork()) {
    wave.BeginWave();
    const bool bounces = clock != nullptr && phase.id == PhaseId::kPaths;
    if (clock != nullptr) clock->StartWave();
    if (bounces) clock->StartBounces(wave);
    RunOnce(wave, phase, clock);
    if (bounces) clock->EndBounces(wave);
    if (watcher != nullptr && watcher->IsCancelled()) return false;
  }
  return true;
}

}  // namespace lanelight
