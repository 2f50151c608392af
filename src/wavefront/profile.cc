#include "src/wavefront/profile.h"

#include "kernels/simd/target.h"

namespace lanelight {

std::vector<StageProfile> EmptyProfiles(const Plan& plan) {
  std::vector<StageProfile> profiles;
  for (const PlannedStage& planned : plan.stages) {
    StageProfile profile;
    profile.name = planned.stage.name;
    for (Field f : plan.live_fields) {
      profile.bytes_per_item +=
          4.0 * (planned.stage.reads.Has(f) + planned.stage.writes.Has(f));
    }
    profiles.push_back(profile);
  }
  return profiles;
}

void AddCounts(Wavefront& wavefront, const std::vector<StageCounters>& counters,
               RunResult& result) {
  const Wave& wave = wavefront.wave();
  result.rays_closest += wave.rays_closest;
  result.rays_shadow += wave.rays_shadow;
  result.health.nan += wave.bad.nan;
  result.health.infinite += wave.bad.infinite;
  result.health.negative += wave.bad.negative;
  result.wavefront_bytes += wavefront.bytes();
  for (std::size_t i = 0; i < counters.size(); ++i) {
    const StageCounters& c = counters[i];
    StageProfile& stage = result.stages[i];
    stage.calls += c.calls;
    stage.items += c.items;
    stage.lane_slots += c.lane_slots * static_cast<std::uint64_t>(CurrentLanes());
    stage.seconds += static_cast<double>(c.nanoseconds) * 1e-9;
  }
}

}  // namespace lanelight
