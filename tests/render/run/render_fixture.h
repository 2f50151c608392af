// Renders a scene text in one call, for tests.
#pragma once

#include <string>

#include "src/base/core/parallel.h"
#include "src/render/plan/plan_features.h"
#include "src/render/run/run.h"
#include "src/scene/accel/build.h"
#include "src/scene/compile/compile.h"
#include "src/scene/compiled/scene.h"
#include "src/scene/parse/parse.h"
#include "src/scene/prepare/parameters.h"
#include "src/scene/prepare/prepared_scene.h"
#include "tests/support/test_target.h"

namespace lanelight {

struct TestRender {
  std::uint64_t spp = 16;
  std::uint64_t seed = 1;
  int threads = 2;
  std::uint32_t wavefront = 0;
  SampleSequence sampler = SampleSequence::kIndependent;
  std::string strategy;  // on top of the scene's and `sampler`
  std::string chosen;    // on top of that, as a trial run changes the plan alone
  Auxiliary auxiliary = Auxiliary::kNone;
  std::uint64_t planned_samples = 0;  // RunOptions
  CompileOptions compile;
};

struct Rendered {
  FilmAccumulator film;
  RunResult result;
  Plan plan;
};

inline Rendered RenderDescription(const SceneDescription& description,
                                  const TestRender& t) {
  const ThreadLimit limit(t.threads);
  CompileOptions compile = t.compile;
  compile.leaf_triangles = LeafTrianglesFor(TestTarget().lanes());  // as a render does
  PreparedScene scene = PrepareScene(description, compile);
  Strategy strategy = scene.strategy;
  strategy.sampler = t.sampler;
  ApplyStrategy(t.strategy, {}, strategy);
  scene = WithStrategy(scene, strategy);
  PlanOptions plan_options;
  plan_options.target = TestTarget();
  plan_options.max_depth =
      static_cast<std::uint32_t>(scene.compiled->integrator.max_depth);
  plan_options.auxiliary = t.auxiliary;
  plan_options.wavefront = t.wavefront;
  if (!t.chosen.empty()) plan_options = WithChanges(scene, plan_options, t.chosen);
  const Plan plan = MakePlan(scene, plan_options);
  Rendered out{FilmAccumulator(0, 0, scene.view->film.width, scene.view->film.height,
                               GroupsOf(scene.strategy), t.auxiliary),
               {},
               plan};
  RunOptions options;
  options.spp = t.spp;
  options.seed = t.seed;
  options.planned_samples = t.planned_samples;
  out.result = Run(scene, plan, options, out.film);
  return out;
}

inline Rendered RenderText(const std::string& text, const TestRender& t = {}) {
  return RenderDescription(ParseSceneText(text, "test.pbrt", "."), t);
}

/// Samples, means and variances are equal, to the last bit.
inline bool Identical(const FilmAccumulator& a, const FilmAccumulator& b) {
  for (int y = a.y0(); y < a.y0() + a.height(); ++y) {
    for (int x = a.x0(); x < a.x0() + a.width(); ++x) {
      if (a.Samples(x, y) != b.Samples(x, y) || !(a.Mean(x, y) == b.Mean(x, y)) ||
          !(a.Variance(x, y) == b.Variance(x, y))) {
        return false;
      }
    }
  }
  return true;
}

/// Mean over the pixels of the image.
inline Rgb ImageMean(const FilmAccumulator& film) {
  Rgb sum;
  for (int y = 0; y < film.height(); ++y) {
    for (int x = 0; x < film.width(); ++x) sum += film.Mean(x, y);
  }
  return sum / (double(film.width()) * film.height());
}

/// Standard error of ImageMean per channel, from the films' own variances.
inline Rgb ImageStandardError(const FilmAccumulator& film) {
  Rgb sum;
  for (int y = 0; y < film.height(); ++y) {
    for (int x = 0; x < film.width(); ++x) sum += film.Variance(x, y);
  }
  const double n = double(film.width()) * film.height();
  return {std::sqrt(sum.x) / n, std::sqrt(sum.y) / n, std::sqrt(sum.z) / n};
}

}  // namespace lanelight
