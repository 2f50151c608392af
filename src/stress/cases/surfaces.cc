// Surfaces that rays leave, that nearly touch, that lie in each other, by rays.
#include <numbers>

#include "src/stress/cases/cases.h"
#include "src/stress/cases/points.h"
#include "src/stress/shapes_text.h"
#include "src/stress/trace_rays.h"

namespace lanelight::stress {
namespace {

// Rays that leave a square of two triangles at an angle to it meet neither.
std::vector<Point> LeaveGrazing(double sine, const Effort& effort) {
  Draws draws(effort.seed);
  std::vector<Point> points;
  for (const bool tilted : {false, true}) {
    const Vec3d n = tilted ? kLeaning : Vec3d{0, 0, 1};
    const Across across(n);
    RayTracer tracer(RayScene(SquareMesh({}, n).Text(), 5 * n));
    std::vector<WorldRay> rays;
    std::vector<Vec3d> leaving;
    for (int i = 0; i < effort(2000, 200000); ++i) {
      const Vec3d d = -draws.Above(n, 0.1);
      rays.push_back({PointOfSquare(draws, {}, n) - 2.0 * d, d});
      const double phi = draws(0, 2 * std::numbers::pi);
      const Vec3d flat = std::cos(phi) * across.u + std::sin(phi) * across.v;
      leaving.push_back(std::sqrt(1 - sine * sine) * flat + sine * n);
    }
    tracer.Trace(rays);
    std::uint64_t failures = 0;
    for (const bool blocked : tracer.Blocked(leaving)) failures += blocked;
    points.push_back(RatePoint(failures, rays.size(), 0, tilted ? "tilted" : "level"));
  }
  return points;
}

// Between two squares a gap apart: rays from the lower one meet the upper one.
std::vector<Point> Gap(double gap, const Effort& effort) {
  Draws draws(effort.seed);
  std::vector<Point> points;
  for (const bool tilted : {false, true}) {
    const Vec3d n = tilted ? kLeaning : Vec3d{0, 0, 1};
    // The upper square is larger, so that none passes beside it.
    const double side = 1.5 + 45 * gap;
    RayTracer tracer(RayScene(
        SquareMesh({}, n).Text() + SquareMesh(gap * n, n, side).Text(), -5.0 * n));
    std::vector<WorldRay> rays;
    std::vector<Vec3d> leaving;
    for (int i = 0; i < effort(2000, 200000); ++i) {
      const Vec3d d = draws.Above(n, 0.3);
      rays.push_back({PointOfSquare(draws, {}, n) - 1.0 * d, d});
      leaving.push_back(draws.Above(n, 0.05));
    }
    std::uint64_t failures = 0;
    for (const WorldHit& hit : tracer.Trace(rays)) {
      failures += !hit.found || std::abs(Dot(hit.point, n)) > 0.5 * gap;
    }
    for (const bool blocked : tracer.Blocked(leaving)) failures += !blocked;
    points.push_back(
        RatePoint(failures, 2 * rays.size(), 0, tilted ? "tilted" : "level"));
  }
  return points;
}

// As many copies of one square at the same place: hit as the first of them, and left.
std::vector<Point> Coincident(double count, const Effort& effort) {
  Draws draws(effort.seed);
  const MeshText one = SquareMesh({}, kLeaning);
  MeshText mesh;
  for (int i = 0; i < std::lround(count); ++i) {
    mesh.AddQuad(one.points[0], one.points[1], one.points[2], one.points[3]);
  }
  RayTracer tracer(RayScene(mesh.Text(), 5 * kLeaning));
  std::vector<WorldRay> rays;
  std::vector<Vec3d> leaving;
  for (int i = 0; i < effort(64, 4096); ++i) {
    const Vec3d d = -draws.Above(kLeaning, 0.3);
    rays.push_back({PointOfSquare(draws, {}, kLeaning) - 2.0 * d, d});
    leaving.push_back(draws.Above(kLeaning, 1e-3));
  }
  std::uint64_t failures = 0;
  for (const WorldHit& hit : tracer.Trace(rays)) {
    failures += !hit.found || hit.primitive > 1;
  }
  for (const bool blocked : tracer.Blocked(leaving)) failures += blocked;
  return {RatePoint(failures, 2 * rays.size())};
}

}  // namespace

void AddSurfaceCases(std::vector<Case>& cases) {
  cases.push_back({"leave-grazing", "geometry",
                   "rays that leave a square at angles from 1 to 1e-7",
                   "none meets the square again", "", Truth::kRate,
                   Decades("sine of the angle", "", -8, 0, 1, -6, 0), LeaveGrazing});
  cases.push_back({"gap", "geometry", "two squares of side 1, a gap of 1 to 1e-8 apart",
                   "the nearer one is hit, and no ray from it passes the other", "",
                   Truth::kRate, Decades("gap", "sides", -8, 0, 1, -6, 0), Gap});
  cases.push_back({"coincident-surfaces", "geometry",
                   "1 to 100 000 copies of one square in the same place",
                   "the first is hit, and rays that leave it meet no other", "embree",
                   Truth::kRate, Decades("copies", "", 0, 5, 1, 0, 5), Coincident});
}

}  // namespace lanelight::stress
