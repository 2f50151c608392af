// A scene whose guide is trained, for tests.
#pragma once

#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "src/prepare/guide_records.h"
#include "src/prepare/parameters.h"
#include "src/train/training.h"
#include "src/train/training_pass.h"
#include "src/wave/wavefront.h"
#include "tests/reference/scenes.h"
#include "tests/run/render_fixture.h"

namespace lanelight {

// A scene and what its training sees of it.
struct Prepared {
  Prepared(const SceneDescription& description, const std::string& strategy,
           std::uint32_t wavefront = 0)
      : scene(PrepareScene(description, {})) {
    Strategy s = scene.strategy;
    s.points = Points::kIndependent;
    ApplyStrategy(strategy, {}, s);
    scene = WithStrategy(scene, s);
    PlanOptions options;
    options.max_depth = static_cast<std::uint32_t>(scene.compiled->integrator.max_depth);
    options.wavefront = wavefront;
    plan = MakePlan(scene, options);
    tables = MakeStrategyTables(scene);
    run = MakeRunParameters(scene, plan);
    run.seed = 11;
    run.tables = &tables;
  }

  TrainingOutcome TrainWith(std::uint64_t planned) {
    TrainingOptions options;
    options.planned_samples = planned;
    return Train({scene, plan, run.seed, options, tables});
  }

  std::vector<GuideRecord> Records(std::uint64_t samples) const {
    PlanOptions options = plan.options;
    options.training = FeatureSet{Feature::kRecordsGuide};
    const TrainingSamples found = RunTrainingPass({scene, options, &tables, run.seed},
                                                  MakeTrainingWork(scene, samples));
    std::vector<GuideRecord> records;
    CHECK(ReadGuideRecords(found.recorded, tables.guide, records) == 0);
    return records;
  }

  PreparedScene scene;
  Plan plan;
  StrategyTables tables;
  RunParameters run;
};

}  // namespace lanelight
