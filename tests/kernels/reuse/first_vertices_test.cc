// reuse=block against the plainly written estimator (tests/reference/reuse.h), pixel by
// pixel, where first vertices differ in what they can propose: black surfaces, lamps that
// emit on one side, mirrors before them. Each planted fault must be found.
#include <catch2/catch.hpp>

#include "src/base/core/parallel.h"
#include "tests/bias/tile_bias.h"
#include "tests/reference/reuse.h"
#include "tests/reference/scenes.h"

namespace lanelight::test {
namespace {

constexpr int kImageSide = 8;
const char* const kReuse =
    "decide=none,points=independent,directions=bsdf,roulette=none,seen-lights=paths,"
    "reuse=block:16";

// A room of diffuse walls under a large lamp.
SceneBuilder Room(int depth) {
  SceneBuilder b(kImageSide, kImageSide);
  b.Depth(depth).Perspective({0, 1, 4.4}, {0, 1, 0}, {0, 1, 0}, 36);
  const Index white = b.AddDiffuse({0.7, 0.68, 0.65});
  const Index red = b.AddDiffuse({0.6, 0.3, 0.2});
  b.AddQuad({-1, 0, -1}, {0, 0, 2}, {2, 0, 0}, white);
  b.AddQuad({-1, 2, -1}, {2, 0, 0}, {0, 0, 2}, white);
  b.AddQuad({-1, 0, -1}, {2, 0, 0}, {0, 2, 0}, white);
  b.AddQuad({-1, 0, -1}, {0, 2, 0}, {0, 0, 2}, red);
  b.AddQuad({1, 0, -1}, {0, 0, 2}, {0, 2, 0}, white);
  b.AddPoint({0.3, 1.2, 0.5}, {1, 0.9, 0.8});
  return b;
}

// A black block stands before the back wall.
SceneDescription BlackBlock() {
  SceneBuilder b = Room(4);
  b.AddBox({-0.6, 0.2, -0.9}, {0.6, 1.4, -0.6}, b.AddDiffuse(Grey(0)));
  return b.Build();
}

// A lamp that emits towards the back wall only: the camera sees its dark side.
SceneDescription LampFromBehind() {
  SceneBuilder b = Room(4);
  b.AddQuad({-0.4, 0.6, -0.7}, {0, 0.8, 0}, {0.8, 0, 0}, b.AddDiffuse(Grey(0)),
            b.AddEmission(Grey(2)));
  return b.Build();
}

// A mirror leans on the wall: first vertices behind it have one event less to go.
SceneDescription MirrorOnWall() {
  SceneBuilder b = Room(2);
  b.AddQuad({-0.9, 0.1, -0.9}, {0.9, 0, 0}, {0, 1.8, 0},
            b.AddConductor(Grey(0.2), Grey(3.9)));
  return b.Build();
}

class Twin {
 public:
  explicit Twin(const SceneDescription& scene)
      : test_(PrepareScene(scene), kReuse, {{96, 32, 1e-3}, {96, 64, 1e-3}}, 1) {}

  BiasVerdict Compare(const SceneDescription& scene,
                      const ReuseTwinOptions& faults = {}) {
    return test_.CompareImages([&](const SeedRange& seeds) {
      std::vector<SeedImage> images(static_cast<std::size_t>(seeds.count));
      ParallelFor(images.size(), [&](std::size_t i) {
        ReuseTwinOptions options = faults;
        options.samples = static_cast<int>(seeds.spp);
        options.seed = seeds.first + i;
        const ReferenceImage image = RenderReuseReference(scene, options);
        images[i] = {image.width, image.height, image.mean};
      });
      return images;
    });
  }

 private:
  BiasTest test_;
};

// Compares a scene with the estimator, then with the estimator with each fault.
void CheckFound(Twin& twin, const SceneDescription& scene,
                const std::vector<ReuseTwinOptions>& faults) {
  const BiasVerdict same = twin.Compare(scene);
  INFO(same.worst);
  CHECK_FALSE(same.biased);
  CHECK(same.tile_power < 0.15);
  for (const ReuseTwinOptions& fault : faults) {
    const BiasVerdict planted = twin.Compare(scene, fault);
    INFO("planted: " << planted.worst);
    CHECK(planted.biased);
  }
}

}  // namespace

TEST_CASE("paths that end at a black first vertex are not reused, others contribute",
          "[reuse][bias]") {
  const SceneDescription scene = BlackBlock();
  Twin twin(scene);
  CheckFound(twin, scene, {{.counts_black = true}, {.silent_primitive = 0}});
  SceneDescription darker = scene;  // a wall that is 2 % darker is found
  darker.materials[0].reflectance.constant *= 0.98;
  CHECK(twin.Compare(darker).biased);
}

TEST_CASE("paths that end at the dark side of a lamp have no density", "[reuse][bias]") {
  const SceneDescription scene = LampFromBehind();
  Twin twin(scene);
  CheckFound(twin, scene, {{.counts_black = true}});
}

TEST_CASE("paths that are at another depth have no density", "[reuse][bias]") {
  const SceneDescription scene = MirrorOnWall();
  Twin twin(scene);
  CheckFound(twin, scene, {{.counts_other_depths = true}});
}

}  // namespace lanelight::test
