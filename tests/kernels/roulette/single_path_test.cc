// A pass with splitting tells what the same paths would bring without: their brightness,
// and its second moment with roulette on the throughput.
#include <catch2/catch.hpp>
#include <cmath>

#include "src/base/stat/hypothesis.h"
#include "src/render/plan/plan_features.h"
#include "src/render/train/path_records.h"
#include "src/render/train/training.h"
#include "src/render/train/training_pass.h"
#include "src/scene/compiled/scene.h"
#include "src/scene/prepare/prepared_scene.h"
#include "tests/reference/scenes.h"

namespace lanelight::test {
namespace {

using stat::MeanEstimate;

// A lamp behind a gap: paths are ended in the dark, and split in the light. `glass`: seen
// through a pane, so that the roulette has refractions to undo.
SceneDescription TwoRooms(bool glass) {
  SceneBuilder b(16, 16);
  b.Depth(7).Perspective({0, 0, 0.9}, {0, 0, -1}, {0, 1, 0}, 70);
  const Index wall = b.AddDiffuse({0.8, 0.7, 0.6});
  b.AddBox({-1, -1, -1}, {1, 1, 1}, wall).reverse_orientation = true;
  b.AddBox({-1, -0.1, -1}, {0.7, 0, 1}, wall);
  b.AddQuad({-0.3, 0.99, -0.3}, {0.6, 0, 0}, {0, 0, 0.6}, b.AddDiffuse(Grey(0)),
            b.AddEmission(Grey(5)));
  if (glass) {
    b.AddBox({-0.9, -0.95, 0.2}, {0.9, -0.15, 0.4}, b.AddDielectric(1.5));
  }
  return b.Build();
}

constexpr std::uint64_t kSamples = 1u << 17;

// A scene with roulette=adjoint, and what its training finds.
struct Prepared {
  explicit Prepared(const SceneDescription& description)
      : scene(PrepareScene(description, {})) {
    Strategy s = scene.strategy;
    ApplyStrategy("points=independent,roulette=adjoint", {}, s);
    scene = WithStrategy(scene, s);
    PlanOptions options;
    options.max_depth = static_cast<std::uint32_t>(scene.compiled->integrator.max_depth);
    plan = MakePlan(scene, options);
    TrainingOptions training;
    training.planned_samples = 400'000;
    Train({scene, plan, kSeed, training, tables});
  }

  static constexpr std::uint32_t kSeed = 11;
  PreparedScene scene;
  Plan plan;
  StrategyTables tables;
};

double Brightness(const float channel[3], const Vec3f& c) {
  return channel[0] * c.x + channel[1] * c.y + channel[2] * c.z;
}

// Of samples that are independent: what they scatter between pixels is in it too.
MeanEstimate MeanOf(const std::vector<double>& values) {
  double sum = 0, squares = 0;
  for (double v : values) sum += v, squares += v * v;
  const double n = double(values.size()), mean = sum / n;
  return {mean, (squares / n - mean * mean) / (n - 1), n - 1};
}

struct SplitMoments {
  std::vector<double> own, single;  // of the pass; what it says of roulette=throughput
};

// With what the splitting roulette has learned, another one plays.
TrainingSamples Pass(const Prepared& room, const char* roulette, bool records) {
  PlanOptions options =
      WithChanges(room.scene, room.plan.options, std::string("roulette=") + roulette);
  options.training = records ? FeatureSet{Feature::kRecordsSinglePaths} : FeatureSet{};
  return RunTrainingPass({room.scene, options, &room.tables, Prepared::kSeed},
                         MakeTrainingWork(room.scene, kSamples));
}

SplitMoments MomentsOf(const Prepared& room, const TrainingSamples& samples) {
  const TrainingWork work = MakeTrainingWork(room.scene, kSamples);
  SplitMoments m;
  for (std::size_t i = 0; i < samples.colors.size(); ++i) {
    const PathValues& values = room.tables.path_values;
    const double y = Brightness(values.channel, samples.colors[i]);
    const double off = y - MomentsAbout(values, 1, work.pixels[i / work.spp]);
    m.own.push_back(off * off);
    if (samples.planes == 0) continue;
    CHECK(samples.recorded[2 * i] == Approx(y).epsilon(1e-4).margin(1e-6));
    m.single.push_back(samples.recorded[2 * i + 1]);
  }
  return m;
}

}  // namespace

TEST_CASE("a pass with splitting estimates the second moment without splitting",
          "[roulette]") {
  // Each comparison of equal means fails by chance once in 100 000 runs.
  constexpr double kFalseAlarm = 1e-5;
  for (const bool glass : {false, true}) {
    const Prepared room(TwoRooms(glass));
    const SplitMoments splits = MomentsOf(room, Pass(room, "adjoint", true));
    const SplitMoments plain = MomentsOf(room, Pass(room, "throughput", false));
    const MeanEstimate said = MeanOf(splits.single), is = MeanOf(plain.own);
    const MeanEstimate other = MeanOf(splits.own);
    INFO("glass " << glass << ": " << said.mean << " +- " << std::sqrt(said.variance)
                  << " for " << is.mean << " +- " << std::sqrt(is.variance)
                  << "; with splitting " << other.mean);
    CHECK(stat::WelchPValue(said, is) > kFalseAlarm);
    // And not because there is nothing to tell.
    CHECK(stat::WelchPValue(said, other) < 1e-9);
  }
}

TEST_CASE("recording single-path estimates does not change them", "[roulette]") {
  const Prepared room(TwoRooms(true));
  const TrainingSamples with = Pass(room, "adjoint", true),
                        without = Pass(room, "adjoint", false);
  CHECK(with.colors == without.colors);
  CHECK(with.rays_closest == without.rays_closest);
  CHECK(without.planes == 0);
}

TEST_CASE("variances with and without splitting differ by second moments", "[roulette]") {
  // One pixel, four samples of brightness 0.1 to 0.4, grey; of each the square would be
  // larger by 0.02 without splitting. Exposure 1 / 2: colours are half of the records.
  // SplitMoments are about 0.3, 0.6 in the records.
  TrainingWork work;
  work.pixels = {0};
  TrainingSamples samples;
  samples.planes = 2, samples.observations = 4;
  for (float y : {0.2f, 0.4f, 0.6f, 0.8f}) {
    samples.colors.push_back({y / 2, y / 2, y / 2});
    samples.recorded.push_back(y);
    samples.recorded.push_back((y - 0.6f) * (y - 0.6f) + 0.08f);
  }
  const PilotImage image(1, 1, work.pixels, samples.colors);
  PathValues values;
  values.inverse_pixel.assign(3, 1 / (std::sqrt(3.0f) * 0.3f));
  CHECK(MomentsAbout(values, 0.5f, 0) == Approx(0.6));
  const std::vector<double> own = RelativeVariances(samples, work, image);
  const auto single = SinglePathVariances(samples, work, image, values, 0.5f, own);
  CHECK(single[0] - own[0] == Approx(0.02 * image.ErrorWeight(0, 0)).epsilon(1e-5));
  // Black pixels have no brightness.
  values.inverse_pixel.assign(3, 0);
  CHECK(MomentsAbout(values, 0.5f, 0) == 0);
}

}  // namespace lanelight::test
