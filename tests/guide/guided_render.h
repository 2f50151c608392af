// Renders with a guide of the test's own, which no training has made.
#pragma once

#include <string>

#include "src/prepare/tables.h"
#include "src/train/training_pass.h"
#include "src/wave/wavefront.h"
#include "tests/agreement/agreement.h"

namespace lanelight::test {

struct GuidedRender {
  std::string strategy = "directions=mis";
  std::uint32_t spp = 1024;
  std::uint32_t seed = 1;
  const Guide* guide = nullptr;  // null: guiding=none
};

/// Every sample is drawn on its own: no two make a group.
inline stat::ImageEstimate RenderGuided(const SceneDescription& description,
                                        const GuidedRender& options) {
  const ThreadLimit limit(2);
  PreparedScene scene = PrepareScene(description);
  Strategy strategy = scene.strategy;
  ApplyStrategy("points=independent,seen-lights=paths," + options.strategy +
                    (options.guide != nullptr ? ",guiding=radiance" : ""),
                {}, strategy);
  scene = WithStrategy(scene, strategy);
  StrategyTables tables = MakeStrategyTables(scene);
  if (options.guide != nullptr) tables.guide = *options.guide;
  PlanOptions plan_options;
  plan_options.max_depth =
      static_cast<std::uint32_t>(scene.compiled->integrator.max_depth);
  const int width = scene.view.film.width, height = scene.view.film.height;
  const double n = options.spp;
  TrainingWork work;
  work.spp = options.spp;
  for (int i = 0; i < width * height; ++i) {
    work.pixels.push_back(static_cast<std::uint32_t>(i));
  }
  const TrainingSamples samples =
      RunTrainingPass({scene, plan_options, &tables, options.seed}, work);
  stat::ImageEstimate out = {width, height, n, {}, {}};
  for (std::size_t pixel = 0; pixel < work.pixels.size(); ++pixel) {
    Rgb sum, squares;
    for (std::size_t i = 0; i < options.spp; ++i) {
      const Vec3f c = samples.colors[pixel * options.spp + i];
      const Rgb color = {c.x, c.y, c.z};
      sum += color;
      squares += color * color;
    }
    out.mean.push_back(sum / n);
    out.variance.push_back((squares / n - (sum / n) * (sum / n)) / (n - 1));
  }
  return out;
}

}  // namespace lanelight::test
