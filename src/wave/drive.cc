#include "src/wave/drive.h"

#include <algorithm>
#include <utility>

#include "src/core/check.h"

namespace lanelight {
namespace {

// Between waves: what scattered is intersected next; everything else is consumed.
void StartWave(Wave& wave) {
  std::swap(wave.queue(QueueId::kActive), wave.queue(QueueId::kScattered));
  for (int i = 0; i < kNumQueues; ++i) {
    const QueueId id = static_cast<QueueId>(i);
    if (id != QueueId::kFree && id != QueueId::kActive) wave.queues[i].size = 0;
  }
}

}  // namespace

std::uint32_t SamplesTogether(const PreparedScene& scene, const Plan& plan) {
  constexpr std::uint32_t kMost = 16;
  const std::uint32_t together = std::min(kMost, plan.wavefront);
  return scene.strategy.pairs == Pairs::kAntithetic ? together & ~1u : together;
}

bool Drive(Wave& wave, const Plan& plan, const DriveTask& task, StageClock* clock,
           const TaskWatcher* watcher) {
  const TileWork& work = task.work;
  LL_CHECK_LE(work.together, plan.wavefront);  // they are generated at once, or never
  wave.Reset();
  wave.work = work;
  wave.buffer = task.buffer;
  if (clock) {
    clock->FinishPart(TaskPart::kSetUp, std::uint64_t{work.num_pixels} * work.samples);
  }
  const auto& stages = task.seen_lights ? plan.seen_stages : plan.stages;
  const std::size_t first_row = task.seen_lights ? plan.FirstSeenRow() : 0;
  while (!wave.work.Done() || wave.queue(QueueId::kScattered).size > 0) {
    StartWave(wave);
    if (clock) clock->StartWave();
    std::uint32_t candidates = wave.run->candidates;  // that are still to be made
    for (std::size_t i = 0; i < stages.size(); ++i) {
      const PlannedStage& planned = stages[i];
      if (wave.queue(planned.stage.input).size > 0) {
        wave.lanes = {};
        planned.kernel(wave);
        if (clock) clock->Finish(first_row + i, wave.lanes.items, wave.lanes.vectors);
      }
      if (i + 1 == plan.last_repeated && --candidates > 0) i = plan.first_repeated - 1;
    }
    if (watcher != nullptr && watcher->Cancelled()) return false;
  }
  return true;
}

}  // namespace lanelight
