// The presets of the founding paper on a scene: tests over all scenes that there are.
#pragma once

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>

#include "src/scene/parse/parse.h"
#include "src/scene/prepare/parameters.h"
#include "src/scene/prepare/prepared_scene.h"
#include "tests/render/run/render_fixture.h"

namespace lanelight::test {

/// Renders the scene with all presets, 32 x 32 pixels of 4 samples. None may refuse it,
/// and none may give a sample that is not finite; figure 6 is no copy of the common base.
inline void CheckPresets(const std::filesystem::path& path) {
  SceneDescription description = ParseScene(path.string());
  description.film.width = description.film.height = 32;
  std::fill_n(description.film.crop, 4, 0);
  PreparedScene scene = PrepareScene(description);
  PlanOptions plan_options;
  plan_options.max_depth =
      static_cast<std::uint32_t>(scene.compiled->integrator.max_depth);
  for (const PresetInfo& preset : AllPresets()) {
    INFO(path << ", " << preset.name);
    Strategy strategy = scene.strategy;
    ApplyStrategy(preset.name, {}, strategy);
    scene = WithStrategy(scene, strategy);
    FilmAccumulator film(0, 0, 32, 32, GroupsOf(strategy), Auxiliary::kNone);
    RunOptions options;
    options.spp = 4;
    Plan plan;
    REQUIRE_NOTHROW(plan = MakePlan(scene, plan_options));
    CHECK(Run(scene, plan, options, film).health.Total() == 0);
    CHECK(std::isfinite(Luminance(ImageMean(film))));
    CHECK(film.Control().has_value() == (strategy.control != Control::kNone));
  }
}

}  // namespace lanelight::test
