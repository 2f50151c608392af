#include "src/render/wave/profile.h"

#include <algorithm>

namespace lanelight {
namespace {

void Add(const StageCounters& counters, const StageTotals& totals, int lanes,
         StageProfile& row) {
  row.calls += counters.calls;
  row.items += counters.items;
  row.lane_slots += counters.lane_slots * std::uint64_t(lanes);
  row.seconds += totals.seconds;
  row.counted_items += totals.counted_items;
  for (std::size_t i = 0; i < row.counted.size(); ++i) {
    row.counted[i] += totals.counted[i];
  }
}

}  // namespace

const char* Name(TaskPart part) {
  static constexpr const char* kNames[] = {"task set-up", "sum of split paths",
                                           "shared samples", "visible lights", "film"};
  return kNames[int(part)];
}

ProfileGroup GroupOf(PhaseId phase, const Stage& stage) {
  using enum ProfileGroup;
  static constexpr ProfileGroup kOfRoles[] = {
      // in the order of StageRole
      kCamera, kSampling, kIntersect, kMedia,  kQueues, kLights,   kSurface, kTexture,
      kLights, kLights,   kShade,     kShadow, kQueues, kTraining, kFilm,    kReuse};
  static_assert(std::size(kOfRoles) == std::size_t(StageRole::kBlock) + 1);
  const bool edges = phase == PhaseId::kFindEdges || phase == PhaseId::kVisibleLights;
  if (edges) return kVisibleLights;
  if (phase == PhaseId::kLightPaths) return kLightPaths;
  if (stage.role == StageRole::kRecord) {
    if (stage.needs.Has(Feature::kLightPaths)) return kLightPaths;
    if (stage.needs.HasAny({Feature::kReuse, Feature::kReuseGlossy})) return kReuse;
  }
  return kOfRoles[std::size_t(stage.role)];
}

std::vector<StageProfile> EmptyProfiles(const Plan& plan) {
  std::vector<StageProfile> profiles;
  for (const Phase& phase : plan.phases) {
    for (const PlannedStage& planned : phase.stages) {
      StageProfile& profile = profiles.emplace_back();
      profile.name = std::string(InfoOf(phase.id).prefix) + planned.stage.name;
      profile.role = planned.stage.role;
      profile.group = GroupOf(phase.id, planned.stage);
      if (planned.stage.input >= QueueId::kShade) {
        const int kind = int(planned.stage.input) - int(QueueId::kShade);
        profile.material = FeatureMeaning(ShadeFeature(ShadeKind(kind)));
      }
      for (Field f : plan.live_fields) {
        profile.bytes_read += 4.0 * planned.stage.reads.Has(f);
        profile.bytes_written += 4.0 * planned.stage.writes.Has(f);
      }
      profile.bytes_per_item = profile.bytes_read + profile.bytes_written;
    }
  }
  return profiles;
}

std::vector<StageProfile> EmptyParts() {
  std::vector<StageProfile> parts(kNumTaskParts);
  for (int i = 0; i < kNumTaskParts; ++i) parts[i].name = Name(static_cast<TaskPart>(i));
  for (const TaskPart part : {TaskPart::kCopies, TaskPart::kSharing, TaskPart::kFilm}) {
    parts[int(part)].group = ProfileGroup::kFilm;
  }
  parts[int(TaskPart::kVisibleLights)].group = ProfileGroup::kVisibleLights;
  return parts;
}

void AddStages(const std::vector<StageProfile>& more, std::vector<StageProfile>& sum) {
  for (const StageProfile& m : more) {
    const auto same = [&](const StageProfile& s) { return s.name == m.name; };
    const auto found = std::ranges::find_if(sum, same);
    if (found == sum.end()) {
      sum.push_back(m);
      continue;
    }
    found->calls += m.calls;
    found->items += m.items;
    found->lane_slots += m.lane_slots;
    found->seconds += m.seconds;
  }
}

void AddCounts(Wavefront& wavefront, StageClock* clock, int lanes, RunResult& result) {
  result.wavefront_bytes += wavefront.bytes();
  if (clock == nullptr) return;
  const std::size_t stages = result.stages.size();
  for (std::size_t i = 0; i < clock->rows().size(); ++i) {
    Add(clock->rows()[i], clock->totals()[i], lanes,
        i < stages ? result.stages[i] : result.parts[i - stages]);
  }
  const BounceProfile scale = {1, 1, 1, 1, double(lanes)};
  result.bounces.resize(clock->bounces().size());
  for (std::size_t i = 0; i < result.bounces.size(); ++i) {
    for (std::size_t k = 0; k < scale.size(); ++k) {
      result.bounces[i][k] += scale[k] * clock->bounces()[i][k];
    }
  }
  result.waiting_seconds +=
      double(clock->ticks()) * result.trace.seconds_per_tick - clock->cpu_seconds();
  for (const StageProfile& s : result.stages) result.counters |= s.counted_items > 0;
  if (clock->counter_error() != 0) result.counter_error = clock->counter_error();
  const std::uint64_t dropped = clock->dropped();
  result.trace.threads.push_back({clock->ReleaseEvents(), dropped});
}

}  // namespace lanelight
