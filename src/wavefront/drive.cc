#include "src/wavefront/drive.h"

#include <chrono>

namespace lanelight {

namespace {

std::int64_t Now() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
             std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

// Between waves: what scattered is intersected next; everything else is consumed.
void StartWave(Wave& wave) {
  std::swap(wave.queue(QueueId::kActive), wave.queue(QueueId::kScattered));
  for (int i = 0; i < kNumQueues; ++i) {
    const QueueId id = static_cast<QueueId>(i);
    if (id != QueueId::kFree && id != QueueId::kActive) wave.queues[i].size = 0;
  }
}

}  // namespace

void Drive(Wavefront& wavefront, const Plan& plan, const TileWork& work,
           const SampleBuffer& buffer, std::vector<StageCounters>& counters) {
  wavefront.Reset();
  Wave& wave = wavefront.wave();
  wave.work = work;
  wave.buffer = buffer;
  const bool profile = !counters.empty();
  while (!wave.work.Done() || wave.queue(QueueId::kScattered).size > 0) {
    StartWave(wave);
    for (std::size_t i = 0; i < plan.stages.size(); ++i) {
      const PlannedStage& planned = plan.stages[i];
      if (wave.queue(planned.stage.input).size == 0) continue;
      if (!profile) {
        planned.kernel(wave);
        continue;
      }
      wave.lanes = {};
      const std::int64_t start = Now();
      planned.kernel(wave);
      StageCounters& c = counters[i];
      c.nanoseconds += Now() - start;
      ++c.calls;
      c.items += wave.lanes.items;
      c.lane_slots += wave.lanes.vectors;
    }
  }
}

}  // namespace lanelight
