// The bidirectional reference tracer against the path tracer, and light-paths=splats
// against the bidirectional reference tracer and closed forms. Errors come from the
// scatter of renders with different seeds.
#include <catch2/catch.hpp>
#include <numbers>

#include "src/base/core/parallel.h"
#include "tests/reference/bidirectional.h"
#include "tests/reference/camera.h"
#include "tests/reference/closed_forms.h"
#include "tests/reference/scenes.h"
#include "tests/vocabulary/strategy/tiles.h"

namespace lanelight::test {
namespace {

constexpr int kSide = 8, kRenders = 32;
constexpr double kFalseAlarm = 1e-6;  // of each comparison

using Renders = std::vector<stat::ImageEstimate>;

struct Comparison {
  bool same = true;
  double detectable_bias = 0;  // of the whole image
  std::string text;
};

// The image as a whole and tile by tile, each by itself: the pixels of a render depend on
// each other.
Comparison Compare(const Renders& a, const Renders& b) {
  Comparison out;
  for (const int tile : {kSide, kSide / 4}) {
    const auto tiles_a = TilesOf(a, tile), tiles_b = TilesOf(b, tile);
    const std::size_t tiles = tiles_a.mean.size();
    for (std::size_t i = 0; i < tiles; ++i) {
      const auto pixel = [&](const stat::ImageEstimate& of) {
        return stat::ImageEstimate{1, 1, of.observations, {of.mean[i]}, {of.variance[i]}};
      };
      const auto result =
          stat::CompareMeans(pixel(tiles_a), pixel(tiles_b),
                             {1, kFalseAlarm / double(tiles), kFloatTolerance, 1e-7});
      if (tile == kSide) out.detectable_bias = result.detectable_bias;
      if (result.same && tile != kSide) continue;
      out.same = out.same && result.same;
      out.text += fmt::format("tile {} of {}: {}\n", i, tiles, result.ToString());
    }
  }
  return out;
}

void CheckSame(const Comparison& result, double power, const std::string& what) {
  INFO(what << ": " << result.text);
  CHECK(result.same);
  CHECK(result.detectable_bias < power);
}

template <class Render>
auto Repeat(const Render& render) {
  std::vector<decltype(render(std::uint64_t{0}))> out(kRenders);
  ParallelFor(out.size(), [&](std::size_t i) { out[i] = render(i); });
  return out;
}

stat::ImageEstimate Image(std::vector<Rgb> mean) {
  mean.resize(kSide * kSide);
  return {kSide, kSide, 2, mean, std::vector<Rgb>(mean.size())};
}

// The sum of the images of these techniques.
stat::ImageEstimate Sum(const TechniqueImages& images, const TechniqueSet& of) {
  std::vector<Rgb> sum(kSide * kSide);
  for (const auto& [technique, image] : images) {
    for (std::size_t i = 0; of(technique) && i < sum.size(); ++i) sum[i] += image[i];
  }
  return Image(sum);
}

std::vector<BidirectionalImages> RenderTwin(const SceneDescription& scene,
                                            BidirectionalOptions options,
                                            std::uint64_t seed = 100) {
  return Repeat([&](std::uint64_t i) {
    BidirectionalOptions own = options;
    own.seed = seed + i;
    return RenderBidirectional(scene, own);
  });
}

// Renders by the path tracer: for each number of scattering events, the light of paths
// with as many. All depth limits get the same random numbers, so that images of fewer
// events cancel.
std::vector<Renders> RenderTruths(const SceneDescription& scene, int samples) {
  const int depths = scene.integrator.max_depth + 1;
  const reference::Geometry geometry(scene, {});
  const reference::Lights lights(scene, geometry, {});
  const reference::CameraRays camera(scene.camera, scene.film);
  const auto by_render = Repeat([&](std::uint64_t seed) {
    std::vector<std::vector<Rgb>> images(depths, std::vector<Rgb>(kSide * kSide));
    reference::Random random(1000 + seed);
    TwinOptions options;
    for (int i = 0; i < samples * kSide * kSide; ++i) {
      const int pixel = i % (kSide * kSide);
      const double x = pixel % kSide + random.Uniform();
      const double y = pixel / kSide + random.Uniform();
      const reference::Ray ray = camera.Sample(x, y, random).ray;
      const reference::Random start = random;
      Rgb before;
      for (int depth = 0; depth < depths; ++depth) {
        random = start;
        options.max_depth = depth;
        const Rgb light =
            ReferenceRadiance(scene, geometry, lights, ray, options, random);
        images[depth][pixel] += (light - before) / samples;
        before = light;
      }
    }
    return images;
  });
  std::vector<Renders> out(depths);
  for (int depth = 0; depth < depths; ++depth) {
    for (const auto& images : by_render) out[depth].push_back(Image(images[depth]));
  }
  return out;
}

bool All(Technique) { return true; }
bool Hits(Technique of) { return of.s == 0; }
bool WithLightSamples(Technique of) { return of.s == 0 || (of.s == 1 && of.t > 1); }
bool IsSplat(Technique of) { return of.t == 1 && of.s > 1; }
bool OfProduct(Technique of) { return WithLightSamples(of) || IsSplat(of); }

TriangleMesh Tilted(Vec3d corner, Vec3d e1, Vec3d e2) {
  TriangleMesh mesh;
  mesh.positions = {corner, corner + e1, corner + e1 + e2, corner + e2};
  mesh.indices = {0, 1, 2, 0, 2, 3};
  const Vec3d n = Normalize(Cross(e1, e2)), x = Normalize(e1), y = Normalize(e2);
  mesh.normals = {n - 0.6 * x - 0.3 * y, n + 0.5 * x - 0.4 * y, n + 0.4 * x + 0.6 * y,
                  n - 0.3 * x + 0.5 * y};
  return mesh;
}

// Surfaces of every kind that do not touch: all connections have a finite variance.
SceneDescription Plates(int max_depth) {
  SceneBuilder b(kSide, kSide);
  b.Depth(max_depth).Perspective({0.2, -4, 1.6}, {-0.1, 0, 0.8}, {0, 0, 1}, 38);
  const Index grey = b.AddDiffuse({0.9, 0.8, 0.7}), red = b.AddDiffuse({0.9, 0.4, 0.3});
  const Index metal = b.AddConductor({0.2, 0.9, 1.1}, {3.9, 2.5, 2.2}, 0.6);
  b.AddQuad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, grey);
  b.AddQuad({-1, 1.3, 0.3}, {2, 0, 0}, {0, 0, 1.8}, metal);
  b.AddMesh(Tilted({-1.4, -0.6, 0.4}, {0, 1.2, 0}, {0, 0, 1.2}), red);
  b.AddSphere({0.5, -0.2, 0.8}, 0.4, b.AddDielectric(1.5, 0.6));
  b.AddQuad({-0.4, -0.4, 2}, {0, 0.8, 0}, {0.8, 0, 0}, red, b.AddEmission({9, 8, 7}));
  return b.Build();
}

// A room with a box, balls of metal and glass, a panel with tilted normals, and lamps of
// several shapes, one with two sides.
SceneDescription Room(int max_depth) {
  SceneBuilder b(kSide, kSide);
  b.scene() = SmallRoom(kSide, max_depth, 0.3);
  const Index glass = b.AddDielectric(1.5), black = b.AddDiffuse(Grey(0));
  b.AddSphere({-0.45, 0.3, 0.5}, 0.3, glass);
  b.AddMesh(Tilted({0.3, 1.1, -0.5}, {0.6, 0, 0}, {0, 0.5, -0.3}), 0);
  b.AddDisk({-0.9, 1.5, 0.2}, {1, 0, 0.1}, 0.2, black, b.AddEmission({5, 7, 9}));
  b.AddSphere({-0.3, 1.5, -0.4}, 0.1, black, b.AddEmission({12, 9, 7}));
  b.AddQuad({0.2, 1.5, -0.2}, {0.4, 0, 0}, {0, 0.2, 0.4}, black,
            b.AddEmission({8, 8, 6}, true));
  return b.Build();
}

// A lamp close over a floor with tilted normals, which lights a wall. The camera sees
// the lamp in a mirror.
SceneDescription TiltedFloor() {
  SceneBuilder b(kSide, kSide);
  b.Depth(2).Perspective({-3, 0, 0.8}, {0, 0, 0.5}, {0, 0, 1}, 40);
  const Index grey = b.AddDiffuse(Grey(0.8)), black = b.AddDiffuse(Grey(0));
  TriangleMesh floor = Tilted({-2, -2, 0}, {3, 0, 0}, {0, 4, 0});
  floor.normals.assign(4, {0.75, 0.2, 0.63});
  b.AddMesh(floor, grey);
  b.AddQuad({1, -2, 0}, {0, 0, 2}, {0, 4, 0}, grey);
  b.AddQuad({-1.2, -0.5, 0.01}, {0.8, 0, 0}, {0, 1, 0},
            b.AddConductor({0.2, 0.9, 1.1}, {3.9, 2.5, 2.2}));
  b.AddQuad({-0.2, -0.3, 0.3}, {0, 0.6, 0}, {0.6, 0, 0}, black, b.AddEmission({9, 9, 9}));
  return b.Build();
}

// A lamp in the middle of a ball of glass, over a floor.
constexpr double kLampRadius = 0.2, kBallRadius = 0.5, kIndex = 1.5;
constexpr Rgb kLampRadiance = {40, 30, 20}, kFloor = {0.7, 0.5, 0.3};

SceneDescription LampInGlass(Vec3d eye, double fov) {
  SceneBuilder b(kSide, kSide);
  b.Depth(2).Perspective(eye, {eye.x, 0, 0}, {0, 1, 0}, fov);
  b.AddPlane({0, 0, 0}, {0, 0, 1}, b.AddDiffuse(kFloor));
  b.AddSphere({0, 0, 1}, kBallRadius, b.AddDielectric(kIndex));
  b.AddSphere({0, 0, 1}, kLampRadius, b.AddDiffuse(Grey(0)),
              b.AddEmission(kLampRadiance));
  return b.Build();
}

// Rays that pass the centre at the distance h < index * radius of the lamp meet it at the
// distance h / index. Their radiance is that of the lamp times (1 - R) / index^2.
Rgb LampInGlassOnFloor(Vec3d p) {
  constexpr int kSteps = 200;
  const double reach = kIndex * kLampRadius;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double h = reach * (i + 0.5) / kSteps, sine = h / kBallRadius;
    const double passes = 1 - closed_form::Fresnel(std::sqrt(1 - sine * sine), kIndex);
    sum += passes / (kIndex * kIndex) * h * reach / kSteps;
  }
  const Vec3d to = Vec3d{0, 0, 1} - p;
  const double d2 = Dot(to, to), cosine = to.z / std::sqrt(d2);
  return kFloor * kLampRadiance * (2 * sum * cosine / d2);
}

