// What bench_checkpoint measures, one function each. All print a table and return the
// same figures.
#pragma once

#include <array>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "src/render/job/checkpoint.h"
#include "src/render/job/job.h"

namespace lanelight::bench {

struct CheckpointBench {
  std::string scene, folder = ".";
  std::array<int, 2> resolution = {1920, 1080}, tile_resolution = {640, 360};
  int repeats = 5;
  std::uint64_t spp = 16;  // of the film that is kept and merged
  std::vector<int> parts = {1, 4, 16, 64};
  std::vector<std::uint64_t> tile_spp = {1, 4, 16, 64};

  std::string Path(const std::string& name) const { return folder + "/bench-" + name; }
};

/// The scene at another size.
Job JobOf(const CheckpointBench& bench, std::array<int, 2> resolution, std::uint64_t spp);
nlohmann::json HeadOf(const Job& job);
/// Never called by a bench that goes well.
void ThrowProblem(const std::string& problem);

/// A film and its columns, for comparing and filling.
struct BenchFilm {
  explicit BenchFilm(const Job& job);
  std::size_t Bytes();
  bool SameAs(BenchFilm& other);

  FilmAccumulator film;
};

/// Passes everything on to a checkpoint, except that `keep` is called instead of Keep.
class WatchedCheckpointer : public Checkpointer {
 public:
  WatchedCheckpointer(Checkpoint& checkpoint, std::function<void(RunState&)> keep)
      : checkpoint_(checkpoint), keep_(std::move(keep)) {}
  bool Restore(RunState& state) override { return checkpoint_.Restore(state); }
  bool IsDue() const override { return checkpoint_.IsDue(); }
  void Save(RunState& state) override { keep_(state); }

 private:
  Checkpoint& checkpoint_;
  std::function<void(RunState&)> keep_;
};

/// Throws unless a render that is interrupted and resumed, and one in parts that are
/// merged, have the bits of one that is neither.
void VerifyResumeAndMerge(const CheckpointBench& bench);

/// The pause of a checkpoint, its processor time and bytes.
nlohmann::json MeasurePause(const CheckpointBench& bench);
/// Renders with a checkpoint every second beside renders without.
nlohmann::json MeasureSlowdown(const CheckpointBench& bench);
/// Merging the same film from more and more parts.
nlohmann::json MeasureMerging(const CheckpointBench& bench);
/// Renders in the tiles of a checkpoint beside renders in ordinary ones.
nlohmann::json MeasureTiles(const CheckpointBench& bench);

}  // namespace lanelight::bench
