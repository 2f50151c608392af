#include "tests/bias/seed_images.h"

#include <catch2/catch.hpp>

#include "src/base/core/source_location.h"
#include "src/render/run/run.h"
#include "src/scene/compiled/scene.h"
#include "src/scene/prepare/parameters.h"
#include "tests/support/test_target.h"

namespace lanelight::test {
namespace {

struct Planned {
  PreparedScene scene;
  Plan plan;
};

Planned PlanOf(const PreparedScene& scene, const std::string& text) {
  Strategy strategy = scene.strategy;
  ApplyStrategy(text, {}, strategy);
  Planned planned = {WithStrategy(scene, strategy), {}};
  PlanOptions options;
  options.target = TestTarget();
  options.max_depth = static_cast<std::uint32_t>(scene.compiled->integrator.max_depth);
  planned.plan = MakePlan(planned.scene, options);
  return planned;
}

SeedImage RenderSeed(const Planned& planned, const RunOptions& options,
                     std::uint64_t& bad_samples) {
  const auto& size = planned.scene.view->film;
  FilmAccumulator film(0, 0, size.width, size.height, GroupsOf(planned.scene.strategy),
                       Auxiliary::kNone);
  bad_samples += Run(planned.scene, planned.plan, options, film).health.Total();
  SeedImage image = {size.width, size.height, {}};
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) image.pixels.push_back(film.Mean(x, y));
  }
  return image;
}

}  // namespace

std::vector<SeedImage> RenderSeeds(const PreparedScene& scene,
                                   const std::string& strategy, const SeedRange& seeds) {
  const Planned planned = PlanOf(scene, strategy);
  std::vector<SeedImage> images;
  std::uint64_t bad_samples = 0;
  for (int i = 0; i < seeds.count; ++i) {
    RunOptions options;
    options.spp = seeds.spp;
    options.seed = seeds.first + static_cast<std::uint64_t>(i);
    options.profile = false;
    options.planned_samples = kMinTrainingSamples;  // a bad guess must not bias the image
    images.push_back(RenderSeed(planned, options, bad_samples));
  }
  CHECK(bad_samples == 0);
  return images;
}

}  // namespace lanelight::test