// A lamp that faces the floor, beside a mirror that reflects it.
const std::vector<Vec3d> kLamp = {
    {0.2, -0.1, 0.9}, {0.2, 0.1, 0.9}, {0.4, 0.1, 0.9}, {0.4, -0.1, 0.9}};
constexpr double kMirror = 1.2;

SceneDescription LampAndMirror() {
  SceneBuilder b(kSide, kSide);
  b.Depth(2).Perspective({0.8, 0, 4}, {0.8, 0, 0}, {0, 1, 0}, 9);
  b.AddPlane({0, 0, 0}, {0, 0, 1}, b.AddDiffuse(kFloor));
  b.AddQuad(kLamp[0], kLamp[1] - kLamp[0], kLamp[3] - kLamp[0], b.AddDiffuse(Grey(0)),
            b.AddEmission(kLampRadiance));
  b.AddQuad({kMirror, -3, 0}, {0, 6, 0}, {0, 0, 3},
            b.AddConductor(Grey(1e-3), Grey(1e4)));
  return b.Build();
}

Rgb LampAndMirrorOnFloor(Vec3d p) {
  std::vector<Vec3d> image = kLamp;
  for (Vec3d& corner : image) corner.x = 2 * kMirror - corner.x;
  const Vec3d up = {0, 0, 1};
  return kFloor * kLampRadiance *
         ((closed_form::PolygonIrradiance(1, kLamp, p, up) +
           closed_form::PolygonIrradiance(1, image, p, up)) /
          std::numbers::pi);
}

