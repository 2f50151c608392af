// A training pass, from which light-paths=splats learns where subpaths from infinity
// start: in rounds, each of which starts as the one before has learned.
#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <memory>
#include <numeric>
#include <vector>

#include "src/base/core/parallel.h"
#include "src/render/plan/plan_features.h"
#include "src/render/train/training.h"
#include "src/render/wave/light_paths.h"
#include "src/render/wave/task_watcher.h"
#include "src/render/wave/tiles.h"
#include "src/render/wave/wavefront.h"
#include "src/scene/compiled/scene.h"
#include "src/scene/compiled/view.h"
#include "src/scene/prepare/emission_guide.h"
#include "src/scene/prepare/prepared_scene.h"

namespace lanelight {
namespace {

constexpr std::uint32_t kRounds = 3, kPathsPerTask = 1024;
// Subpaths of a round: about 1 percent of the planned samples in all.
constexpr std::uint64_t kPlanned = 300, kMinPaths = 4096, kMaxPaths = 65536;

class EmissionTraining {
 public:
  explicit EmissionTraining(const TrainingContext& context)
      : scene_(context.scene),
        plan_(MakePlan(scene_, Options(context))),
        tables_(context.tables),
        stop_(context.options.stop),
        run_(MakeRunParameters(scene_, plan_)),
        threads_(std::size_t(ThreadSlots())) {
    run_.seed = context.seed ^ 0x2c1b3c6du;
    run_.tables = &tables_;
    const std::uint64_t paths =
        std::clamp(context.options.planned_samples / kPlanned, kMinPaths, kMaxPaths);
    tasks_ = std::uint32_t(paths / kPathsPerTask);
  }

  TrainingOutcome Run() {
    const LightTable& table = scene_.compiled->lights;
    const LightEmission& emission = scene_.chances->emission;
    EmissionGuide& guide = tables_.emission;
    guide = MakeEmissionGuide(table);
    Learn(PlainEmissionWeights(table, guide, emission), guide);
    std::vector<double> light(guide.num_cells + emission.pmf.size(), 0.0);
    for (std::uint32_t round = 0; round < kRounds; ++round) {
      AddRound(round, light);
      Learn(LearnedEmissionWeights(table, guide, emission, light), guide);
    }
    TrainingOutcome outcome;
    for (const auto& thread : threads_) {
      if (!thread) continue;
      const Wave& wave = thread->wavefront.wave();
      outcome.rays += wave.rays_closest + wave.rays_shadow;
    }
    outcome.samples = std::uint64_t{kRounds} * tasks_ * kPathsPerTask;
    outcome.note =
        fmt::format("{} light subpaths for lights at infinity", outcome.samples);
    return outcome;
  }

 private:
  struct Thread {
    Thread(const PreparedScene& scene, const Plan& plan, const RunParameters& run)
        : wavefront(scene, plan, run),
          subpaths(scene, plan, RenderedPixels(scene.view->film), wavefront) {}
    Wavefront wavefront;
    LightSubpaths subpaths;
  };

  static PlanOptions Options(const TrainingContext& context) {
    PlanOptions options = context.plan.options;
    options.auxiliary = Auxiliary::kNone;
    options.training = FeatureSet{};
    options.has_own_sequences = true;
    return options;
  }

  // Adds what the subpaths of a round bring, by where they start; always in one order.
  void AddRound(std::uint32_t round, std::vector<double>& light) {
    struct Found {
      std::uint32_t start;
      double light;
    };
    std::vector<std::vector<Found>> found(tasks_);
    ParallelFor(tasks_, [&](std::size_t task) {
      if (StopWatcher(stop_).IsStopped()) return;
      auto& thread = threads_[std::size_t(ThreadIndex())];
      if (!thread) thread = std::make_unique<Thread>(scene_, plan_, run_);
      std::vector<std::uint32_t> keys(kPathsPerTask);
      std::iota(keys.begin(), keys.end(), std::uint32_t(task) * kPathsPerTask);
      TileWork work;
      work.pixels = keys.data();
      work.num_pixels = kPathsPerTask;
      work.first_sample = round;
      work.samples = 1;
      thread->subpaths.TraceStarts(work, thread->wavefront.wave(),
                                   [&](std::uint32_t start, double brought) {
                                     if (brought > 0 && brought < 1e30)
                                       found[task].push_back({start, brought});
                                   });
    });
    for (const std::vector<Found>& task : found) {
      for (const Found& f : task) light[f.start] += f.light;
    }
  }

  const PreparedScene& scene_;
  const Plan plan_;
  StrategyTables& tables_;
  const std::atomic<bool>* const stop_;
  RunParameters run_;
  std::uint32_t tasks_;
  std::vector<std::unique_ptr<Thread>> threads_;
};

}  // namespace

TrainingOutcome TrainEmission(const TrainingContext& context) {
  return EmissionTraining(context).Run();
}

}  // namespace lanelight
