// Surface points, normals, tangents and surface coordinates of every shape, and the
// offset of rays that leave a surface.
#include <catch2/catch.hpp>

#include "kernels/stages.h"
#include "tests/support/brute_force.h"
#include "tests/support/each_target.h"

namespace lanelight {
namespace {

using brute::Random;
using brute::ToDouble;

const FeatureSet kEverything = {
    Feature::kTriangles,     Feature::kSpheres,  Feature::kDisks, Feature::kPlanes,
    Feature::kVertexNormals, Feature::kTangents, Feature::kUv,    Feature::kScatters};

// Traces the rays against everything and evaluates the surface; slots that hit.
std::vector<std::uint32_t> HitSurface(WaveFixture& fixture,
                                      const std::vector<TestRay>& rays,
                                      const FeatureSet& features) {
  fixture.SetRays(rays);
  const Geometry& g = *fixture.wave.geometry;
  if (!g.triangles.empty()) fixture.Run(IntersectTrianglesStage, features);
  if (!g.spheres.empty()) fixture.Run(IntersectSpheresStage, features);
  if (!g.disks.empty()) fixture.Run(IntersectDisksStage, features);
  if (!g.planes.empty()) fixture.Run(IntersectPlanesStage, features);
  Queue& queue = fixture.wave.queue(QueueId::kSurface);
  queue.size = 0;
  for (std::uint32_t i = 0; i < rays.size(); ++i) {
    if (!std::isinf(fixture.wave.path.t[i])) queue.items[queue.size++] = i;
  }
  const std::vector<std::uint32_t> hits(queue.items, queue.items + queue.size);
  if (!g.triangles.empty()) fixture.Run(SurfaceTriangleStage, features);
  if (!g.spheres.empty()) fixture.Run(SurfaceSphereStage, features);
  if (!g.disks.empty()) fixture.Run(SurfaceDiskStage, features);
  if (!g.planes.empty()) fixture.Run(SurfacePlaneStage, features);
  return hits;
}

Vec3d Corner(const TriangleRecord& tri, int k) {
  return {tri.p[k][0], tri.p[k][1], tri.p[k][2]};
}

void AddUvsAndNormals(Geometry& g, Random& random) {
  for (std::size_t i = 0; i < g.triangles.size(); ++i) {
    for (int k = 0; k < 3; ++k) {
      const Vec3f n = random.Direction();
      for (int a = 0; a < 3; ++a) g.normals.push_back(n[a]);
      g.uvs.push_back(random(-2, 2));
      g.uvs.push_back(random(-2, 2));
    }
  }
}

}  // namespace

TEST_CASE("triangle surfaces: point, normals, uv and tangent", "[surface]") {
  const EachTarget target;
  Random random(3);
  Geometry geometry = brute::Soup(random, 40, 1, 0.8f);
  AddUvsAndNormals(geometry, random);
  const CompiledScene scene = MakeScene(std::move(geometry));
  std::vector<TestRay> rays;
  for (int i = 0; i < 999; ++i) rays.push_back({random.Point(2), random.Direction()});
  WaveFixture f(scene, 999);
  const auto hits = HitSurface(f, rays, kEverything);
  REQUIRE(hits.size() > 60);
  const PathColumns& p = f.wave.path;
  for (const std::uint32_t i : hits) {
    const TriangleRecord& tri = scene.geometry.triangles[p.prim[i]];
    REQUIRE(p.material[i] == p.prim[i]);
    const Vec3d v0 = Corner(tri, 0), e1 = Corner(tri, 1) - v0, e2 = Corner(tri, 2) - v0;
    const double b1 = p.b1[i], b2 = p.b2[i], b0 = 1 - b1 - b2;
    // The point: on the triangle up to its own rounding, and on the ray.
    const Vec3d exact = v0 + b1 * e1 + b2 * e2, point = ToDouble(f.P(i));
    REQUIRE(Length(exact - point) <= 1e-7 * Length(exact));
    const Vec3d on_ray = ToDouble(rays[i].o) + double{p.t[i]} * ToDouble(rays[i].d);
    REQUIRE(Length(on_ray - point) < 2e-5);
    const Vec3d normal = Normalize(Cross(e1, e2));
    const double off = std::abs(Dot(normal, point - v0));
    REQUIRE(off <= p.p_error[i] / 2);
    REQUIRE(p.p_error[i] <= 0x1p-21 * std::sqrt(3) * Length(point) + 1e-12);
    // Normals: the shading normal is interpolated, the other takes its side.
    const float* n = &scene.geometry.normals[9 * p.prim[i]];
    const float* uv = &scene.geometry.uvs[6 * p.prim[i]];
    Vec3d ns;
    for (int a = 0; a < 3; ++a) ns[a] = b0 * n[a] + b1 * n[3 + a] + b2 * n[6 + a];
    if (Length(ns) > 0.05) REQUIRE(Length(Normalize(ns) - ToDouble(f.Ns(i))) < 1e-5);
    const double side = Dot(ToDouble(f.Ng(i)), normal);
    REQUIRE(std::abs(std::abs(side) - 1) < 1e-6);
    REQUIRE(Dot(ToDouble(f.Ng(i)), ToDouble(f.Ns(i))) >= 0);
    REQUIRE(p.uv_u[i] == Approx(b0 * uv[0] + b1 * uv[2] + b2 * uv[4]).margin(1e-5));
    REQUIRE(p.uv_v[i] == Approx(b0 * uv[1] + b1 * uv[3] + b2 * uv[5]).margin(1e-5));
    // dp/du: moving along it changes u by one per unit and leaves v alone.
    const double du1 = uv[2] - uv[0], dv1 = uv[3] - uv[1], du2 = uv[4] - uv[0],
                 dv2 = uv[5] - uv[1];
    const double det = du1 * dv2 - du2 * dv1;
    if (std::abs(det) < 0.05) continue;
    const Vec3d tangent = (dv2 * e1 - dv1 * e2) / det;
    const Vec3d found{p.tg_x[i], p.tg_y[i], p.tg_z[i]};
    REQUIRE(Length(found - tangent) <= 1e-4 * Length(tangent));
  }
}

TEST_CASE("tangents of bilinear patches follow the normal under two mirrorings",
          "[surface]") {
  constexpr float kSine = 0.6f, kCosine = 0.8f;
  struct Case {
    Vec3f normal, along_u;
  };
  // By way of the x axis: from z to a normal n, x goes to z and on to
  // z - 2 (z . b) b / b^2 with b = x - n.
  for (const auto& [normal, along_u] :
       {Case{{kSine, 0, kCosine}, {kCosine, 0, -kSine}},
        Case{{0, kSine, kCosine}, {kCosine, -kSine * kCosine, kSine * kSine}},
        Case{{0, 0, 1}, {1, 0, 0}}}) {
    for (const std::string& target : AvailableTargets()) {
      ForceTarget(target);
      Geometry g;
      g.triangles = {MakeTriangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0})};
      g.triangles[0].flags = kRotatedTangents;
      g.rotated_tangents = true;
      g.uvs = {0, 0, 1, 0, 0, 1};
      for (int i = 0; i < 9; ++i) g.normals.push_back(normal[i % 3]);
      const CompiledScene scene = MakeScene(std::move(g));
      WaveFixture f(scene, 1);
      REQUIRE(HitSurface(f, {{{0.25f, 0.25f, 1}, {0, 0, -1}}}, kEverything).size() == 1);
      const PathColumns& p = f.wave.path;
      CAPTURE(target, normal.x, normal.y, p.tg_x[0], p.tg_y[0], p.tg_z[0]);
      CHECK(Length(Vec3f{p.tg_x[0], p.tg_y[0], p.tg_z[0]} - along_u) < 1e-6f);
    }
  }
  ForceTarget("");
}

