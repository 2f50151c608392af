// decide=pilot: what it chooses, and that the image is bit-identical to that of the
// choice.
#include <catch2/catch.hpp>

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

// Returns the number behind the last place of `words` in a note.
double NumberAfter(const std::string& note, const std::string& words) {
  const std::size_t place = note.rfind(words);
  return place == std::string::npos ? NAN
                                    : std::strtod(&note[place + words.size()], nullptr);
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

TEST_CASE("the trial run chooses a milder roulette where late light dominates",
          "[decision]") {
  // Path reuse is not available with a control variate.
  const Rendered r = Decide(Room(0.9, 100), "control=regression,decide=pilot");
  INFO(r.result.training.note);
  CHECK(r.result.roulette == Roulette::kThroughput);
  CHECK(r.result.training.changes == "roulette=throughput:0:2:4,decide=none");
  CHECK(r.result.training.gain ==
        Approx(NumberAfter(r.result.training.note, "roulette=throughput:0:2:4 "))
            .epsilon(0.01));
  CHECK(r.result.training.filtered_gain == r.result.training.gain);
  CHECK_THAT(r.result.training.note,
             Catch::Contains("rendered with roulette=throughput:0:2:4") &&
                 Catch::Contains("roulette=adjoint"));
  // The image is what it is with that asked for: the pilot leaves nothing behind.
  CHECK(SameImage(
      r, Decide(Room(0.9, 100), "control=regression,roulette=throughput:0:2:4")));
}

TEST_CASE("a trial next to a splitting roulette renders with that roulette",
          "[decision]") {
  SceneDescription corridor =
      ParseScene(std::string(LANELIGHT_SOURCE_DIR) + "/scenes/corridor.pbrt");
  corridor.film.width = corridor.film.height = 64;
  const Rendered r = Decide(corridor, "decide=pilot,roulette=adjoint", 1u << 20);
  INFO(r.result.training.note);
  CHECK(r.result.samples == 64 * 64 * 4);
  CHECK_THAT(r.result.training.changes, !Catch::Contains("reuse"));
}

TEST_CASE("the trial run chooses path reuse where indirect light dominates",
          "[decision]") {
  const Rendered r = Decide(Room(0.9, 100), "decide=pilot");
  INFO(r.result.training.note);
  CHECK(r.result.training.changes == "roulette=throughput:0:2:4,reuse=block,decide=none");
  CHECK(r.film.groups().dependents > 10);  // of pixels that share paths
  // The gain of the roulette, times that of path reuse beside it.
  const std::string& note = r.result.training.note;
  const double roulette = NumberAfter(note, "roulette=throughput:0:2:4 ");
  CHECK(r.result.training.gain ==
        Approx(roulette * NumberAfter(note, "reuse=block gains ")).epsilon(0.01));
  CHECK(r.result.training.filtered_gain <
        r.result.training.gain);  // a filter removes less noise of shared paths
  CHECK(SameImage(r, Decide(Room(0.9, 100), "roulette=throughput:0:2:4,reuse=block")));
  // Nothing is shared by what leaves after one event, nor by mirrors.
  SceneDescription plane = PolygonLight(32);
  plane.integrator.max_depth = 6;
  const Rendered none = Decide(plane, "decide=pilot");
  CHECK(none.result.training.changes == "decide=none");
  CHECK(none.result.training.gain == 0);
  CHECK(none.film.groups().dependents == 1);
}

TEST_CASE("the trial run considers path reuse only where spectral paths support it",
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

TEST_CASE("the trial run shortens paths that cost more than they gain", "[decision]") {
  // Nothing ends a path but the depth: that has the least variance by far the most rays.
  const Rendered r = Decide(SplitRoom(40), "roulette=throughput:1,decide=pilot");
  INFO(r.result.training.note);
  CHECK(r.result.training.changes != "decide=none");
}

TEST_CASE("the trial run keeps the strategy where no change is more efficient",
          "[decision]") {
  // After one event on the plane paths leave.
  SceneDescription plane = PolygonLight(32);
  plane.integrator.max_depth = 6;
  for (const char* strategy : {"", "roulette=throughput:0.05:5,", "points=halton,"}) {
    const std::string text = strategy;
    const Rendered r = Decide(plane, text + "decide=pilot");
    INFO(text << ": " << r.result.training.note);
    CHECK(r.result.training.changes == "decide=none");
    CHECK(SameImage(r, Decide(plane, text + "decide=none")));
  }
}

TEST_CASE("a decision does not depend on threads or wavefronts", "[decision]") {
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

TEST_CASE("the trial run's choice is close to the best candidate", "[decision]") {
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
    // The required gain is 8 to 21 percent. Each efficiency has a standard error of 4
    // percent (576 pixels of four observations each).
    CHECK(Efficiency(chosen) > 0.75 * best);
  }
}

TEST_CASE("the trial run takes a few percent of the planned samples", "[decision]") {
  SceneDescription plane = PolygonLight(32);
  plane.integrator.max_depth = 6;
  for (const std::uint64_t planned :
       {std::uint64_t{1} << 14, std::uint64_t{1} << 19, std::uint64_t{1} << 26}) {
    const Rendered r = Decide(plane, "decide=pilot", planned);
    const auto samples = double(r.result.training.samples);
    CHECK((samples > 0) == (planned > (1u << 14)));
    CHECK(samples < 0.05 * double(std::min(planned, kMaxTrialSamples)));
  }
  // Nothing to choose from: paths end after one event.
  SceneDescription direct = SmallRoom(8, 1);
  const Rendered r = Decide(direct, "decide=pilot");
  CHECK(r.result.training.samples == 0);
  CHECK(SameImage(r, Decide(direct, "decide=none")));
}

}  // namespace lanelight::test
