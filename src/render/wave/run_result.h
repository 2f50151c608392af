// The result of a run, and the profile of its stages.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "src/base/core/aligned.h"
#include "src/base/core/hardware_counters.h"
#include "src/render/films/accumulator.h"
#include "src/render/wave/run_state.h"
#include "src/vocabulary/path/stage.h"
#include "src/vocabulary/strategy/choices.h"

namespace lanelight {

/// Groups of stages and task parts, in which a profile adds up their times (GroupOf,
/// src/render/wave/profile.h).
// clang-format off
enum class ProfileGroup : int {
  kCamera, kSampling, kIntersect, kMedia, kSurface, kTexture, kLights, kShade, kShadow,
  kQueues, kFilm, kVisibleLights, kReuse, kLightPaths, kTraining, kOutside, kCount
};
struct ProfileGroupInfo {
  const char *name, *meaning = "";  // the meaning, where the name does not say it
};
/// The groups, by ProfileGroup.
inline constexpr ProfileGroupInfo kProfileGroups[] = {
    {"camera"}, {"sampling"}, {"intersect"}, {"media"}, {"surface"}, {"texture"},
    {"lights"}, {"shade"}, {"shadow"}, {"queues"}, {"film"},
    {"visible lights", "more rays at edges of visible lights (seen-lights=apart)"},
    {"path reuse", "connects paths of a block of pixels (reuse=block)"},
    {"light subpaths", "paths that start at lights (light-paths=splats)"},
    {"training", "trial runs and training passes before the image"},
    {"outside", "task set-up, scheduler, progress and idle threads"}};
// clang-format on
static_assert(std::size(kProfileGroups) == std::size_t(ProfileGroup::kCount));
inline const ProfileGroupInfo& InfoOf(ProfileGroup group) {
  return kProfileGroups[int(group)];
}

struct StageProfile {
  std::string name;
  std::optional<StageRole> role;  // of a stage; none: a part of a task
  ProfileGroup group = ProfileGroup::kOutside;
  std::string material;  // kind of material, of stages that shade one kind; else empty
  std::uint64_t calls = 0, items = 0, lane_slots = 0;  // lane_slots = vectors * lanes
  double seconds = 0;                                  // processor time of all threads
  double bytes_per_item = 0;                           // columns read + written
  // Parts of bytes_per_item: live columns that the stage declares.
  double bytes_read = 0, bytes_written = 0;
  // The processor's counters, over the calls in which they were read.
  std::uint64_t counted_items = 0;
  CounterValues counted{};
  /// items / lane_slots in [0, 1]
  double Occupancy() const { return lane_slots ? double(items) / double(lane_slots) : 0; }
};

/// Costs of rays after `i` scattering events and of all stages of their waves, as
/// doubles, for the i-th of RunResult::bounces; the last one also has all later bounces.
/// A wave with paths of several depths counts for each of them by its number of paths.
enum BounceCost {
  kBounceSeconds,
  kBounceClosest,
  kBounceShadow,
  kBounceItems,
  kBounceSlots,
  kNumBounceCosts
};
using BounceProfile = std::array<double, kNumBounceCosts>;
inline constexpr std::size_t kMaxBounces = 16;

/// The parts of a task besides its stages. Items are samples.
enum class TaskPart : int {
  kSetUp,          // lists the pixels of the tile, empties the wavefront
  kCopies,         // adds up the copies of paths that split
  kSharing,        // adds samples to the pixels that they count for
  kVisibleLights,  // directly visible lights, with seen-lights=apart
  kFilm,           // adds the samples to the film
  kCount
};
inline constexpr int kNumTaskParts = int(TaskPart::kCount);
/// Returns the part's name in a profile.
const char* Name(TaskPart part);

/// One stage call (row: its index in RunResult::stages) or part of a task (row: number of
/// stages + TaskPart), in ticks of src/base/core/clock.h.
struct TraceEvent {
  std::uint64_t begin = 0, end = 0;
  std::uint32_t row = 0, items = 0, vectors = 0;
};

struct ThreadTrace {
  UntouchedVector<TraceEvent> events;  // in order of time, without overlap
  std::uint64_t dropped = 0;           // for which there was no room
};

struct RunTrace {
  std::uint64_t start = 0;  // ticks when the run began
  double seconds_per_tick = 0;
  std::vector<ThreadTrace> threads;
};

enum class StopReason { kSamples, kTime, kTarget, kInterrupted, kHopeless };
/// "samples", "time", "target", "interrupted", "hopeless".
const char* Name(StopReason reason);

/// Counts are of all ranks: seconds of this Run, processor seconds of all threads.
struct RunResult : RunCounts {
  StopReason stop_reason = StopReason::kSamples;
  int num_checks = 0;  // at which the error was compared with the target
  int ranks = 1;       // processes; profiles and memory are of this one
  std::uint64_t bytes_between_ranks = 0;
  std::vector<StageProfile> stages;      // in execution order
  std::vector<StageProfile> parts;       // of tasks, by TaskPart
  std::vector<BounceProfile> bounces;    // with ProfileOptions::bounces
  RunTrace trace;                        // with ProfileOptions::trace_events
  bool counters = false;                 // of the processor were read
  int counter_error = 0;                 // errno for which (some of) them are missing
  double waiting_seconds = 0;            // of tasks, while others had the processor
  bool stopped_early = false;            // by RunOptions::stop
  std::optional<ControlReport> control;  // of control variates that are fitted
  std::size_t wavefront_bytes = 0;       // all wavefronts and sample buffers together
  std::size_t bytes_in_flight = 0;       // live columns of the paths of one wavefront
  // Its time is part of `seconds`, its samples and rays are not part of the counts.
  TrainingOutcome training;
  Roulette roulette = Roulette::kThroughput;  // that the image was rendered with
};

}  // namespace lanelight
