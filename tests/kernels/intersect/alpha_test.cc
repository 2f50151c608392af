// Alpha cut-outs by constants: share of hits kept, purity, and the refusal of textures
// that nothing evaluates.
#include <catch2/catch.hpp>

#include "src/base/core/check.h"
#include "tests/kernels/intersect/trace.h"
#include "tests/support/brute_force.h"
#include "tests/support/each_target.h"

namespace lanelight {
namespace {

using brute::Random;

const FeatureSet kAlpha = {Feature::kTriangles, Feature::kAlpha};

// Twenty stacked layers; every second one is cut out with the given alpha.
template <typename Records, typename Make>
void AddLayers(Records& records, Make&& make) {
  for (int i = 0; i < 20; ++i) {
    records.push_back(make(0.1f * static_cast<float>(i)));
    if (i % 2 == 0) records.back().flags = kAlphaTested;
  }
}

void SetAlpha(CompiledScene& scene, float alpha) {
  const std::uint32_t n = scene.geometry.ranges.end;
  scene.alpha.texture.assign(n, -1);
  scene.alpha.constant.assign(n, 1);
  for (std::uint32_t i = 0; i < n; i += 2) scene.alpha.constant[i] = alpha;
}

std::vector<TestRay> Downwards(Random& random, int n) {
  std::vector<TestRay> rays;
  for (int i = 0; i < n; ++i) {
    rays.push_back({{random(-0.2f, 0.2f), random(-0.2f, 0.2f), -3},
                    Normalize(Vec3f{random(-0.01f, 0.01f), random(-0.01f, 0.01f), 1})});
  }
  return rays;
}

void CheckShares(const Geometry& g, const std::vector<StageOn>& closest,
                 const std::vector<StageOn>& shadow) {
  Random random(51);
  const auto rays = Downwards(random, 4000);
  for (const float alpha : {0.0f, 0.25f, 1.0f}) {
    CAPTURE(alpha);
    std::vector<std::vector<KernelHit>> results;
    for (const AccelOptions& options : {AccelOptions{}, AccelOptions{0, 0}}) {
      CompiledScene scene = MakeScene(g, options);
      SetAlpha(scene, alpha);
      results.push_back(TraceClosest(scene, rays, closest, kAlpha));
      int first = 0;
      for (const KernelHit& hit : results.back()) {
        REQUIRE_FALSE(std::isinf(hit.t));
        REQUIRE(hit.prim <= 1);  // the second layer is opaque
        first += hit.prim == 0;
      }
      // Binomial: 6 standard deviations of 4000 decisions are 0.041.
      CHECK(std::abs(first / 4000.0 - alpha) <= (alpha == 0.25f ? 0.041 : 0));
      // Shadow rays that end between the first two layers decide alike.
      std::vector<TestRay> ending = rays;
      for (TestRay& ray : ending) ray.t_max = 3.05f;
      const auto open = Unoccluded(scene, ending, shadow, kAlpha);
      if (closest[0] == IntersectTrianglesStage) {
        CHECK(static_cast<int>(open.size()) == 4000 - first);
      }
    }
    CHECK(results[0] == results[1]);
  }
}

}  // namespace

TEST_CASE("an alpha texture keeps the expected fraction of hits", "[intersect]") {
  const EachTarget target;
  Geometry triangles, spheres, disks;
  AddLayers(triangles.triangles,
            [](float z) { return MakeTriangle({-2, -2, z}, {2, -2, z}, {0, 3, z}); });
  CheckShares(triangles, {IntersectTrianglesStage}, {ShadowTrianglesStage});
  AddLayers(disks.disks, [](float z) { return MakeDisk({0, 0, z}, {0, 0, 1}, 2); });
  CheckShares(disks, {IntersectDisksStage}, {ShadowDisksStage});
  AddLayers(spheres.spheres,
            [](float z) { return MakeSphere({0, 0, 100 + 5 * z}, 100 + 2.5f * z); });
  CheckShares(spheres, {IntersectSpheresStage}, {ShadowSpheresStage});
}

TEST_CASE("a sphere with a transparent near side is hit on its far side", "[intersect]") {
  const EachTarget target;
  Geometry g;
  g.spheres = {MakeSphere({0, 0, 0}, 1)};
  g.spheres[0].flags = kAlphaTested;
  for (const std::uint32_t few : {0u, 16u}) {
    CompiledScene scene = MakeScene(g, {.few_round = few});
    SetAlpha(scene, 0.5f);
    Random random(52);
    int near = 0, far = 0, none = 0;
    for (const KernelHit& hit :
         TraceClosest(scene, Downwards(random, 2000), {IntersectSpheresStage}, kAlpha)) {
      if (std::isinf(hit.t)) {
        ++none;
      } else {
        ++(hit.t < 3 ? near : far);
      }
    }
    CHECK(std::abs(near - 1000) < 150);
    CHECK(std::abs(far - 500) < 130);
    CHECK(std::abs(none - 500) < 130);
  }
}

}  // namespace lanelight