TEST_CASE("without vertex normals the winding gives the normal", "[surface]") {
  const EachTarget target;
  for (const float size : {1e-25f, 1e-12f, 1.0f, 1e6f}) {
    CAPTURE(size);
    Geometry g;
    g.triangles = {MakeTriangle({0, 0, size}, {size, 0, size}, {0, size, size})};
    const CompiledScene scene = MakeScene(std::move(g));
    WaveFixture f(scene, 1);
    const FeatureSet features = {Feature::kTriangles, Feature::kScatters};
    const auto hits = HitSurface(f, {{{size / 4, size / 4, 0}, {0, 0, 1}}}, features);
    REQUIRE(hits.size() == (size > 1e-24f ? 1 : hits.size()));
    if (hits.empty()) continue;  // so small that products underflow: not guaranteed
    CHECK(f.Ng(0) == Vec3f{0, 0, 1});
  }
}

TEST_CASE("sphere surfaces follow pbrt's conventions", "[surface]") {
  const EachTarget target;
  Random random(4);
  Geometry g;
  g.spheres = {MakeSphere({0.5f, -1, 2}, 0.75f), MakeSphere({3, 0, 0}, 1e-3f)};
  g.spheres[0].normal_sign = -1;
  g.spheres[0].y_sign = -1;
  const CompiledScene scene = MakeScene(std::move(g));
  std::vector<TestRay> rays;
  for (int i = 0; i < 500; ++i) {
    const SphereRecord& s = scene.geometry.spheres[i % 2];
    const Vec3f center{s.center[0], s.center[1], s.center[2]};
    const Vec3f o = random.Point(4), goal = center + s.radius * 0.9f * random.Direction();
    rays.push_back({o, Normalize(goal - o)});
  }
  WaveFixture f(scene, 500);
  const auto hits = HitSurface(f, rays, kEverything);
  REQUIRE(hits.size() == rays.size());
  const PathColumns& p = f.wave.path;
  for (const std::uint32_t i : hits) {
    const SphereRecord& s = scene.geometry.spheres[p.prim[i]];
    const Vec3d rel = ToDouble(f.P(i)) - Vec3d{s.center[0], s.center[1], s.center[2]};
    REQUIRE(std::abs(Length(rel) - s.radius) <= p.p_error[i] / 2);
    REQUIRE(Length(ToDouble(f.Ng(i)) - Normalize(rel) * double{s.normal_sign}) < 1e-3);
    const Vec3d n = ToDouble(f.Ng(i)) * double{s.normal_sign};
    const double y = n.y * s.y_sign;
    double u = std::atan2(y, n.x) / (2 * M_PI);
    if (u < 0) u += 1;
    REQUIRE(p.uv_u[i] == Approx(u).margin(1e-5));
    REQUIRE(p.uv_v[i] ==
            Approx(1 - std::acos(std::clamp(n.z, -1., 1.)) / M_PI).margin(1e-3));
    const Vec3d tangent =
        2 * M_PI * s.radius * Vec3d{-y, n.x * 1.0, 0} * Vec3d{1, double{s.y_sign}, 1};
    const Vec3d found{p.tg_x[i], p.tg_y[i], p.tg_z[i]};
    REQUIRE(Length(found - tangent) <= 1e-5 * s.radius);
    REQUIRE(f.Ns(i) == f.Ng(i));
  }
}

