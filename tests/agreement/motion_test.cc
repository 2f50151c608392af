// Motion: the wavefront agrees with closed forms, and with the scalar reference, which
// renders stills. Still scenes have no column or stage for it.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "tests/agreement/agreement.h"

namespace lanelight::test {
namespace {

EndTransform End(const Transform& t) { return std::make_shared<const Transform>(t); }

// The last shape, moving from `start` to `end` instead.
void MoveLast(SceneBuilder& b, const Transform& start, const Transform& end) {
  SceneDescription& scene = b.scene();
  const auto object = static_cast<Index>(scene.objects.size());
  scene.objects.push_back({"", {scene.shapes.back()}});
  scene.objects.back().shapes[0].world_from_object = {};
  scene.shapes.pop_back();
  scene.instances.push_back({object, start, {}, End(end)});
}

// Mean over pixels (x, y) of a function of film coordinates, by the midpoint rule.
template <typename F>
std::function<Rgb(int, int)> PixelMeans(const F& f) {
  return [f](int x, int y) {
    constexpr int kSub = 64;
    double sum = 0;
    for (int i = 0; i < kSub * kSub; ++i) {
      sum += f(x + (i % kSub + 0.5) / kSub, y + (i / kSub + 0.5) / kSub);
    }
    return Grey(sum / (kSub * kSub));
  };
}

void CheckMeans(const SceneDescription& scene, const std::function<Rgb(int, int)>& exact,
                const std::string& strategy = "") {
  const auto image = RenderWavefront(scene, 8192, strategy);
  stat::CheckSame(
      stat::CompareMeans(image, stat::ExpectedImage(image.width, image.height, exact),
                         {4, 1e-6, 2e-3, 1e-5}),
      0.1, strategy);
}

// Part of the time for which x, between `open` and `close`, is at most `at`.
double Passed(double at, double open, double close) {
  return std::clamp((at - open) / (close - open), 0.0, 1.0);
}

// A sector of a disk of this albedo that turns before an environment of radiance 1: what
// it hides it gives back times the albedo.
constexpr double kSector = 60, kTurned = 90, kAlbedo = 0.25;

SceneDescription TurningSector(int size) {
  SceneBuilder b(size, size);
  b.Depth(1).Orthographic({0, 0, 5}, {0, 0, 0}, {0, 1, 0}, 1);
  b.AddEnvironment(Grey(1));
  b.AddDisk({0, 0, 0}, {0, 0, 1}, 0.9, b.AddDiffuse(Grey(kAlbedo))).phi_max = kSector;
  const Transform start = Transform::Rotate(10, {0, 0, 1});
  MoveLast(b, start, Transform::Rotate(10 + kTurned, {0, 0, 1}));
  return b.Build();
}

// Part of the time for which the sector covers a direction.
double Covered(double degrees) {
  const double behind = degrees - 10 - kSector;  // the sector's end is that far off
  return Passed(degrees - 10, 0, kTurned) - Passed(behind, 0, kTurned);
}

// A plane under a light from above, and a square that passes between, dark itself.
constexpr double kHalf = 0.4, kFrom = -0.9, kTo = 0.5;

SceneDescription PassingShadow(int size) {
  SceneBuilder b(size, size);
  // The square passes above the camera, which looks down.
  b.Depth(1).Orthographic({0, 0, 1}, {0, 0, 0}, {0, 1, 0}, 1);
  b.AddDistant({0, 0, 1}, Grey(2));
  b.AddPlane({0, 0, 0}, {0, 0, 1}, b.AddDiffuse(Grey(0.5)));
  b.AddQuad({-kHalf, -kHalf, 0}, {2 * kHalf, 0, 0}, {0, 2 * kHalf, 0},
            b.AddDiffuse(Grey(0)));
  MoveLast(b, Transform::Translate({kFrom, 0, 2}), Transform::Translate({kTo, 0, 2}));
  return b.Build();
}

double Unshadowed(double x, double y) {
  if (std::abs(y) > kHalf) return 1;
  return 1 - (Passed(x + kHalf, kFrom, kTo) - Passed(x - kHalf, kFrom, kTo));
}

// World coordinates of film positions of these views, x to the left or right.
double Across(double film, int size) { return 2 * film / size - 1; }

constexpr const char* kStrategies[] = {"points=independent", "points=sobol",
                                       "points=stratified", "pairs=antithetic"};

}  // namespace

TEST_CASE("a rotating sector covers each direction for the expected fraction of the time",
          "[agreement][motion]") {
  const int size = 8;
  // Seen against z: x to the left (pbrt's cameras are left-handed).
  const auto exact = PixelMeans([&](double fx, double fy) {
    const double x = -Across(fx, size), y = -Across(fy, size);
    if (std::hypot(x, y) > 0.9) return 1.0;
    double degrees = std::atan2(y, x) * 180 / std::numbers::pi;
    if (degrees < 0) degrees += 360;
    return 1 - (1 - kAlbedo) * Covered(degrees);
  });
  for (const char* strategy : kStrategies) {
    CheckMeans(TurningSector(size), exact, strategy);
  }
}

TEST_CASE("a moving shadow darkens by the fraction of the time", "[agreement][motion]") {
  const int size = 8;
  const auto exact = PixelMeans([&](double fx, double fy) {
    const double x = -Across(fx, size), y = -Across(fy, size);
    return 0.5 / std::numbers::pi * 2 * Unshadowed(x, y);
  });
  for (const char* strategy : kStrategies) {
    CheckMeans(PassingShadow(size), exact, strategy);
  }
}

TEST_CASE("objects stand still after their end time while the shutter is open",
          "[agreement][motion]") {
  const int size = 8;
  SceneDescription scene = PassingShadow(size);
  scene.camera.time_first = -1;
  scene.camera.time_rate = 4;  // a quarter of the time before it moves, a half after it
  const auto exact = PixelMeans([&](double fx, double fy) {
    const double x = -Across(fx, size), y = -Across(fy, size);
    const auto still = [&](double at) {
      return std::abs(x - at) > kHalf || std::abs(y) > kHalf ? 1.0 : 0.0;
    };
    return 1 / std::numbers::pi *
           (0.25 * still(kFrom) + 0.25 * Unshadowed(x, y) + 0.5 * still(kTo));
  });
  CheckMeans(scene, exact);
}

namespace {

// A wall that shines to the right of an edge, and a camera.
SceneBuilder Edge(int size) {
  SceneBuilder b(size, 2);
  b.Depth(0);
  b.AddQuad({-60, -60, 0}, {60, 0, 0}, {0, 120, 0}, b.AddDiffuse(Grey(0)),
            b.AddEmission(Grey(1), true));
  return b;
}

}  // namespace

TEST_CASE("a translating camera blurs an edge into a ramp", "[agreement][motion]") {
  const int size = 16;
  SceneBuilder b = Edge(size);
  b.Orthographic({0, 0, 5}, {0, 0, 0}, {0, 1, 0}, 0.25);
  Camera& camera = b.scene().camera;
  const double from = -0.8, to = 0.6;  // of the camera, to the right
  camera.end = End(Transform::Translate({to, 0, 0}) * camera.world_from_camera);
  camera.world_from_camera =
      Transform::Translate({from, 0, 0}) * camera.world_from_camera;
  const double half = 0.25 * size / 2;
  const auto exact = PixelMeans([&](double fx, double) {
    const double x = -half * Across(fx, size);
    return Passed(-x, from, to);  // the edge is at the place at that time
  });
  for (const char* strategy : kStrategies) CheckMeans(b.Build(), exact, strategy);
}

TEST_CASE("a rotating camera sees an edge for the expected fraction of the time",
          "[agreement][motion]") {
  const int size = 16;
  SceneBuilder b = Edge(size);
  b.Perspective({0, 0, 5}, {0, 0, 0}, {0, 1, 0}, 8);
  Camera& camera = b.scene().camera;
  const double turn = 50;
  const auto turned = [&](double degrees) {
    return End(Transform::Translate({0, 0, 5}) * Transform::Rotate(degrees, {0, 1, 0}) *
               Transform::Translate({0, 0, -5}) * camera.world_from_camera);
  };
  const EndTransform start = turned(-turn / 2);
  camera.end = turned(turn / 2);
  camera.world_from_camera = *start;
  const double scale = std::tan(4 * std::numbers::pi / 180) * size / 2;
  const auto exact = PixelMeans([&](double fx, double) {
    // The angle of the pixel, to the left, and of the edge in the camera's space.
    const double angle = std::atan(-scale * Across(fx, size)) * 180 / std::numbers::pi;
    return 1 - Passed(angle, -turn / 2, turn / 2);
  });
  CheckMeans(b.Build(), exact);
}

namespace {

// A plate and a lid right above it that move together: the plate is never lit, if shadow
// rays are of the time of their paths.
SceneDescription LidOverPlate() {
  SceneBuilder b(8, 8);
  b.Depth(1).Orthographic({0, -5, 1}, {0, 0, 0}, {0, 0, 1}, 1);
  b.AddDistant({0, -0.02, 1}, Grey(1));
  const Transform start = Transform::Translate({-0.9, 0, 0});
  const Transform end =
      Transform::Translate({0.9, 0, 0}) * Transform::Rotate(120, {0, 0, 1});
  b.AddBox({-0.3, -0.3, -0.1}, {0.3, 0.3, 0}, b.AddDiffuse(Grey(1)));
  MoveLast(b, start, end);
  b.AddDisk({0, 0, 0}, {0, 0, 1}, 0.6, b.AddDiffuse(Grey(0))).height = 0.3;
  MoveLast(b, start, end);
  return b.Build();
}

}  // namespace

TEST_CASE("shadow rays have the time of their path", "[agreement][motion]") {
  const auto image = RenderWavefront(LidOverPlate(), 1024);
  double lit = 0;
  for (const Rgb& mean : image.mean) lit += mean.x;
  CHECK(lit == 0);
  // Without the lid much is lit.
  SceneDescription open = LidOverPlate();
  open.instances.pop_back();
  lit = 0;
  for (const Rgb& mean : RenderWavefront(open, 64).mean) lit += mean.x;
  CHECK(lit > 0.1);
}

namespace {

// Things that move in all ways: a box that turns, is stretched and mirrored; a metal
// ball; a chequered disk with cut-outs that spins; a glass ball that stands. The camera
// goes along and turns.
SceneDescription Everything(bool camera_moves) {
  SceneBuilder b(12, 8);
  b.Depth(4).Perspective({0, -7, 4}, {0, 0, 0.5}, {0, 0, 1}, 32);
  Texture checks;
  checks.kind = TextureKind::kCheckerboard;
  checks.tex1.constant = {0.9, 0.3, 0.2};
  checks.tex2.constant = {0.1, 0.4, 0.8};
  checks.mapping = {6, 3, 0.1, 0.2};
  b.scene().textures.push_back(checks);
  checks.is_float = true;
  checks.tex1.constant = Grey(1), checks.tex2.constant = Grey(0);
  b.scene().textures.push_back(checks);
  Material chequered;
  chequered.reflectance.texture = 0;
  const Index painted = b.AddMaterial(chequered);
  const auto move = Transform::Translate;
  b.AddBox({-0.5, -0.4, -0.3}, {0.5, 0.4, 0.3}, painted);
  MoveLast(b, move({-1.8, 0, 0.6}) * Transform::Scale({-1, 1, 1}),
           move({-1.2, 0.5, 0.8}) * Transform::Rotate(70, {1, 0.4, 0.2}) *
               Transform::Scale({-1.2, 0.8, 1.5}));
  b.AddSphere({}, 0.5, b.AddConductor({0.2, 0.9, 1.1}, {3.9, 2.5, 2.2}, 0.3));
  MoveLast(b, move({0, 0, 0.6}), move({0.5, -0.8, 1.1}));
  b.AddDisk({}, {0, 0, 1}, 0.8, painted).alpha.texture = 1;
  MoveLast(b, move({1.5, 0.5, 0.9}) * Transform::Rotate(60, {1, 0, 0}),
           move({1.5, 0.5, 0.9}) * Transform::Rotate(60, {1, 0, 0}) *
               Transform::Rotate(100, {0, 0, 1}));
  b.AddSphere({1.2, -1.4, 0.5}, 0.4, b.AddDielectric(1.5));
  b.AddPlane({0, 0, 0}, {0, 0, 1}, b.AddDiffuse(Grey(0.5)));
  b.AddQuad({-2, -2, 4}, {0, 3, 0}, {3, 0, 0}, b.AddDiffuse(Grey(0)),
            b.AddEmission({6, 6, 5}));
  b.AddEnvironment({0.3, 0.35, 0.4});
  if (camera_moves) {
    Camera& camera = b.scene().camera;
    camera.end = End(move({0.3, 0.2, -0.3}) * camera.world_from_camera *
                     Transform::Rotate(6, {0.2, 1, 0.5}));
  }
  return b.Build();
}

// Silhouettes of triangles for balls, and the reference's times.
constexpr double kTwinTolerance = 3e-3;

void CheckTwin(const SceneDescription& scene) {
  stat::CheckSame(CompareWithReference(scene, 8192, 4000, kTwinTolerance), 0.06);
}

}  // namespace

TEST_CASE("wavefront agrees on moving objects", "[agreement][motion]") {
  CheckTwin(Everything(false));
}

TEST_CASE("wavefront agrees on moving objects and a moving camera",
          "[agreement][motion]") {
  CheckTwin(Everything(true));
}

TEST_CASE("leaving out the motion is detected", "[agreement][motion]") {
  SceneDescription still = Everything(false);
  for (Instance& instance : still.instances) instance.end = nullptr;
  CHECK_FALSE(stat::CompareMeans(RenderWavefront(Everything(false), 2048),
                                 RenderWavefront(still, 2048))
                  .same);
}

TEST_CASE("strategies agree on moving objects", "[agreement][motion]") {
  const SceneDescription scene = Everything(true);
  const auto plain = RenderWavefront(scene, 8192);
  for (const char* strategy :
       {"roulette=adjoint", "light-candidates=resampled", "directions=uniform",
        "pairs=antithetic", "control=regression", "light-selection=tree",
        "seen-lights=paths", "points=halton", "points=stratified"}) {
    stat::CheckSame(stat::CompareMeans(RenderWavefront(scene, 4096, strategy), plain,
                                       {4, 1e-6, 1e-3, 1e-7}),
                    strategy);
  }
}

TEST_CASE("images with motion are bit-identical for any threads and wavefront size",
          "[agreement][motion]") {
  TestRender base;
  base.spp = 12;
  base.threads = 1;
  base.wavefront = 1000;
  base.sampler = SampleSequence::kSobol;
  const SceneDescription scene = Everything(true);
  const Rendered reference = RenderDescription(scene, base);
  for (const std::uint32_t wavefront : {64u, 192u, 8192u}) {
    TestRender other = base;
    other.threads = 2;
    other.wavefront = wavefront;
    INFO("wavefront " << wavefront);
    CHECK(Identical(RenderDescription(scene, other).film, reference.film));
  }
  TestRender seeded = base;
  seeded.seed = 2;
  CHECK_FALSE(Identical(RenderDescription(scene, seeded).film, reference.film));
}

TEST_CASE("only scenes with motion have motion stages and columns",
          "[agreement][motion]") {
  const FeatureSet any = {Feature::kMotion, Feature::kMovingInstances,
                          Feature::kMovingCamera};
  TestRender options;
  options.spp = 1;
  const auto has_column = [](const Plan& plan) {
    const auto& live = plan.live_fields;
    return std::find(live.begin(), live.end(), Field::time) != live.end();
  };
  const auto has_stage = [](const Plan& plan) {
    return std::any_of(plan.paths().stages.begin(), plan.paths().stages.end(),
                       [](const auto& planned) {
                         return std::string_view(planned.stage.name) == "motion";
                       });
  };
  const SceneDescription room = SmallRoom(8, 3);
  const CompiledScene still = CompileScene(room);
  CHECK_FALSE(still.features.HasAny(any));
  CHECK(still.geometry.motions.capacity() == 0);
  const Plan without = RenderDescription(room, options).plan;
  CHECK_FALSE(has_column(without));
  CHECK_FALSE(has_stage(without));
  const CompiledScene moving = CompileScene(Everything(false));
  CHECK(moving.features.HasAll({Feature::kMotion, Feature::kMovingInstances}));
  CHECK_FALSE(moving.features.Has(Feature::kMovingCamera));
  CHECK(moving.geometry.motions.size() == 3);
  const Plan with = RenderDescription(Everything(false), options).plan;
  CHECK(has_column(with));
  CHECK(has_stage(with));
  CHECK(CompileScene(Everything(true)).features.HasAll(any));
}

}  // namespace lanelight::test
