// Rays that start within a few roundoffs of a triangle: whether it lies ahead is decided
// exactly, by every way of tracing.
#include <catch2/catch.hpp>

#include "tests/kernels/intersect/trace.h"
#include "tests/support/brute_force.h"
#include "tests/support/each_target.h"

namespace lanelight {
namespace {

using brute::Random;
using brute::ToDouble;

// A ray that starts on a triangle as far as floats can, and what is true of it.
struct NearRay {
  TestRay ray;
  std::uint32_t prim;
  bool ahead;
};

// Through the inside of a triangle, from a point of it rounded to floats, or the float
// next to that. Nothing if doubles do not tell the side beyond doubt, or the ray nearly
// lies in the plane.
std::optional<NearRay> Start(const Geometry& g, Random& random, std::uint32_t prim,
                             Vec3f toward) {
  const TriangleRecord& tri = g.triangles[prim];
  const auto vertex = [&](int k) { return Vec3f{tri.p[k][0], tri.p[k][1], tri.p[k][2]}; };
  const float b = random(0.1f, 0.4f), c = random(0.1f, 0.4f);
  Vec3f o = (1 - b - c) * vertex(0) + b * vertex(1) + c * vertex(2);
  const int axis = static_cast<int>(random.engine()() % 3);
  if (prim % 2 == 0) o[axis] = std::nextafter(o[axis], random(-9, 9));
  const Vec3f d = Normalize(toward);
  const Vec3d e1 = ToDouble(vertex(1)) - ToDouble(vertex(0)),
              e2 = ToDouble(vertex(2)) - ToDouble(vertex(0));
  const Vec3d n = Normalize(Cross(e1, e2));
  const double distance = Dot(n, ToDouble(vertex(0)) - ToDouble(o)),
               speed = Dot(n, ToDouble(d));
  if (std::abs(distance) < 1e-13 || std::abs(speed) < 0.05) return std::nullopt;
  return NearRay{{o, d, 1e-3f}, prim, (distance > 0) == (speed > 0)};
}

// `similar` of them in a row start on one triangle in nearly one direction.
std::vector<NearRay> Starts(const Geometry& g, Random& random, int similar) {
  std::vector<NearRay> rays;
  while (rays.size() < 4096) {
    const auto prim = static_cast<std::uint32_t>(random.engine()() % g.triangles.size());
    const Vec3f middle = random.Direction();
    for (int i = 0; i < similar; ++i) {
      if (const auto ray = Start(g, random, prim, middle + 0.01f * random.Point(1))) {
        rays.push_back(*ray);
      }
    }
  }
  return rays;
}

// Triangles in parallel planes, turned so that no coordinate is exact: none is within
// 1e-3 of another.
Geometry Sheets(Random& random, int n) {
  const Vec3f normal = Normalize(Vec3f{0.36f, 0.48f, 0.8f}),
              u = Normalize(Vec3f{0.8f, -0.6f, 0}), v = Cross(normal, u);
  Geometry g;
  for (int i = 0; i < n; ++i) {
    const Vec3f c = (0.01f * static_cast<float>(i)) * normal;
    const auto point = [&](float angle) {
      return c + std::cos(angle) * u + std::sin(angle) * v;
    };
    const float turn = random(0, 6);
    g.triangles.push_back(MakeTriangle(point(turn), point(turn + 2), point(turn + 4)));
  }
  return g;
}

}  // namespace

TEST_CASE("which side of a triangle a ray starts on is decided exactly", "[intersect]") {
  const EachTarget target;
  Random random(31);
  // Each triangle in turn, or a stream: packets of similar rays, or single ones.
  for (const std::uint32_t few : {0u, kFewTriangles}) {
    const Geometry g = Sheets(random, few == 0 ? 400 : 100);
    const CompiledScene scene = MakeScene(g, {.few_triangles = few});
    for (const int similar : {1, 64}) {
      CAPTURE(few, similar);
      const std::vector<NearRay> starts = Starts(g, random, similar);
      std::vector<TestRay> rays;
      for (const NearRay& start : starts) rays.push_back(start.ray);
      const auto hits = TraceClosest(scene, rays, {IntersectTrianglesStage});
      std::vector<char> open(rays.size(), 0);
      for (const std::uint32_t i : Unoccluded(scene, rays, {ShadowTrianglesStage})) {
        open[i] = 1;
      }
      int wrong = 0, wrong_shadow = 0, ahead = 0;
      for (std::size_t i = 0; i < rays.size(); ++i) {
        ahead += starts[i].ahead;
        const bool hit = hits[i].t < rays[i].t_max;
        wrong += hit != starts[i].ahead || (hit && hits[i].prim != starts[i].prim);
        wrong_shadow += (open[i] == 0) != starts[i].ahead;
      }
      CHECK(wrong == 0);
      CHECK(wrong_shadow == 0);
      CHECK(ahead > 1000);
      CHECK(ahead < static_cast<int>(rays.size()) - 1000);
    }
  }
}

}  // namespace lanelight
