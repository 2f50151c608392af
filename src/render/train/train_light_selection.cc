// A training pass, from which light-selection=learned learns what lights bring to the
// cells of the scene, shadows included. It takes 1/80 of the planned samples and
// selects lights by power.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "src/render/plan/plan_features.h"
#include "src/render/train/path_records.h"
#include "src/render/train/training.h"
#include "src/render/train/training_pass.h"
#include "src/render/wave/task_watcher.h"
#include "src/render/wave/wavefront.h"
#include "src/scene/compiled/scene.h"
#include "src/scene/geometry/geometry.h"
#include "src/scene/prepare/cell_grid.h"
#include "src/scene/prepare/learned_lights.h"
#include "src/scene/prepare/prepared_scene.h"

namespace lanelight {
namespace {

constexpr std::uint64_t kTrainingShare = 80, kMaxSelectionSamples = 240'000;

CellGrid GridOf(const PreparedScene& scene, const TrainingWork& work) {
  const Geometry& geometry = scene.compiled->geometry;
  return MakeCellGrid(geometry.bounds_min, geometry.bounds_max, work.samples() * 2);
}

// The light of a sample is weighted as a relative error of its pixel. One bright sample
// must not decide for a cell.
LightRecords RecordsOf(const PreparedScene& scene, const PathSamples& samples,
                       const TrainingWork& work, const CellGrid& grid,
                       const LearnedLights& groups) {
  const AlignedVector<float>& power = scene.chances->pmf;
  const PilotImage image = EstimatePilotImage(scene, samples, work);
  const float exposure = ExposureOf(scene);
  LightRecords records(grid, groups.num_groups);
  for (std::size_t i = 0; i < samples.records.size(); ++i) {
    const std::uint32_t pixel = work.pixels[i / work.spp];
    const double maximum = PilotImage::kClamp * image.Brightness(pixel);
    double weight = 0;  // of a square
    for (int c = 0; c < 3; ++c) weight += image.ErrorWeight(pixel, c) / 3;
    for (const PathRecord::Vertex& v : samples.records[i].vertices) {
      if (v.cell == kNoCell) continue;
      records.AddVertex(v.cell);
      if (!(v.direct > 0)) continue;
      const double brings = std::min(double(v.direct * exposure), maximum);
      records.Add(v.cell, std::uint32_t(groups.group[v.light]),
                  brings * std::sqrt(weight),
                  double(power[v.light]) / double(groups.within[v.light]));
    }
  }
  return records;
}

}  // namespace

TrainingOutcome TrainLightSelection(const TrainingContext& context) {
  const PreparedScene& scene = context.scene;
  const TrainingWork work = MakeTrainingWork(
      scene, std::clamp<std::uint64_t>(context.options.planned_samples / kTrainingShare,
                                       1, kMaxSelectionSamples));
  StrategyTables tables;
  tables.path_values.grid = GridOf(scene, work);
  PlanOptions options = WithChanges(scene, context.plan.options,
                                    UntrainedChanges(scene, context.plan.options));
  options.training = FeatureSet{Feature::kRecordsPaths};
  const StopWatcher watcher(context.options.stop);
  const PathSamples samples = ReadRecords(RunTrainingPass(
      {scene, options, &tables, context.seed, &watcher, context.options.ranks}, work));
  TrainingOutcome outcome;
  outcome.samples = samples.colors.size();
  outcome.rays = samples.rays();
  outcome.note = fmt::format("{} training samples", outcome.samples);
  if (watcher.IsStopped()) return outcome;
  const AlignedVector<float>& power = scene.chances->pmf;
  LearnedLights learned = GroupLights(*scene.compiled, power);
  Learn(RecordsOf(scene, samples, work, tables.path_values.grid, learned), power,
        learned);
  context.tables.lights = std::move(learned);
  return outcome;
}

}  // namespace lanelight
