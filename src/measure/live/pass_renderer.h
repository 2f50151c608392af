// One strategy that renders a view, in passes: one film that goes on, with the bits that
// `lanelight render` would give it.
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "src/base/image/pixel_rect.h"
#include "src/render/wave/run_state.h"
#include "src/measure/live/view.h"
#include "src/render/estimate/estimate.h"

namespace lanelight::live {

/// Counts are known of the tiles of tasks alone. Each is spread over the cells that the
/// tile covers; tiles begin at multiples of kCell, and later ones are small.
class CostMap {
 public:
  static constexpr int kCell = 16;  // pixels of a side

  CostMap(int width, int height);

  /// Safe for one call at a time.
  void Add(const PixelRect& tile, const RunCounts& counts);

  /// Returns rays per sample of the pixel's cell; 0 where no sample has been counted.
  double RaysPerSample(int x, int y) const;
  /// Rays that look for the nearest surface: the mean number of segments of a path.
  double SegmentsPerSample(int x, int y) const;

 private:
  struct Cell {
    double samples = 0, closest = 0, shadow = 0;
  };
  const Cell& At(int x, int y) const;

  int columns_;
  std::vector<Cell> cells_;
};

/// Who may interrupt a pass for a moment.
class PassObserver {
 public:
  virtual ~PassObserver() = default;
  /// Called often, from any thread: whether Observe is due, true until it is called.
  virtual bool IsDue() const = 0;
  /// Called by the rendering thread while no task is in flight, so that films may be
  /// read.
  virtual void Observe() = 0;
};

/// The error after some number of samples per pixel.
struct EstimateSnapshot {
  std::uint64_t spp = 0;
  double seconds = 0;  // processor time until then
  ErrorEstimate error;
};

class PassRenderer {
 public:
  /// Throws InputError if the scene does not take the strategy.
  PassRenderer(const LiveScene& live_scene, View view, const Strategy& strategy);

  /// Renders until all pixels have `spp` samples, or `stop` is set; then some pixels may
  /// have more than others. A later pass goes on from there.
  void Pass(std::uint64_t spp, PassObserver& observer, const std::atomic<bool>& stop);
  /// The correction by a control variate, where there is one, knows all samples so far.
  void Fit();

  const View& view() const { return view_; }
  const Strategy& strategy() const { return job_.scene.strategy; }
  const Plan& plan() const { return job_.plan; }
  const FilmAccumulator& film() const { return film_; }
  const CostMap& cost() const { return cost_; }
  const RunRecord& record() const { return record_; }
  /// Returns the costs of all passes, by stage and part of tasks.
  const std::vector<StageProfile>& stages() const { return stages_; }
  /// Errors, estimated now and then, the last one some time ago.
  const std::vector<EstimateSnapshot>& snapshots() const { return snapshots_; }
  /// Samples per pixel that all pixels have.
  std::uint64_t spp() const { return spp_; }
  /// Processor time of its rendering, training included, looks and pictures not.
  double cpu_seconds() const { return record_.counts.cpu_seconds - observed_seconds_; }
  /// Samples per pixel and second of the last passes; 0 before the first.
  double rate() const { return rate_; }
  /// Returns the note of the training in one line; empty without training.
  const std::string& training() const { return record_.training.note; }
  std::size_t Bytes() const;

 private:
  class PassCheckpointer;

  void EstimateIfDue(const std::atomic<bool>& stop);

  View view_;
  const Job job_;
  FilmAccumulator film_;
  bool has_control_;  // planes of samples that films have from their beginning
  CostMap cost_;
  RunRecord record_;
  std::vector<StageProfile> stages_;
  std::vector<EstimateSnapshot> snapshots_;
  std::uint64_t spp_ = 0;
  double observed_seconds_ = 0, estimate_seconds_ = 0, rate_ = 0;
};

}  // namespace lanelight::live
