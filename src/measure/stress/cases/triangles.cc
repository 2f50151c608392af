// Single triangles and pairs of them, at every size, place and angle, by rays.
#include <cmath>

#include "src/measure/stress/cases/cases.h"
#include "src/measure/stress/cases/ray_trial.h"

namespace lanelight::stress {
namespace {

std::vector<Point> FarFromOrigin(double distance, const Effort& effort) {
  Draws draws(effort.seed);
  const Vec3d center = distance * Normalize(Vec3d{1, -2, 0.5});
  RayTrial trial(effort, SquareMesh(center, kLeaning).Text(), center + 5 * kLeaning);
  std::vector<Vec3d> targets;
  for (int i = 0; i < effort(1000, 100000); ++i) {
    targets.push_back(PointOfSquare(draws, center, kLeaning));
    trial.Aim(targets.back(), -draws.Above(kLeaning, 0.2), 3);
  }
  const double worst = trial.Worst(
      [&](const WorldHit& hit, std::size_t i) { return Length(hit.point - targets[i]); });
  return {BoundPoint(worst, 5e-6)};
}

// A triangle of length 1 and width 1 / aspect along x, or turned: interior points hit,
// and the normal is that of its vertices.
std::vector<Point> Needle(double aspect, const Effort& effort) {
  Draws draws(effort.seed);
  const double width = 1 / aspect;
  MeshText mesh;
  mesh.AddTriangle({-0.5, 0, 0}, {0.5, -width / 2, 0}, {0.5, width / 2, 0});
  RayTrial trial(effort, mesh.Text());
  for (int i = 0; i < effort(1000, 100000); ++i) {
    const double x = draws(0.1, 0.9), y = x * width * draws(-0.4, 0.4);
    const Vec3d d = -draws.Above({0, 0, 1}, 0.3);
    // Across the needle the ray must be straight: a float is coarser than it is wide.
    trial.Aim({x - 0.5, y, 0}, Normalize(Vec3d{d.x, 0, d.z}), 2);
  }
  const std::uint64_t failures = trial.CountBad([](const WorldHit& hit, std::size_t) {
    return hit.found && std::abs(std::abs(hit.normal.z) - 1) <= 1e-6;
  });
  return {NoFailures(failures, trial.rays.size())};
}

// Rays that leave a triangle whose vertices have coordinates of 10^-8 to 10^8 never meet
// it, nor its copy with the vertices in another order, again.
std::vector<Point> VerticesOfAllSizes(double, const Effort& effort) {
  Draws draws(effort.seed);
  const auto wild = [&] {
    const double size = std::pow(10, draws(-8, 8));
    return draws(-1, 1) < 0 ? -size : size;
  };
  std::uint64_t failures = 0, trials = 0;
  for (int n = 0; n < effort(40, 1000); ++n) {
    const Vec3d a{wild(), wild(), wild()}, b{wild(), wild(), wild()};
    const Vec3d c{wild(), wild(), wild()}, normal = Normalize(Cross(b - a, c - a));
    MeshText mesh;
    mesh.AddTriangle(a, b, c);
    mesh.AddTriangle(b, c, a);
    RayTrial trial(effort, mesh.Text(), a + Length(b - a) * normal);
    for (int i = 0; i < 1000; ++i) {
      const double u = draws(0.02, 0.97), v = draws(0.01, 0.98 - u);
      trial.Aim(a + u * (b - a) + v * (c - a), -normal, Length(c - a));
    }
    for (const WorldHit& hit : trial.tracer.Trace(trial.rays)) {
      trials += hit.found;
      trial.leaving.push_back(draws.Above(draws(-1, 1) * hit.normal, 1e-3));
    }
    failures += trial.CountMet();
  }
  return {NoFailures(failures, trials)};
}

// Triangles without area are never hit, nor do they hide what is behind. Coordinates are
// small multiples of 1/16, or two of them the same, so that no rounding gives them area.
std::vector<Point> Collinear(double, const Effort& effort) {
  Draws draws(effort.seed);
  MeshText mesh;
  mesh.AddTriangle({-13.45, -7.05, -5.24}, {-13.45, -8.09, -5.24},
                   {-13.45, -7.21, -5.24});
  const auto whole = [&] { return std::floor(draws(-64, 64)) / 16; };
  const auto corner = [&] { return Vec3d{whole(), whole(), whole()}; };
  for (int i = 0; i < 200; ++i) {
    const Vec3d a = corner(), b = corner();
    mesh.AddTriangle(a, b, a + std::floor(draws(-3, 4)) * (b - a));
    mesh.AddTriangle(a, a, b);
    mesh.AddTriangle(a, a, a);
  }
  const std::size_t slivers = mesh.indices.size() / 3;
  RayTrial trial(effort, mesh.Text() + SquareMesh({0, 0, -64}, {0, 0, 1}, 256).Text());
  for (int i = 0; i < effort(2000, 200000); ++i) {
    const std::size_t k =
        i % 8 == 0 ? 0 : static_cast<std::size_t>(draws(0, double(slivers)));
    const Vec3d a = mesh.points[3 * k], b = mesh.points[3 * k + 1];
    const Vec3d target = a + draws(0, 1) * (b - a);
    const Vec3d origin = target + 20.0 * draws.Direction();
    trial.rays.push_back({origin, Normalize(target - origin)});
  }
  const std::uint64_t failures = trial.CountBad([](const WorldHit& hit, std::size_t) {
    return !hit.found || std::abs(hit.point.z + 64) <= 1e-3;
  });
  return {NoFailures(failures, trial.rays.size())};
}

// Rays at an angle to a square of two triangles, at points of the edge that they share.
std::vector<Point> SharedEdge(double sine, const Effort& effort) {
  Draws draws(effort.seed);
  RayTrial trial(effort, Rectangle({-1, -1, 0}, {1, 1, 0}));
  for (int i = 0; i < effort(2000, 200000); ++i) {
    const double along = draws(-0.8, 0.8), phi = draws(0, 2 * M_PI);
    const double cosine = std::sqrt(1 - sine * sine);
    trial.Aim({along, along, 0}, {cosine * std::cos(phi), cosine * std::sin(phi), -sine},
              3);
  }
  const std::uint64_t failures =
      trial.CountBad([](const WorldHit& hit, std::size_t) { return hit.found; });
  return {NoFailures(failures, trial.rays.size())};
}

}  // namespace

void AddTriangleCases(std::vector<Case>& cases) {
  const CaseAdder bounds{cases, "geometry", Truth::kBound};
  const CaseAdder rates{cases, "geometry", Truth::kRate};
  bounds({"triangle-far-from-origin",
          "a square of side 1 at a distance from the origin, to 1e9",
          "rays hit it within 5e-6 of where they are aimed",
          DecadesAxis("distance from the origin", "sides", {0, 12, 3}, {0, 9}),
          FarFromOrigin});
  rates({"triangle-aspect", "a triangle of length 1 and width 1 to 1e-8",
         "rays at points inside hit it, and see its normal",
         DecadesAxis("length over width", "", {0, 8}, {0, 8}), Needle});
  rates({"triangle-vertices-of-all-sizes",
         "vertices with coordinates from 1e-8 to 1e8 in one triangle",
         "of 1000 rays that leave such a triangle and a copy of it, none "
         "meets them again",
         Single(), VerticesOfAllSizes, "pbrt-v4, shapes_test"});
  rates({"triangle-collinear", "triangles without area", "none is hit", Single(),
         Collinear, "pbrt-v4, BadCases"});
  rates({"shared-edge-grazing",
         "rays at the edge of two triangles, at angles from 1 to 1e-7",
         "none passes between the two",
         DecadesAxis("sine of the angle", "", {-8, 0}, {-7, 0}), SharedEdge,
         "mitsuba3, grazing rays on shared edges"});
}

}  // namespace lanelight::stress
