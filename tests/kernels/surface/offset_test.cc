// Rays that leave a surface never meet it again, at any scale and distance from the
// origin, on either side; and they do meet a surface just beyond it.
#include <catch2/catch.hpp>

#include "kernels/stages.h"
#include "tests/support/brute_force.h"
#include "tests/support/each_target.h"

namespace lanelight {
namespace {

using brute::Random;

struct Case {
  const char* name;
  Geometry geometry;
  std::vector<StageOn> closest, surface, shadow;
};

// One shape of every kind, tilted, of the given size about the given centre.
std::vector<Case> Shapes(Random& random, float size, Vec3f center) {
  std::vector<Case> cases;
  const auto at = [&](float x, float y, Vec3f u, Vec3f v) {
    return center + (size * x) * u + (size * y) * v;
  };
  const Vec3f n = random.Direction();
  const Vec3f u = Normalize(Cross(n, random.Direction())), v = Cross(n, u);
  Geometry quad;
  quad.triangles = {
      MakeTriangle(at(-1, -1, u, v), at(1, -1, u, v), at(1, 1, u, v)),
  };
  cases.push_back({"triangle",
                   quad,
                   {IntersectTrianglesStage},
                   {SurfaceTriangleStage},
                   {ShadowTrianglesStage}});
  Geometry sphere;
  sphere.spheres = {MakeSphere(center, size)};
  cases.push_back({"sphere",
                   sphere,
                   {IntersectSpheresStage},
                   {SurfaceSphereStage},
                   {ShadowSpheresStage}});
  Geometry disk;
  disk.disks = {MakeDisk(center, n, size)};
  cases.push_back(
      {"disk", disk, {IntersectDisksStage}, {SurfaceDiskStage}, {ShadowDisksStage}});
  Geometry plane;
  plane.planes = {MakePlane(center, n)};
  cases.push_back(
      {"plane", plane, {IntersectPlanesStage}, {SurfacePlaneStage}, {ShadowPlanesStage}});
  return cases;
}

// Aims at the shape, then from each hit in random directions on both sides; how many of
// those rays are stopped by the shape although they leave it.
int SelfHits(const Case& c, const AccelOptions& options, Random& random, Vec3f center,
             float size, int* tried, float error_factor = 1) {
  constexpr std::uint32_t kRays = 512;
  const CompiledScene scene = MakeScene(c.geometry, options);
  WaveFixture f(scene, kRays);
  const FeatureSet features = {Feature::kScatters};
  std::vector<TestRay> rays;
  for (std::uint32_t i = 0; i < kRays; ++i) {
    const Vec3f o = center + (3 * size) * random.Direction();
    const Vec3f goal = center + (0.5f * size) * random.Point(1);
    rays.push_back({o, Normalize(goal - o)});
  }
  f.SetRays(rays);
  for (const StageOn stage : c.closest) f.Run(stage, features);
  Queue& surface = f.wave.queue(QueueId::kSurface);
  surface.size = 0;
  const PathColumns& p = f.wave.path;
  for (std::uint32_t i = 0; i < kRays; ++i) {
    if (!std::isinf(p.t[i])) surface.items[surface.size++] = i;
  }
  for (const StageOn stage : c.surface) f.Run(stage, features);
  Queue& shadow = f.wave.queue(QueueId::kShadow);
  shadow.size = 0;
  const bool sphere = !c.geometry.spheres.empty();
  for (std::uint32_t k = 0; k < surface.size; ++k) {
    const std::uint32_t i = surface.items[k];
    Vec3f d = random.Direction();
    const float cosine = Dot(d, f.Ng(i));
    if (std::abs(cosine) < 1e-4f) continue;  // grazing: within the error of ng itself
    if (sphere && cosine < 0) d = -d;        // inwards the sphere is met again
    p.ls_x[i] = d.x, p.ls_y[i] = d.y, p.ls_z[i] = d.z;
    p.ls_distance[i] = std::numeric_limits<float>::infinity();
    p.p_error[i] *= error_factor;
    shadow.items[shadow.size++] = i;
  }
  *tried += static_cast<int>(shadow.size);
  const int before = static_cast<int>(shadow.size);
  for (const StageOn stage : c.shadow) f.Run(stage, features);
  return before - static_cast<int>(shadow.size);
}

}  // namespace

TEST_CASE("a ray that leaves a surface does not hit it again", "[surface]") {
  const EachTarget target;
  Random random(11);
  int tried = 0, without_offset = 0;
  for (const float size : {1e-6f, 1e-2f, 1.0f, 1e3f, 1e6f}) {
    for (const Vec3f center :
         {Vec3f{0, 0, 0}, Vec3f{1.3f, -0.7f, 0.2f}, Vec3f{900, 20, -5}}) {
      for (const Case& c : Shapes(random, size, center)) {
        for (const AccelOptions& options : {AccelOptions{}, AccelOptions{0, 0}}) {
          CAPTURE(size, center.x, c.name, options.few_triangles);
          CHECK(SelfHits(c, options, random, center, size, &tried) == 0);
          without_offset += SelfHits(c, options, random, center, size, &tried, 0);
        }
      }
    }
  }
  CHECK(tried > 20000);
  // The check has power: with the offsets switched off rays do meet their surface.
  CHECK(without_offset > 1000);
}

TEST_CASE("a gap of a few roundings under a huge triangle stops rays", "[surface]") {
  // A small triangle 4e-7 above a ground of size 1e6: rays from its underside to the
  // ground must arrive, although the rounding error of the ground's own edges is 0.1.
  const EachTarget target;
  Random random(12);
  Geometry g;
  g.triangles = {MakeTriangle({-1e6f, -1e6f, 0}, {1e6f, -1e6f, 0}, {0, 2e6f, 0})};
  for (const AccelOptions& options : {AccelOptions{}, AccelOptions{0, 0}}) {
    const CompiledScene scene = MakeScene(g, options);
    std::vector<TestRay> rays;
    for (int i = 0; i < 1000; ++i) {
      Vec3f d = random.Direction();
      if (std::abs(d.z) < 0.01f) continue;
      rays.push_back({{random(-3, 3), random(-3, 3), d.z < 0 ? 4e-7f : -4e-7f}, d});
    }
    WaveFixture f(scene, 1000);
    f.SetRays(rays);
    f.Run(IntersectTrianglesStage, {});
    int missed = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) missed += std::isinf(f.wave.path.t[i]);
    CHECK(missed == 0);
  }
}

}  // namespace lanelight
