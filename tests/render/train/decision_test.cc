// decide=pilot: what it chooses, that the image then is that of the choice, bit by bit,
// and the pieces that it decides with.
#include <catch2/catch.hpp>
#include <numeric>
#include <random>

#include "src/render/plan/plan_features.h"
#include "src/render/train/path_records.h"
#include "src/render/train/strategy_trial.h"
#include "src/render/train/training.h"
#include "src/render/train/trial_comparison.h"
#include "src/scene/parse/parse.h"
#include "src/scene/prepare/prepared_scene.h"
#include "tests/agreement/agreement.h"

namespace lanelight::test {
namespace {

constexpr int kSide = 24;

// Every wall emits 1 and reflects so much; paths of up to `depth` events.
SceneDescription Room(double albedo, int depth) {
  SceneDescription scene = ClosedRoom(albedo, depth);
  scene.film.width = scene.film.height = kSide;
  return scene;
}

// A lamp behind a gap: most paths in the dark part die of nothing.
SceneDescription SplitRoom(int depth = 8) {
  SceneBuilder b(kSide, kSide);
  b.Depth(depth).Perspective({0, 0, 0.9}, {0, 0, -1}, {0, 1, 0}, 70);
  const Index wall = b.AddDiffuse({0.8, 0.7, 0.6});
  b.AddBox({-1, -1, -1}, {1, 1, 1}, wall).reverse_orientation = true;
  b.AddBox({-1, -0.1, -1}, {0.95, 0, 1}, wall);
  b.AddQuad({-0.3, 0.99, -0.3}, {0.6, 0, 0}, {0, 0, 0.6}, b.AddDiffuse(Grey(0)),
            b.AddEmission(Grey(5)));
  return b.Build();
}

// As a render of so many samples would decide, with few of its own.
Rendered Decide(const SceneDescription& scene, const std::string& strategy,
                std::uint64_t planned = 1u << 21, std::uint64_t spp = 4) {
  TestRender t;
  t.spp = spp;
  t.planned_samples = planned;
  t.strategy = "points=sobol,seen-lights=paths," + strategy;
  return RenderDescription(scene, t);
}

bool SameImage(const Rendered& a, const Rendered& b) {
  return Identical(a.film, b.film) && a.result.rays_closest == b.result.rays_closest &&
         a.result.rays_shadow == b.result.rays_shadow;
}

// 1 / (relative variance times rays), without the pilot.
double Efficiency(const Rendered& r) {
  std::vector<double> variances;
  for (int y = 0; y < r.film.height(); ++y) {
    for (int x = 0; x < r.film.width(); ++x) {
      const Rgb mean = r.film.Mean(x, y), variance = r.film.Variance(x, y);
      double sum = 0;
      for (int c = 0; c < 3; ++c) sum += variance[c] / (mean[c] * mean[c] + 0.01);
      variances.push_back(sum);
    }
  }
  const double rays = double(r.result.rays_closest) + 0.5 * double(r.result.rays_shadow);
  return 1 / (RobustMean(variances) * rays);
}

}  // namespace

TEST_CASE("the pilot plays a milder roulette where late light is most", "[decision]") {
  // With a control variate paths serve no others.
  const Rendered r = Decide(Room(0.9, 100), "control=regression,decide=pilot");
  INFO(r.result.training.note);
  CHECK(r.result.roulette == Roulette::kThroughput);
  CHECK(r.result.training.changes == "roulette=throughput:0:2:4,decide=none");
  CHECK_THAT(r.result.training.note,
             Catch::Contains("rendered with roulette=throughput:0:2:4") &&
                 Catch::Contains("roulette=adjoint"));
  // The image is what it is with that asked for: the pilot leaves nothing behind.
  CHECK(SameImage(
      r, Decide(Room(0.9, 100), "control=regression,roulette=throughput:0:2:4")));
}

// The training of these may end with another roulette, which is not the one that was
// asked for: path reuse does not go together with that.
TEST_CASE("a trial beside a roulette that splits renders with it", "[decision]") {
  SceneDescription corridor =
      ParseScene(std::string(LANELIGHT_SOURCE_DIR) + "/scenes/corridor.pbrt");
  corridor.film.width = corridor.film.height = 64;
  for (const char* roulette : {"adjoint", "efficiency"}) {
    const Rendered r =
        Decide(corridor, std::string("decide=pilot,roulette=") + roulette, 1u << 20);
    INFO(r.result.training.note);
    CHECK(r.result.samples == 64 * 64 * 4);
    CHECK_THAT(r.result.training.changes, !Catch::Contains("reuse"));
  }
}

TEST_CASE("the pilot has paths serve their block where light comes by bounces",
          "[decision]") {
  const Rendered r = Decide(Room(0.9, 100), "decide=pilot");
  INFO(r.result.training.note);
  CHECK(r.result.training.changes == "roulette=throughput:0:2:4,reuse=block,decide=none");
  CHECK(r.film.groups().dependents > 10);  // of pixels that share paths
  CHECK(SameImage(r, Decide(Room(0.9, 100), "roulette=throughput:0:2:4,reuse=block")));
  // Nothing is shared by what leaves after one event, nor by mirrors.
  SceneDescription plane = PolygonLight(32);
  plane.integrator.max_depth = 6;
  const Rendered none = Decide(plane, "decide=pilot");
  CHECK(none.result.training.changes == "decide=none");
  CHECK(none.film.groups().dependents == 1);
}

TEST_CASE("the pilot knows what paths that carry wavelengths can serve",
          "[decision][spectral]") {
  SceneDescription room = Room(0.9, 100);
  room.integrator.transport = Transport::kSpectral;
  CHECK(Decide(room, "decide=pilot").result.training.changes ==
        "roulette=throughput:0:2:4,reuse=block,decide=none");
  // Paths that glass has left one wavelength serve no others: that is not tried.
  Material glass;
  glass.kind = MaterialKind::kDielectric;
  glass.dispersion =
      std::make_shared<const Spectrum>([](double nm) { return 1.5 + 5000 / (nm * nm); });
  room.materials.push_back(glass);
  Shape bead;
  bead.kind = ShapeKind::kSphere;
  bead.radius = 0.05;
  bead.material = static_cast<Index>(room.materials.size() - 1);
  room.shapes.push_back(bead);
  const Rendered r = Decide(room, "decide=pilot");
  INFO(r.result.training.note);
  CHECK(r.result.training.changes == "roulette=throughput:0:2:4,decide=none");
  CHECK(r.result.training.note.find("reuse") == std::string::npos);
}

TEST_CASE("the pilot shortens paths that cost more than they bring", "[decision]") {
  // Nothing ends a path but the depth: that has the least variance by far the most rays.
  const Rendered r = Decide(SplitRoom(40), "roulette=throughput:1,decide=pilot");
  INFO(r.result.training.note);
  CHECK(r.result.training.changes != "decide=none");
}

TEST_CASE("the pilot leaves the strategy as it is where nothing pays", "[decision]") {
  // After one event on the plane paths leave.
  SceneDescription plane = PolygonLight(32);
  plane.integrator.max_depth = 6;
  for (const char* strategy : {"", "roulette=throughput:0.05:5,", "points=cmj,"}) {
    const std::string text = strategy;
    const Rendered r = Decide(plane, text + "decide=pilot");
    INFO(text << ": " << r.result.training.note);
    CHECK(r.result.training.changes == "decide=none");
    CHECK(SameImage(r, Decide(plane, text + "decide=none")));
  }
}

TEST_CASE("a decision does not hang on threads or wavefronts", "[decision]") {
  for (const SceneDescription& scene : {Room(0.9, 100), SmallRoom(24, 5)}) {
    TestRender t;
    t.spp = 3;
    t.planned_samples = 1u << 19;
    t.strategy = "points=sobol,decide=pilot";
    const Rendered one = RenderDescription(scene, t);
    for (const auto& [threads, wavefront] : {std::pair{1, 0u}, {3, 300u}, {2, 64u}}) {
      t.threads = threads;
      t.wavefront = wavefront;
      const Rendered other = RenderDescription(scene, t);
      CHECK(SameImage(other, one));
      CHECK(other.result.training.note == one.result.training.note);
      CHECK(other.result.training.rays == one.result.training.rays);
    }
  }
}

TEST_CASE("what the pilot chooses is not far below the best candidate", "[decision]") {
  const std::pair<const char*, SceneDescription> scenes[] = {
      {"dark closed room", Room(0.5, 20)},
      {"bright closed room", Room(0.9, 100)},
      {"split room", SplitRoom()}};
  constexpr std::uint64_t kPlanned = 1u << 23, kRenderSpp = 128;
  for (const auto& [name, scene] : scenes) {
    double best = 0;
    std::string found;
    for (const char* roulette : {"throughput", "adjoint", "throughput:0:2:4"}) {
      const std::string change = std::string("roulette=") + roulette;
      const double efficiency = Efficiency(Decide(scene, change, kPlanned, kRenderSpp));
      best = std::max(best, efficiency);
      found += fmt::format("{} {:.3g}, ", roulette, efficiency);
    }
    const Rendered chosen = Decide(scene, "decide=pilot", kPlanned, kRenderSpp);
    INFO(name << ": " << found << chosen.result.training.note);
    // What must be gained is 8 to 21 percent. Each efficiency has a standard error of 4
    // percent (576 pixels of four observations each).
    CHECK(Efficiency(chosen) > 0.75 * best);
  }
}

TEST_CASE("the pilot of a decision takes a few percent of what it is planned for",
          "[decision]") {
  SceneDescription plane = PolygonLight(32);
  plane.integrator.max_depth = 6;
  for (const std::uint64_t planned :
       {std::uint64_t{1} << 14, std::uint64_t{1} << 19, std::uint64_t{1} << 26}) {
    const Rendered r = Decide(plane, "decide=pilot", planned);
    const auto samples = double(r.result.training.samples);
    CHECK((samples > 0) == (planned > (1u << 14)));
    CHECK(samples < 0.05 * double(std::min(planned, kMostDecidedBy)));
  }
  // Nothing to choose from: paths end after one event.
  SceneDescription direct = SmallRoom(8, 1);
  const Rendered r = Decide(direct, "decide=pilot");
  CHECK(r.result.training.samples == 0);
  CHECK(SameImage(r, Decide(direct, "decide=none")));
}

namespace {

TrialMeasure MeasureOf(double cost, double variance, unsigned seed = 1) {
  std::mt19937 engine(seed);
  std::exponential_distribution<double> scatter(1 / variance);
  TrialMeasure m;
  m.cost = cost;
  for (int i = 0; i < 2000; ++i) m.variances.push_back(scatter(engine));
  return m;
}

}  // namespace

TEST_CASE("one strategy is clearly better only by variance times cost", "[decision]") {
  const TrialMeasure usual = MeasureOf(3, 1);
  // Planted: the cost, or the variance, left out would turn these around.
  CHECK_FALSE(IsClearlyBetter(MeasureOf(6, 0.7), usual, 0.95));
  CHECK_FALSE(IsClearlyBetter(MeasureOf(2, 1.6), usual, 0.95));
  CHECK(IsClearlyBetter(MeasureOf(6, 0.4), usual, 0.95));
  CHECK(IsClearlyBetter(MeasureOf(2, 1.2), usual, 0.95));
  CHECK_FALSE(IsClearlyBetter(usual, MeasureOf(6, 0.4), 0.95));
  // By less than the margin.
  CHECK(IsClearlyBetter(MeasureOf(3, 0.9), usual, 0.95));
  CHECK_FALSE(IsClearlyBetter(MeasureOf(3, 0.9), usual, 0.87));
}

TEST_CASE("single pixels do not decide", "[decision]") {
  const TrialMeasure usual = MeasureOf(1, 1);
  TrialMeasure lucky = usual, unlucky = MeasureOf(1, 0.8);
  TrialMeasure bright = usual;
  bright.variances[700] = 1e6;
  CHECK_FALSE(IsClearlyBetter(lucky, bright, 0.95));
  unlucky.variances[31] = 1e6;
  CHECK(IsClearlyBetter(unlucky, usual, 0.95));
  // One in twenty is the strategy's own.
  for (std::size_t i = 0; i < unlucky.variances.size(); i += 20) {
    unlucky.variances[i] = 100;
  }
  CHECK_FALSE(IsClearlyBetter(unlucky, usual, 0.95));
  // Equal ones from other samples: a difference of chance, by two standard errors about
  // one time in fifty, and by 5 percent as well.
  int better = 0;
  for (unsigned seed = 2; seed < 102; ++seed) {
    better += IsClearlyBetter(MeasureOf(1, 1, seed), usual, 0.95);
  }
  CHECK(better < 5);
}

TEST_CASE("gains are of all pixels, and know how sure they are", "[decision]") {
  const TrialMeasure usual = MeasureOf(3, 1), other = MeasureOf(6, 0.7, 2);
  // Means of 2000 exponential variables each: a standard error of 0.032 together.
  const TrialGain gain = GainOf(other, usual);
  CHECK(gain.standard_error == Approx(0.0316).epsilon(0.1));
  CHECK(std::abs(gain.log - std::log(3 / 4.2)) < 5 * gain.standard_error);
  CHECK(GainOf(usual, other).log == Approx(-gain.log));
  CHECK(GainOf(usual, usual).log == 0);
  CHECK(GainOf(usual, usual).standard_error == 0);
  // Two pixels of 2000 carry most of the error. Planted: left out, as the worst
  // thousandth.
  TrialMeasure rare = MeasureOf(1, 1, 3);
  rare.variances[5] = rare.variances[1700] = 3000;
  const TrialGain of_rare = GainOf(MeasureOf(1, 1, 3), rare);
  CHECK(of_rare.log == Approx(std::log(4)).epsilon(0.1));
  CHECK(of_rare.standard_error > 0.4);
  // Nothing was seen of one, or of both.
  const TrialMeasure none = {1, std::vector<double>(2000)};
  CHECK(GainOf(none, none).log == 0);
  CHECK(GainOf(none, usual).log > 10);
  CHECK(GainOf(usual, none).log < -10);
}

TEST_CASE("what few bright samples carry is not chosen", "[decision]") {
  TriedStrategy entry;
  entry.paired = true;
  entry.measure = MeasureOf(1, 1, 2);
  entry.usual = MeasureOf(3, 1, 2);
  CHECK(entry.Beyond(1.05, 2) == Approx(std::log(3 / 1.05)));
  // Both have met the same bright samples: the gain is as large, and looks as sure.
  const auto bright = [&](std::size_t pixels) {
    for (std::size_t i = 0; i < pixels; ++i) {
      entry.measure.variances[90 * i] = entry.usual.variances[90 * i] = 1e5;
    }
  };
  bright(3);
  CHECK(entry.Gain().log == Approx(std::log(3)).epsilon(0.1));
  CHECK(EffectivePixels(entry.measure.variances) == Approx(3).epsilon(0.1));
  CHECK(entry.IsCarriedByFew());
  CHECK(entry.Beyond(1.05, 2) == 0);
  bright(20);
  CHECK_FALSE(entry.IsCarriedByFew());
  CHECK_FALSE(entry.IsToldByTheRest());
  CHECK(entry.Beyond(1.05, 2) > 1);
  // No error at all is not carried by anything.
  entry.measure = {1, std::vector<double>(2000)};
  CHECK_FALSE(entry.IsCarriedByFew());
  CHECK(entry.Beyond(1.05, 2) > 10);
}

// Where few pixels carry the error, a roulette that is milder than the default is judged
// by all others. Planted: by the few as well; any other change as if it were one.
TEST_CASE("what cannot vary more is told by the rest of the pixels", "[decision]") {
  TriedStrategy entry;
  entry.measure = MeasureOf(1.2, 0.5, 2);
  entry.usual = MeasureOf(1, 1, 2);
  // A bright sample that the usual strategy has not met, though it may.
  entry.measure.variances[700] = 1e5;
  CHECK(entry.IsCarriedByFew());
  CHECK(entry.Beyond(1.05, 0.5) == 0);
  CHECK(entry.Gain().log < -2);
  entry.lives_longer = true;
  CHECK(entry.IsToldByTheRest());
  CHECK(entry.Beyond(1.05, 0.5) ==
        Approx(std::log(1 / (1.2 * 0.5) / 1.05)).epsilon(0.02));
  // Not better, by all others either.
  entry.measure.cost = 2.2;
  CHECK(entry.Beyond(1.05, 0.5) == 0);
}

TEST_CASE("paths live longer by a milder roulette alone", "[decision]") {
  const PreparedScene scene = PrepareScene(SplitRoom());
  const TrainingOptions training;
  const auto lives_longer = [&](const std::string& given, const std::string& changes) {
    PlanOptions options = WithChanges(scene, {}, given);
    StrategyTrial trial(scene, training, 1, 1 << 16);
    TriedStrategy usual = ToTry(scene, options, "", 1);
    TriedStrategy tried = ToTry(scene, options, changes, 1);
    trial.Begin(1024);
    REQUIRE(trial.Try(usual, usual));
    REQUIRE(trial.Try(tried, usual));
    CHECK_FALSE(usual.lives_longer);
    return tried.lives_longer;
  };
  CHECK(lives_longer("", "roulette=throughput:0:2:4"));
  CHECK(lives_longer("", "roulette=throughput:0.2"));
  CHECK(lives_longer("", "roulette=none"));
  CHECK_FALSE(lives_longer("", "roulette=throughput:0:1"));
  CHECK_FALSE(lives_longer("", "roulette=throughput:0:2:0.5"));
  CHECK_FALSE(lives_longer("", "roulette=constant"));
  CHECK_FALSE(lives_longer("", "roulette=adjoint"));
  CHECK_FALSE(lives_longer("", "roulette=none,directions=bsdf"));
  CHECK_FALSE(lives_longer("roulette=none", "roulette=throughput:0:2:4"));
}

TEST_CASE("variances of samples that depend on each other are of their observations",
          "[decision]") {
  // Pixels of four observations, whose samples take turns: all of one are the same.
  std::mt19937 engine(5);
  std::normal_distribution<float> normal(1, 0.25f);
  TrainingWork work;
  work.spp = 8;
  TrainingSamples samples;
  samples.observations = 4;
  for (std::uint32_t pixel = 0; pixel < 64 * 64; ++pixel) {
    work.pixels.push_back(pixel);
    float of_one[4];
    for (float& v : of_one) v = normal(engine);
    for (std::uint32_t k = 0; k < work.spp; ++k) {
      const float v = of_one[k % 4];
      samples.colors.push_back({v, v, v});
    }
  }
  const ImageGuess image(64, 64, work.pixels, samples.colors);
  const double weight = 1 / (1 + 0.01);
  // Two samples of an observation are worth one. 2 sigma^4 / 3 is the variance of each
  // pixel's; six standard errors: 2e-9.
  const auto mean = [](const std::vector<double>& values) {
    double sum = 0;
    for (double v : values) sum += v;
    return sum / double(values.size());
  };
  const double noise = 6 * std::sqrt(2.0 / 3 / (64 * 64)) + 0.02;
  CHECK(mean(RelativeVariances(samples, work, image)) ==
        Approx(2 * 0.0625 * weight).epsilon(noise));
  // The mean of 16 pixels that are independent has a sixteenth of that, and of pixels
  // that are one and the same as much as each.
  std::vector<std::size_t> square(16), one(16, 7);
  double of_means = 0;
  for (std::size_t first = 0; first < work.pixels.size(); first += 16) {
    std::iota(square.begin(), square.end(), first);
    of_means += VarianceOfMean(samples, work, image, square) / (64 * 64 / 16);
  }
  CHECK(of_means ==
        Approx(2 * 0.0625 * weight / 16).epsilon(6 * std::sqrt(2.0 / 3 / 256)));
  CHECK(VarianceOfMean(samples, work, image, one) ==
        Approx(VarianceOfMean(samples, work, image, std::span(one).first(1))));
  // Planted: as if all were independent.
  samples.observations = 8;
  CHECK(mean(RelativeVariances(samples, work, image)) <
        2 * 0.0625 * weight * (1 - 2 * noise));
}

}  // namespace lanelight::test
