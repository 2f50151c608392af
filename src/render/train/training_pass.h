// One training pass: a few samples of some pixels, kept in memory, with what the
// strategy's stages have recorded of them.
#pragma once

#include <vector>

#include "src/base/core/vec.h"
#include "src/base/image/pixel_rect.h"
#include "src/render/plan/plan.h"
#include "src/scene/prepare/tables.h"
#include "src/vocabulary/path/wave.h"

namespace lanelight {

class PilotImage;   // src/scene/prepare/estimate_path_values.h
class RankPasses;   // src/render/train/rank_passes.h
class TaskWatcher;  // src/render/wave/task_watcher.h

/// Cost of a shadow ray relative to a ray that finds the closest hit and leads to
/// shading.
inline constexpr double kShadowRayCost = 0.5;

/// The parameters of a pass.
struct TrainingPass {
  const PreparedScene& scene;
  /// `training` says what is recorded (default: nothing). Auxiliary planes are omitted.
  PlanOptions options;
  const StrategyTables* tables = nullptr;
  std::uint32_t seed = 0;  // of a render: the pass has random numbers apart from it
  /// May cancel tasks, whose samples are then invalid; may be null.
  const TaskWatcher* watcher = nullptr;
  /// Ranks that share the tasks, whose watcher then counts; may be null.
  RankPasses* ranks = nullptr;
  /// Weighs the errors of subpaths; needed with light-paths=splats alone.
  const PilotImage* image = nullptr;
};

/// Relative variances of a sample that light subpaths cause, anywhere in the image: by
/// pixels, and by squares of 8 x 8 pixels; and what the light that these subpaths have
/// found causes where camera paths alone find it.
struct SubpathVariance {
  static constexpr int kSide = 8;
  float by_pixels = 0, by_squares = 0;
  float camera_by_pixels = 0, camera_by_squares = 0;
};
inline constexpr int kSubpathPlanes = sizeof(SubpathVariance) / sizeof(float);

/// Pixels of a pass, and samples of each: at least four, so that it shows the
/// variance within a pixel.
struct TrainingWork {
  static constexpr std::uint32_t kMinSpp = 4;
  std::vector<std::uint32_t> pixels;  // y * width + x
  /// The tiles that these are the pixels of, one after the other; may be empty.
  std::vector<PixelRect> tiles;
  std::uint32_t spp = kMinSpp;

  std::size_t samples() const { return pixels.size() * spp; }
};

struct TrainingSamples {
  std::vector<Vec3f> colors;  // of a pixel one after the other
  /// The planes behind the colour, sample by sample; with light-paths=splats, of the
  /// first sample of each pixel the SubpathVariance of the pixel's subpaths.
  std::vector<float> recorded;
  int planes = 0;  // how many these are
  // Independent observations of each pixel, with equally many samples
  // (PlanOptions::has_own_sequences).
  std::uint32_t observations = 1;
  std::uint64_t rays_closest = 0, rays_shadow = 0;

  std::uint64_t rays() const { return rays_closest + rays_shadow; }
  /// Returns the cost of a sample, in rays that find the closest hit and lead to shading.
  double Cost() const {
    return (double(rays_closest) + kShadowRayCost * double(rays_shadow)) /
           double(colors.size());
  }
};

/// Chooses about `samples` samples (at least four), spread evenly over the rendered
/// window, `spp` or more per pixel.
TrainingWork MakeTrainingWork(const PreparedScene& scene, std::uint64_t samples,
                              std::uint32_t spp = TrainingWork::kMinSpp);

/// Chooses whole tiles, as reuse=block needs them.
TrainingWork MakeTileWork(const PreparedScene& scene, std::uint64_t samples,
                          std::uint32_t spp);

/// Returns about a sixteenth of the work.
TrainingWork FewOf(const TrainingWork& work);

/// Renders the samples. The result does not depend on the number of threads.
TrainingSamples RunTrainingPass(TrainingPass pass, const TrainingWork& work);

}  // namespace lanelight
