// A training pass, from which roulette=adjoint learns what paths are worth: the
// brightness of the pixels, and the values of the cells. It takes about 4 percent of the
// planned samples, at most 240 000. Results do not depend on the number of threads: sums
// run in the order of the samples.
#include <fmt/format.h>

#include <algorithm>

#include "src/render/plan/plan_features.h"
#include "src/render/train/path_records.h"
#include "src/render/train/training.h"
#include "src/render/train/training_pass.h"
#include "src/render/wave/task_watcher.h"
#include "src/render/wave/wavefront.h"
#include "src/scene/compiled/scene.h"
#include "src/scene/geometry/geometry.h"
#include "src/scene/prepare/cell_grid.h"
#include "src/scene/prepare/prepared_scene.h"

namespace lanelight {
namespace {

constexpr std::uint64_t kMaxTrainingSamples = 240'000;

class Pilot {
 public:
  explicit Pilot(const TrainingContext& context)
      : scene_(context.scene),
        context_(context),
        values_(context.tables.path_values),
        watcher_(context.options.stop),
        work_(MakeTrainingWork(
            scene_, std::clamp<std::uint64_t>(context.options.planned_samples / 25, 1,
                                              kMaxTrainingSamples))) {}

  TrainingOutcome Run() {
    const Geometry& geometry = scene_.compiled->geometry;
    values_.grid = MakeCellGrid(geometry.bounds_min, geometry.bounds_max,
                                std::uint64_t{work_.samples()} * 2);
    WeighChannels(FewOf(work_));
    const PathSamples samples = Pass({Feature::kRecordsPaths}, work_);
    const PilotImage image = EstimatePilotImage(scene_, samples, work_);
    values_.inverse_pixel = image.Inverse();
    CellRecords records(values_.grid.cells());
    if (!image.black()) Deposit(samples, image, records);
    SetCellValues(records, values_);
    outcome_.note = fmt::format("{} training samples", outcome_.samples);
    return outcome_;
  }

 private:
  PathSamples Pass(const FeatureSet& records, const TrainingWork& work) {
    PlanOptions options =
        WithChanges(scene_, context_.plan.options, "roulette=throughput");
    options.training = records;
    PathSamples samples =
        ReadRecords(RunTrainingPass({scene_, options, &context_.tables, context_.seed,
                                     &watcher_, context_.options.ranks},
                                    work));
    outcome_.samples += samples.colors.size();
    outcome_.rays += samples.rays();
    return samples;
  }

  // The colour of the image: brightness weighs the channels with it.
  void WeighChannels(const TrainingWork& few) {
    const PilotImage image = EstimatePilotImage(scene_, Pass({}, few), few);
    for (int c = 0; c < 3; ++c) values_.channel[c] = image.Channel(c);
  }

  void Deposit(const PathSamples& samples, const PilotImage& image,
               CellRecords& records) const {
    const float exposure = ExposureOf(scene_);
    for (std::size_t i = 0; i < samples.records.size(); ++i) {
      const PathRecord& r = samples.records[i];
      const double maximum =
          PilotImage::kClamp * image.Brightness(work_.pixels[i / work_.spp]);
      for (const PathRecord::Vertex& v : r.vertices) {
        if (v.cell == kNoCell || !(v.at > 0)) continue;
        const double gathered =
            std::clamp<double>((r.end - v.got) * exposure, 0, maximum);
        records.Add(v.cell, gathered / v.at);
      }
    }
  }

  const PreparedScene& scene_;
  const TrainingContext& context_;
  PathValues& values_;
  const StopWatcher watcher_;
  const TrainingWork work_;
  TrainingOutcome outcome_;
};

}  // namespace

TrainingOutcome TrainPathValues(const TrainingContext& context) {
  return Pilot(context).Run();
}

}  // namespace lanelight
