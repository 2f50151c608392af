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

// Stages [begin, end) of the plan, where they have anything to do.
void RunStages(Wave& wave, const Plan& plan, std::size_t begin, std::size_t end,
               StageClock* clock) {
  for (std::size_t i = begin; i < end; ++i) {
    const PlannedStage& planned = plan.stages[i];
    if (wave.queue(planned.stage.input).size == 0) continue;
    wave.lanes = {};
    planned.kernel(wave);
    if (clock) clock->Finish(i, wave.lanes.items, wave.lanes.vectors);
  }
}

}  // namespace

std::uint32_t SamplesTogether(const CompiledScene& scene, const Plan& plan) {
  constexpr std::uint32_t kMost = 16;
  const std::uint32_t together = std::min(kMost, plan.wavefront);
  return scene.strategy.pairs == Pairs::kAntithetic ? together & ~1u : together;
}

bool Drive(Wavefront& wavefront, const Plan& plan, const TileWork& work,
           const SampleBuffer& buffer, StageClock* clock, const TaskWatcher* watcher) {
  LL_CHECK_LE(work.together, plan.wavefront);  // they are generated at once, or never
  wavefront.Reset();
  Wave& wave = wavefront.wave();
  wave.work = work;
  wave.buffer = buffer;
  if (clock) {
    clock->FinishPart(TaskPart::kSetUp, std::uint64_t{work.num_pixels} * work.samples);
  }
  while (!wave.work.Done() || wave.queue(QueueId::kScattered).size > 0) {
    StartWave(wave);
    if (clock) clock->StartWave();
    RunStages(wave, plan, 0, plan.first_repeated, clock);
    for (std::uint32_t c = 0; c < wave.run->candidates; ++c) {
      RunStages(wave, plan, plan.first_repeated, plan.last_repeated, clock);
    }
    RunStages(wave, plan, plan.last_repeated, plan.stages.size(), clock);
    if (watcher != nullptr && watcher->PutsDown()) return false;
  }
  return true;
}

}  // namespace lanelight