// The mean over the filter of each pixel of a function of points on the floor z = 0.
Renders OnFloor(const SceneDescription& scene, const std::function<Rgb(Vec3d)>& f) {
  constexpr int kSub = 6;
  const reference::CameraRays camera(scene.camera, scene.film);
  reference::Random unused(1);
  std::vector<Rgb> image;
  for (int pixel = 0; pixel < kSide * kSide; ++pixel) {
    Rgb sum;
    for (int i = 0; i < kSub * kSub; ++i) {
      const double u = 2 * (i % kSub + 0.5) / kSub - 1;
      const double v = 2 * (i / kSub + 0.5) / kSub - 1;
      const double x = pixel % kSide + 0.5 + u * scene.filter.x_radius;
      const double y = pixel / kSide + 0.5 + v * scene.filter.y_radius;
      const reference::Ray ray = camera.Sample(x, y, unused).ray;
      sum += f(ray.o - ray.d * (ray.o.z / ray.d.z));
    }
    image.push_back(sum / (kSub * kSub));
  }
  return Renders(2, Image(image));
}

// Images of the renderer: light of its light subpaths, of its camera paths, and both.
struct Parts {
  Renders splats, camera, all;
};

Parts RenderParts(const SceneDescription& scene, std::uint64_t spp, int n) {
  Parts out;
  for (int i = 0; i < kRenders; ++i) {
    TestRender options;
    options.spp = spp;
    options.seed = 500 + std::uint64_t(i);
    options.strategy = fmt::format("light-paths=splats:{}", n);
    options.planned_samples = kMinTrainingSamples;
    const Rendered render = RenderDescription(scene, options);
    CHECK(render.result.health.Total() == 0);
    std::vector<Rgb> splats, camera, all;
    for (std::size_t p = 0; p < std::size_t(scene.film.width * scene.film.height); ++p) {
      splats.push_back(render.film.splats()->Mean(p));
      all.push_back(
          render.film.Mean(int(p) % scene.film.width, int(p) / scene.film.width));
      camera.push_back(all.back() - splats.back());
    }
    out.splats.push_back(Image(splats));
    out.camera.push_back(Image(camera));
    out.all.push_back(Image(all));
  }
  return out;
}

