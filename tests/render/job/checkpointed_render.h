// Renders of jobs with checkpoints, in one process, and what they come to as bits.
#pragma once

#include <cstring>
#include <string>
#include <vector>

#include "src/base/core/parallel.h"
#include "src/base/image/atomic_file.h"
#include "src/render/job/merge.h"
#include "src/render/job/output.h"
#include "src/render/job/render.h"
#include "tests/base/image/temporary_folder.h"

namespace lanelight {

/// All of an image and of its statistics, without times.
struct Outcome {
  std::vector<std::string> planes;
  std::string report;

  bool operator==(const Outcome&) const = default;
};

inline Outcome OutcomeOf(const FilmAccumulator& film, const RunResult& result) {
  Outcome out;
  for (const ExrPlane& plane : FilmPlanes(film, 1)) {
    out.planes.emplace_back(plane.name);
    out.planes.emplace_back(reinterpret_cast<const char*>(plane.values.data()),
                            plane.values.size() * sizeof(float));
  }
  nlohmann::json report = {
      {"samples", result.samples},           {"closest", result.rays_closest},
      {"shadow", result.rays_shadow},        {"invalid", result.health.Total()},
      {"looks", result.num_checks},          {"pilot", result.training.samples},
      {"note", result.training.note},        {"roulette", Name(result.roulette)},
      {"error", ToJson(EstimateError(film))}};
  if (result.control) {
    report["control"] = {result.control->coefficient, result.control->correlation};
  }
  out.report = report.dump();
  return out;
}

struct CheckpointedRender {
  std::string scene;
  RenderSettings settings;
  int threads = 2;
  CheckpointSettings checkpoint = {};
  /// Interrupts the render after so many tasks; 0: never.
  int tasks = 0;
};

// Stops a run once it has begun so many tasks.
class TaskCounter : public Checkpointer {
 public:
  TaskCounter(Checkpointer& checkpointer, int tasks, std::atomic<bool>& stop)
      : checkpointer_(checkpointer), left_(tasks), stop_(stop) {}
  bool Restore(RunState& state) override { return checkpointer_.Restore(state); }
  bool IsDue() const override {
    if (left_ > 0 && --left_ == 0) stop_ = true;
    return checkpointer_.IsDue();
  }
  void Save(RunState& state) override { checkpointer_.Save(state); }

 private:
  Checkpointer& checkpointer_;
  mutable std::atomic<int> left_;
  std::atomic<bool>& stop_;
};

inline Outcome RenderKept(const CheckpointedRender& r) {
  const ThreadLimit limit(r.threads);
  const Job job = PrepareJob(r.scene, r.settings);
  FilmAccumulator film = MakeFilm(job);
  RunOptions options = RunOptionsOf(job);
  if (!r.checkpoint.Any())
    return OutcomeOf(film, Run(job.scene, job.plan, options, film));
  std::vector<std::string> problems;
  Checkpoint checkpoint(job, r.checkpoint, HeadJson(job, r.scene, false),
                        [&](const std::string& p) { problems.push_back(p); });
  std::atomic<bool> stop = false;
  TaskCounter counter(checkpoint, r.tasks, stop);
  options.checkpointer = &counter;
  options.stop = &stop;
  options.tiles = checkpoint.tiles();
  const RunResult result = Run(job.scene, job.plan, options, film);
  checkpoint.Finish();
  CHECK(problems.empty());
  CHECK(checkpoint.kept());
  return OutcomeOf(film, result);
}

inline Outcome MergedOutcome(const std::vector<std::string>& paths) {
  MergedRender merged = MergeStates(paths);
  CHECK(merged.missing == 0);
  merged.film->FitControl();
  return OutcomeOf(*merged.film, ResultOf(merged));
}

}  // namespace lanelight
