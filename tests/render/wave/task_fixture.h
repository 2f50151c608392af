// One task of a render, stage by stage as the driver runs them.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "src/render/train/training.h"
#include "src/render/wave/phase_driver.h"
#include "src/render/wave/tiles.h"
#include "src/render/wave/wavefront.h"
#include "src/scene/prepare/prepared_scene.h"
#include "src/scene/prepare/tables.h"
#include "tests/render/run/render_fixture.h"

namespace lanelight {

/// A light, and what MeshScene adds.
inline const char* kMesh = R"(
Camera "perspective" "float fov" 60
Film "rgb" "integer xresolution" 32 "integer yresolution" 32
WorldBegin
AttributeBegin
  AreaLightSource "diffuse" "rgb L" [ 6 5 4 ]
  Shape "trianglemesh" "point3 P" [ -1 2 3  1 2 3  1 2 5 ] "integer indices" [ 0 2 1 ]
AttributeEnd
Material "diffuse" "rgb reflectance" [ 0.6 0.6 0.6 ]
)";

/// Enough triangles in space for a tree.
inline std::string MeshScene() {
  std::string points, indices;
  for (int i = 0; i < 400; ++i) {
    const double x = i % 20 * 0.2 - 2, y = i / 20 * 0.2 - 2, z = 4 + 0.3 * (i % 7);
    points += fmt::format("{} {} {} {} {} {} {} {} {} ", x, y, z, x + 0.3, y, z, x,
                          y + 0.3, z + 0.1);
    indices += fmt::format("{} {} {} ", 3 * i, 3 * i + 1, 3 * i + 2);
  }
  return std::string(kMesh) + "Shape \"trianglemesh\" \"point3 P\" [ " + points +
         "] \"integer indices\" [ " + indices + "]\n";
}

/// What a task of a render does (src/render/schedule/thread_work.cc), with a plan to
/// tamper with.
class TaskFixture {
 public:
  TaskFixture(const std::string& text, const std::string& strategy, Auxiliary auxiliary)
      : scene_(PrepareScene(ParseSceneText(text, "test.pbrt", "."), {})) {
    Strategy s = scene_.strategy;
    ApplyStrategy(strategy, {}, s);
    scene_ = WithStrategy(scene_, s);
    PlanOptions options;
    options.max_depth = 6;
    options.auxiliary = auxiliary;
    options.wavefront = 256;
    plan = MakePlan(scene_, options);
    run_ = MakeRunParameters(scene_, plan);
    run_.tables = &tables_;
    max_split_ = plan.features.Has(Feature::kSplitting) ? kMaxSplitPaths : 1;
    if (NeedsTraining(plan)) MakeTrainedTables();
    wavefront_ = std::make_unique<Wavefront>(scene_, plan, run_);
    TilePixels({0, 0, 32, 32}, 32, &pixels_);
    buffer_.resize(std::size_t{Rows()} * kPlanes);
  }

  /// Waves are counted by how often the first stage runs.
  void Run(StageClock* clock) {
    TileWork work;
    work.pixels = pixels_.data();
    work.num_pixels = static_cast<std::uint32_t>(pixels_.size());
    work.samples = kSamples;
    work.together = kSamples;
    if (clock) clock->StartTask();
    wavefront_->wave().Begin(work, {buffer_.data(), Rows()});
    RunPhase(wavefront_->wave(), plan.paths(), clock);
    if (clock) clock->EndTask();
  }

  Plan plan;

 private:
  static constexpr std::uint32_t kSamples = 4;
  static constexpr int kPlanes = 48;  // more than any strategy has

  std::uint32_t Rows() const { return 32 * 32 * kSamples * max_split_; }

  // Makes the tables that roulettes with training use.
  void MakeTrainedTables() {
    TrainingOptions options;
    options.planned_samples = 100000;
    Train({scene_, plan, run_.seed, options, tables_});
  }

  PreparedScene scene_;
  StrategyTables tables_;
  RunParameters run_;
  std::uint32_t max_split_ = 1;
  std::unique_ptr<Wavefront> wavefront_;
  std::vector<std::uint32_t> pixels_;
  std::vector<float> buffer_;
};

}  // namespace lanelight
