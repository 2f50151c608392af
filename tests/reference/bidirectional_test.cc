// The bidirectional reference tracer against the path tracer: each technique, and
// weighted sums of them.
#include <catch2/catch.hpp>

#include "tests/reference/camera.h"
#include "tests/reference/light_path_images.h"
#include "tests/reference/scenes.h"

namespace lanelight::test::bidirectional {
namespace {

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
  for (const SceneDescription& scene : {LampRoom(3), TiltedFloor()}) {
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

}  // namespace lanelight::test::bidirectional