// Compares the renderer with the set of techniques that it has.
void CheckParts(const SceneDescription& scene, std::uint64_t spp, int samples,
                double power) {
  constexpr int kN = 2;
  BidirectionalOptions options;
  options.samples = samples;
  options.paths_per_sample = double(kSide * kSide) / kN;
  options.sets = {OfProduct};
  const auto twin = RenderTwin(scene, options);
  const Parts product = RenderParts(scene, spp, kN);
  Renders splats, camera;
  for (const BidirectionalImages& images : twin) {
    splats.push_back(Sum(images.weighted[0], IsSplat));
    camera.push_back(Sum(images.weighted[0], WithLightSamples));
  }
  CheckSame(Compare(product.splats, splats), power, "splats");
  CheckSame(Compare(product.camera, camera), power, "camera paths");
}

// Compares each technique with all light of its path length.
struct TechniqueTest {
  SceneDescription scene;
  std::vector<Renders> truths;  // by number of scattering events

  TechniqueTest(int depth, int samples)
      : scene(Plates(depth)), truths(RenderTruths(scene, samples)) {}

  std::map<Technique, Comparison> Run(BidirectionalFault fault, int samples) const {
    BidirectionalOptions options;
    options.samples = samples;
    options.fault = fault;
    const auto twin = RenderTwin(scene, options);
    std::map<Technique, Comparison> out;
    for (int depth = 0; depth < static_cast<int>(truths.size()); ++depth) {
      for (int s = 0; s <= depth + 1; ++s) {
        const Technique one = {s, depth + 2 - s};
        Renders images;
        for (const BidirectionalImages& of : twin) {
          images.push_back(Sum(of.unweighted, [&](Technique t) { return t == one; }));
        }
        out[one] = Compare(images, truths[depth]);
      }
    }
    return out;
  }
};

// Compares the weighted sum of each set of techniques with the path tracer.
struct SetTest {
  std::vector<TechniqueSet> sets = {All, Hits, WithLightSamples, OfProduct};
  SceneDescription scene;
  Renders truth;

  SetTest(const SceneDescription& of, int samples)
      : scene(of), truth(Repeat([&](std::uint64_t i) {
          TwinOptions options = Options(ReferenceEstimator::kLightSampling, samples);
          options.seed = 1000 + i;
          return Image(RenderReference(of, options).mean);
        })) {}

