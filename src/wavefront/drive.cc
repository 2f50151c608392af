#include "src/wavefront/drive.h"

#include <utility>

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

// A template, so that without a clock nothing of it is there.
template <bool kTimed>
void Loop(Wave& wave, const Plan& plan, StageClock* clock) {
  while (!wave.work.Done() || wave.queue(QueueId::kScattered).size > 0) {
    StartWave(wave);
    if constexpr (kTimed) clock->StartWave();
    for (std::size_t i = 0; i < plan.stages.size(); ++i) {
      const PlannedStage& planned = plan.stages[i];
      if (wave.queue(planned.stage.input).size == 0) continue;
      if constexpr (kTimed) wave.lanes = {};
      planned.kernel(wave);
      if constexpr (kTimed) clock->Finish(i, wave.lanes.items, wave.lanes.vectors);
    }
  }
}

}  // namespace

void Drive(Wavefront& wavefront, const Plan& plan, const TileWork& work,
           const SampleBuffer& buffer, StageClock* clock) {
  wavefront.Reset();
  Wave& wave = wavefront.wave();
  wave.work = work;
  wave.buffer = buffer;
  if (clock == nullptr) return Loop<false>(wave, plan, nullptr);
  clock->FinishPart(TaskPart::kSetUp, std::uint64_t{work.num_pixels} * work.samples);
  Loop<true>(wave, plan, clock);
}

}  // namespace lanelight
