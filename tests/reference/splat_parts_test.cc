// light-paths=splats against the bidirectional reference tracer, with the techniques that
// it has: light of its light subpaths and of its camera paths, each by itself.
#include <catch2/catch.hpp>

#include "tests/reference/glass_lamp.h"
#include "tests/reference/light_path_images.h"

namespace lanelight::test::bidirectional {
namespace {

// Compares the renderer with the set of techniques that it has.
void CheckParts(const SceneDescription& scene, std::uint64_t spp, int samples,
                double power) {
  constexpr int kN = 2;
  BidirectionalOptions options;
  options.samples = samples;
  options.paths_per_sample = double(kSide * kSide) / kN;
  options.sets = {OfProduct};
  const auto twin = RenderTwin(scene, options);
  const LightPathParts product = RenderParts(scene, spp, kN);
  Renders splats, camera;
  for (const BidirectionalImages& images : twin) {
    splats.push_back(Sum(images.weighted[0], IsSplat));
    camera.push_back(Sum(images.weighted[0], WithLightSamples));
  }
  CheckSame(Compare(product.splats, splats), power, "splats");
  CheckSame(Compare(product.camera, camera), power, "camera paths");
}

}  // namespace

TEST_CASE("splats: both parts equal those of the reference tracer in a room",
          "[light_paths]") {
  SceneDescription room = LampRoom(3);
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

}  // namespace lanelight::test::bidirectional