  std::vector<Comparison> Run(BidirectionalFault fault, int samples) const {
    BidirectionalOptions options;
    options.samples = samples;
    options.sets = sets;
    options.fault = fault;
    const auto twin = RenderTwin(scene, options);
    std::vector<Comparison> out;
    for (std::size_t i = 0; i < sets.size(); ++i) {
      Renders sums;
      for (const auto& images : twin) sums.push_back(Sum(images.weighted[i], All));
      out.push_back(Compare(sums, truth));
    }
    return out;
  }
};

}  // namespace

TEST_CASE("reference: every technique finds all light of a path length", "[reference]") {
  for (const auto& [technique, result] :
       TechniqueTest(3, 150).Run(BidirectionalFault::kNone, 220)) {
    const double power = technique.s + technique.t > 4 ? 0.6 : 0.25;
    CheckSame(result, power, fmt::format("s = {}, t = {}", technique.s, technique.t));
  }
}

TEST_CASE("reference: faults of a technique are found", "[reference]") {
  const TechniqueTest test(2, 60);
  using enum BidirectionalFault;
  for (const BidirectionalFault fault :
       {kNoCosineAtLight, kNoCosineAtConnection, kNoCosineAtCamera, kNoShadingCorrection,
        kWrongGlossyDensity, kTwoLightSubpaths}) {
    std::string found;
    for (const auto& [technique, result] : test.Run(fault, 60)) {
      if (!result.same) found += fmt::format(" ({}, {})", technique.s, technique.t);
    }
    UNSCOPED_INFO("fault " << static_cast<int>(fault) << " is found by" << found);
    CHECK_FALSE(found.empty());
  }
}

TEST_CASE("reference: weighted techniques sum to the image of the path tracer",
          "[reference]") {
  for (const SceneDescription& scene : {Room(3), TiltedFloor()}) {
    const auto results = SetTest(scene, 120).Run(BidirectionalFault::kNone, 90);
    for (std::size_t i = 0; i < results.size(); ++i) {
      CheckSame(results[i], i == 1 ? 0.1 : 0.08, fmt::format("set {}", i));
    }
  }
}

TEST_CASE("reference: weights that do not sum to 1 are found", "[reference]") {
  const auto results =
      SetTest(TiltedFloor(), 100).Run(BidirectionalFault::kCountsMirrors, 100);
  CHECK(results[1].same);
  for (const std::size_t i : {0u, 2u, 3u}) CHECK_FALSE(results[i].same);
}

TEST_CASE("splats: both parts equal those of the reference tracer in a room",
          "[light_paths]") {
  SceneDescription room = Room(3);
  room.filter.x_radius = 1.5;
  room.filter.y_radius = 2;
  CheckParts(room, 512, 120, 0.08);
}

TEST_CASE("splats: both parts equal those of the reference tracer for a lamp in glass",
          "[light_paths]") {
  CheckParts(LampInGlass({0.5, 0, 3}, 36), 1024, 250, 0.1);
}

TEST_CASE("splats: both parts equal those of the reference tracer for tilted normals",
          "[light_paths]") {
  CheckParts(TiltedFloor(), 1024, 250, 0.08);
}

TEST_CASE("splats: light that leaves a glass ball has a closed form", "[light_paths]") {
  const SceneDescription scene = LampInGlass({1.4, 0, 0.8}, 60);
  CheckSame(Compare(RenderParts(scene, 2048, 1).all, OnFloor(scene, LampInGlassOnFloor)),
            0.03, "floor");
}

TEST_CASE("splats: light of a lamp and its mirror image has a closed form",
          "[light_paths]") {
  const SceneDescription scene = LampAndMirror();
  CheckSame(
      Compare(RenderParts(scene, 1024, 1).all, OnFloor(scene, LampAndMirrorOnFloor)),
      0.03, "floor");
}

// More events than light subpaths have vertices.
TEST_CASE("splats: closed rooms have closed forms", "[light_paths]") {
  constexpr int kDepth = 11;
  constexpr double kAlbedo = 0.9;
  for (SceneDescription scene :
       {ClosedRoom(kAlbedo, kDepth), ClosedBox(kAlbedo, kDepth)}) {
    scene.film.width = scene.film.height = kSide;
    const double light = closed_form::ClosedRoom(1, kAlbedo, kDepth);
    const Renders expected(2, Image(std::vector<Rgb>(kSide * kSide, Grey(light))));
    CheckSame(Compare(RenderParts(scene, 64, 1).all, expected), 0.02, "room");
  }
}

}  // namespace lanelight::test