TEST_CASE("disk and plane surfaces follow their axes", "[surface]") {
  const EachTarget target;
  Random random(5);
  Geometry g;
  g.disks = {MakeDisk({0, 0, 1}, {0, 0, 1}, 2, 0.5f)};
  g.disks[0].u_axis[0] = 1, g.disks[0].u_axis[1] = 0, g.disks[0].u_axis[2] = 0;
  g.planes = {MakePlane({0, 0, -1}, {0, 0, 1})};
  PlaneRecord& plane = g.planes[0];  // skewed axes: u = x / 2 + y, v = 3 y
  plane.u_axis[0] = 0.5f, plane.u_axis[1] = 1, plane.u_axis[2] = 0;
  plane.v_axis[0] = 0, plane.v_axis[1] = 3, plane.v_axis[2] = 0;
  const CompiledScene scene = MakeScene(std::move(g));
  std::vector<TestRay> rays;
  for (int i = 0; i < 333; ++i) {
    const Vec3f o = {random(-3, 3), random(-3, 3), 4};
    rays.push_back({o, Normalize(Vec3f{random(-2, 2), random(-2, 2), 0} - o)});
  }
  WaveFixture f(scene, 333);
  const auto hits = HitSurface(f, rays, kEverything);
  REQUIRE(hits.size() == rays.size());
  const PathColumns& p = f.wave.path;
  int disks = 0;
  for (const std::uint32_t i : hits) {
    const Vec3f at = f.P(i), tangent{p.tg_x[i], p.tg_y[i], p.tg_z[i]};
    REQUIRE(f.Ng(i) == Vec3f{0, 0, 1});
    if (p.prim[i] == 1) {
      REQUIRE(at.z == -1);
      REQUIRE(p.uv_u[i] == Approx(at.x / 2 + at.y).margin(1e-5));
      REQUIRE(p.uv_v[i] == Approx(3 * at.y).margin(1e-5));
      REQUIRE(Length(tangent - Vec3f{2, 0, 0}) < 1e-5f);
      continue;
    }
    ++disks;
    REQUIRE(at.z == 1);
    const double radius = std::hypot(at.x, at.y);
    REQUIRE(radius <= 2 + 1e-6);
    REQUIRE(radius >= 0.5 - 1e-6);
    double u = std::atan2(at.y, at.x) / (2 * M_PI);
    if (u < 0) u += 1;
    REQUIRE(p.uv_u[i] == Approx(u).margin(1e-5));
    REQUIRE(p.uv_v[i] == Approx((2 - radius) / 1.5).margin(1e-5));
    const Vec3f around = static_cast<float>(2 * M_PI) * Vec3f{-at.y, at.x, 0};
    REQUIRE(Length(tangent - around) < 1e-4f);
  }
  CHECK(disks > 50);
  CHECK(disks < 300);
}

}  // namespace lanelight
