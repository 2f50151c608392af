// Runs a plan: distributes (tile x sample range) tasks over threads, each with its own
// wavefront, and gathers the film.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "src/core/hardware_counters.h"
#include "src/core/untouched.h"
#include "src/image/accumulator.h"
#include "src/image/pixel_rect.h"
#include "src/path/wave.h"
#include "src/wavefront/plan.h"
#include "src/wavefront/rank_group.h"
#include "src/wavefront/run_state.h"

namespace lanelight {

struct Progress {
  double fraction = 0;  // of the planned samples, or of the time budget
  double seconds = 0;   // since the start of rendering
  std::uint64_t samples = 0;
};

/// Most samples per pixel.
inline constexpr std::uint64_t kMostSamplesPerPixel = std::uint64_t{1} << 40;
/// Sample indices in kernels have 32 bits: so many later they begin again, under another
/// seed. Whole turns of the longest randomisations (src/prepare/groups.h).
inline constexpr std::uint64_t kSamplesPerSeed = std::uint64_t{1} << 31;

/// What a profile gathers beside the times of stages.
struct ProfileOptions {
  bool counters = false;         // of the processor (src/core/hardware_counters.h)
  std::size_t trace_events = 0;  // most stage calls that a thread writes down; 0: none
};

/// How many samples the image will have must not change what is learned before it.
inline constexpr std::uint64_t kPilotSpp = 32;
inline constexpr std::uint64_t kLeastPilot = 1u << 16;  // samples, of small images

struct RunOptions {
  std::uint64_t spp = 0;  // samples per pixel; 0: until something else ends the render
  /// Time budget of all of Run, 0 = none. Every pixel gets a sample, unless paths do not
  /// end (src/wavefront/patience.h).
  double seconds = 0;
  /// If set, the render looks at itself at certain numbers of samples per pixel
  /// (src/wavefront/schedule.h), and ends once this returns `done` or less: how many the
  /// image is estimated to need, of which `done` are in its film; below 0: no number will
  /// do.
  std::function<double(const FilmAccumulator& film, std::uint64_t done)> samples_needed;
  std::uint64_t seed = 0;
  std::function<void(const Progress&)> on_progress;  // about 10 times a second
  /// Finish the samples in flight; those that take longer are put down.
  const std::atomic<bool>* stop = nullptr;
  bool profile = true;       // time every stage call
  ProfileOptions profiling;  // if `profile`
  /// roulette=efficiency keeps its rule even where the pilot passes prefer another.
  bool keep_roulette = false;
  /// Renders these windows of the image only, all of the same width and height, up to 64.
  /// The film is then a strip in which they lie side by side, in order, from (0, 0) on.
  /// They have the samples that a render of the whole image gives these pixels.
  std::vector<PixelRect> windows;
  /// Renders these tiles of the image only, disjoint; empty: all of it.
  std::vector<PixelRect> tiles;
  /// What pilot passes are sized for; 0: kPilotSpp samples of every pixel of the image,
  /// and kLeastPilot at least. With decide=pilot DecidedBy (src/wavefront/training.h), or
  /// what the time budget is enough for.
  std::uint64_t planned_samples = 0;
  /// Keeps the state while the run goes on; null: nobody does.
  RunKeeper* keeper = nullptr;
  /// Who renders, without `windows`; null: this process alone.
  RankGroup* group = nullptr;
};

struct StageProfile {
  std::string name;
  std::uint64_t calls = 0, items = 0, lane_slots = 0;  // lane_slots = vectors * lanes
  double seconds = 0;                                  // processor time of all threads
  double bytes_per_item = 0;                           // columns read + written
  // Of these; the columns that the plan has and the stage declares.
  double bytes_read = 0, bytes_written = 0;
  // The processor's counters, over the calls in which they were read.
  std::uint64_t counted_items = 0;
  CounterValues counted{};
  /// items / lane_slots in [0, 1]
  double Occupancy() const { return lane_slots ? double(items) / double(lane_slots) : 0; }
};

/// What a task does besides running stages. Items are samples.
enum class TaskPart : int {
  kSetUp,   // lists the pixels of the tile, empties the wavefront
  kCopies,  // adds up the copies of paths that split
  kSeen,    // light that the camera sees itself, with seen-lights=apart
  kFilm,    // adds the samples to the film
  kCount
};
inline constexpr int kNumTaskParts = static_cast<int>(TaskPart::kCount);
/// "task set-up", "sum of copies", "seen lights", "film".
const char* Name(TaskPart part);

/// One stage call (row: its index in RunResult::stages) or part of a task (row: number of
/// stages + TaskPart), in ticks of src/core/clock.h.
struct TraceEvent {
  std::uint64_t begin = 0, end = 0;
  std::uint32_t row = 0, items = 0;
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
  int looks = 0;  // at which the error was compared with the target
  int ranks = 1;  // processes; profiles and memory are of this one
  std::uint64_t bytes_between_ranks = 0;
  std::vector<StageProfile> stages;      // in execution order
  std::vector<StageProfile> parts;       // of tasks, by TaskPart
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

/// Renders into `film`, without samples: its size must match the crop window of the
/// scene, or the strip of options.windows, its groups the strategy
/// (src/prepare/groups.h).
RunResult Run(const CompiledScene& scene, const Plan& plan, const RunOptions& options,
              FilmAccumulator& film);

/// The same for a worker of options.group: as the leader wants it, until it lets it go.
/// `film` has the worker's part of the image alone; of `options`, what says how much to
/// render and the keeper are the leader's business.
void ServeRun(const CompiledScene& scene, const Plan& plan, const RunOptions& options,
              FilmAccumulator& film);

}  // namespace lanelight
