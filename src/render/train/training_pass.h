// One training pass: a few samples of some pixels, kept in memory as they are, with what
// the strategy's own stages have recorded of them.
#pragma once

#include <vector>

#include "src/base/core/vec.h"
#include "src/base/image/pixel_rect.h"
#include "src/render/plan/plan.h"
#include "src/scene/prepare/tables.h"
#include "src/vocabulary/path/wave.h"

namespace lanelight {

class RankPasses;   // src/render/train/rank_passes.h
class TaskWatcher;  // src/render/wave/task_watcher.h

/// Price of a ray that only asks for a hit, over that of one that finds the closest and
/// leads to shading there.
inline constexpr double kShadowRayCost = 0.5;

/// What a pass renders with.
struct TrainingPass {
  const PreparedScene& scene;
  /// `training` says what is recorded: by default nothing. No auxiliary planes are kept.
  PlanOptions options;
  const StrategyTables* tables = nullptr;
  std::uint32_t seed = 0;  // of a render: the pass has random numbers apart from it
  /// The samples are of no use where it has cancelled some; null: nobody does.
  const TaskWatcher* watcher = nullptr;
  /// With whom the tasks are shared, whose watcher counts then; null: with nobody.
  RankPasses* ranks = nullptr;
};

/// Pixels of a pass, and samples of each: at least four, so that it shows the
/// variance within a pixel.
struct TrainingWork {
  static constexpr std::uint32_t kLeastSpp = 4;
  std::vector<std::uint32_t> pixels;  // y * width + x
  /// Whose pixels these are, one tile after the other; empty: of none.
  std::vector<PixelRect> tiles;
  std::uint32_t spp = kLeastSpp;

  std::size_t samples() const { return pixels.size() * spp; }
};

struct TrainingSamples {
  std::vector<Vec3f> colors;    // of a pixel one after the other
  std::vector<float> recorded;  // the planes behind the colour, sample by sample
  int planes = 0;               // how many these are
  // Of each pixel, as many samples in each: they are independent, samples of one are not
  // (PlanOptions::own_points).
  std::uint32_t observations = 1;
  std::uint64_t rays_closest = 0, rays_shadow = 0;

  std::uint64_t rays() const { return rays_closest + rays_shadow; }
  /// Of a sample, in rays that find the closest hit and lead to shading there.
  double Cost() const {
    return (double(rays_closest) + kShadowRayCost * double(rays_shadow)) /
           double(colors.size());
  }
};

/// About `samples` samples (at least four): spread evenly over the rendered window, `spp`
/// of a pixel or more. Each `turn` has pixels of its own, unless all of them are taken.
TrainingWork MakeTrainingWork(const PreparedScene& scene, std::uint64_t samples,
                              std::uint32_t spp = TrainingWork::kLeastSpp,
                              std::uint64_t turn = 0);

/// The same of whole tiles, as reuse=block needs them.
TrainingWork MakeTileWork(const PreparedScene& scene, std::uint64_t samples,
                          std::uint32_t spp);

/// About a sixteenth of it.
TrainingWork FewOf(const TrainingWork& work);

/// Renders the samples. The result does not depend on the number of threads.
TrainingSamples RunTrainingPass(TrainingPass pass, const TrainingWork& work);

}  // namespace lanelight
