// Options of a run: how much of a plan is rendered, and how.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <vector>

#include "src/base/image/pixel_rect.h"
#include "src/render/wave/run_state.h"

namespace lanelight {

class RankGroup;

struct Progress {
  double fraction = 0;  // of the planned samples, or of the time budget
  double seconds = 0;   // since the start of rendering
  std::uint64_t samples = 0;
};

/// Most samples per pixel.
inline constexpr std::uint64_t kMaxSamplesPerPixel = std::uint64_t{1} << 40;
/// Sample indices in kernels have 32 bits: so many later they begin again, under another
/// seed. Whole turns of the longest randomisations (src/scene/prepare/parameters.h).
inline constexpr std::uint64_t kSamplesPerSeed = std::uint64_t{1} << 31;

/// Data that a profile gathers besides stage times.
struct ProfileOptions {
  bool counters = false;         // of the processor (src/base/core/hardware_counters.h)
  bool bounces = false;          // the cost of each bounce
  std::size_t trace_events = 0;  // most stage calls that a thread writes down; 0: none
};

/// Samples per pixel, and least samples of an image, that training is sized for: what is
/// learned must not depend on the number of samples of the image.
inline constexpr std::uint64_t kTrainingSpp = 32;
inline constexpr std::uint64_t kMinTrainingSamples = 1u << 16;

struct RunOptions {
  std::uint64_t spp = 0;  // samples per pixel; 0: until something else ends the render
  /// Time budget of all of Run in seconds, 0 = none. Every pixel gets a sample, unless
  /// paths do not end (TimeLimit).
  double seconds = 0;
  /// If set, this is called at certain numbers of samples per pixel
  /// (src/render/schedule/schedule.h). It returns the number that the image is estimated
  /// to need; `done` of them are in its film. The render ends if that is `done` or less;
  /// below 0, no number is enough.
  std::function<double(const FilmAccumulator& film, std::uint64_t done)> samples_needed;
  std::uint64_t seed = 0;
  int threads = 0;                                   // at most; 0: all cores
  std::function<void(const Progress&)> on_progress;  // about 10 times a second
  std::function<void()> on_training;  // before a trial run or another training begins
  /// Receives the film between tasks, as often as that costs next to nothing
  /// (src/render/run/run_watch.h). Not called in a group.
  std::function<void(const FilmAccumulator& film)> on_film;
  /// Receives the pixels that have new samples, on the thread that has added them; it may
  /// read these pixels only.
  std::function<void(const FilmAccumulator& film, const PixelRect& place)> on_tile;
  /// Receives the counts of each finished task, with its processor seconds if `profile`;
  /// one call at a time.
  std::function<void(const PixelRect& tile, const RunCounts&)> on_task;
  /// Set to end the render: samples in flight are finished, unless they take too long.
  const std::atomic<bool>* stop = nullptr;
  bool profile = true;       // time every stage call
  ProfileOptions profiling;  // if `profile`
  /// Renders these windows of the image only, all of the same width and height, up to 64.
  /// The film is then a strip in which they lie side by side, in order, from (0, 0) on.
  /// They have the samples that a render of the whole image gives these pixels.
  std::vector<PixelRect> windows;
  /// Renders these tiles of the image only, disjoint; empty: all of it.
  std::vector<PixelRect> tiles;
  /// Samples that training passes are sized for; 0: kTrainingSpp samples of every pixel,
  /// at least kMinTrainingSamples; with decide=pilot DecidedBy
  /// (src/render/train/training.h), or what the time budget allows.
  std::uint64_t planned_samples = 0;
  /// Keeps the state during the run; may be null.
  Checkpointer* checkpointer = nullptr;
  /// The ranks that render, without `windows`; null: this process alone.
  RankGroup* group = nullptr;
};

}  // namespace lanelight
