// Surfaces that rays leave, that nearly touch, that lie in each other, by rays.
#include <cmath>

#include "src/measure/stress/cases/cases.h"
#include "src/measure/stress/cases/ray_trial.h"

namespace lanelight::stress {
namespace {

// Of a square along no axis, and of one in the plane z = 0.
template <class Measure>
std::vector<Point> LevelAndTilted(const Measure& measure) {
  return {Named("level", measure(Vec3d{0, 0, 1})), Named("tilted", measure(kLeaning))};
}

// Rays that leave a square of two triangles at an angle to it meet neither.
std::vector<Point> LeaveGrazing(double sine, const Effort& effort) {
  Draws draws(effort.seed);
  return LevelAndTilted([&](Vec3d n) {
    RayTrial trial(effort, SquareMesh({}, n).Text(), 5 * n);
    for (int i = 0; i < effort(2000, 200000); ++i) {
      const Vec3d d = -draws.Above(n, 0.1);
      trial.Aim(PointOfSquare(draws, {}, n), d, 2);
      trial.leaving.push_back(draws.AtSine(n, sine));
    }
    trial.tracer.Trace(trial.rays);
    return NoFailures(trial.CountMet(), trial.rays.size());
  });
}

// Between two squares a gap apart: rays from the lower one meet the upper one.
std::vector<Point> Gap(double gap, const Effort& effort) {
  Draws draws(effort.seed);
  return LevelAndTilted([&](Vec3d n) {
    // The upper square is larger, so that none passes beside it.
    const double side = 1.5 + 45 * gap;
    RayTrial trial(effort, SquareMesh({}, n).Text() + SquareMesh(gap * n, n, side).Text(),
                   -5.0 * n);
    for (int i = 0; i < effort(2000, 200000); ++i) {
      const Vec3d d = draws.Above(n, 0.3);
      trial.Aim(PointOfSquare(draws, {}, n), d, 1);
      trial.leaving.push_back(draws.Above(n, 0.05));
    }
    const std::uint64_t bad = trial.CountBad([&](const WorldHit& hit, std::size_t) {
      return hit.found && std::abs(Dot(hit.point, n)) <= 0.5 * gap;
    });
    const std::size_t rays = trial.rays.size();
    return NoFailures(bad + rays - trial.CountMet(), 2 * rays);
  });
}

// As many copies of one square at the same place: hit as the first of them, and left.
std::vector<Point> Coincident(double count, const Effort& effort) {
  Draws draws(effort.seed);
  const MeshText one = SquareMesh({}, kLeaning);
  MeshText mesh;
  for (int i = 0; i < std::lround(count); ++i) {
    mesh.AddQuad(one.points[0], one.points[1], one.points[2], one.points[3]);
  }
  RayTrial trial(effort, mesh.Text(), 5 * kLeaning);
  for (int i = 0; i < effort(64, 4096); ++i) {
    const Vec3d d = -draws.Above(kLeaning, 0.3);
    trial.Aim(PointOfSquare(draws, {}, kLeaning), d, 2);
    trial.leaving.push_back(draws.Above(kLeaning, 1e-3));
  }
  const std::uint64_t bad = trial.CountBad(
      [](const WorldHit& hit, std::size_t) { return hit.found && hit.primitive <= 1; });
  return {NoFailures(bad + trial.CountMet(), 2 * trial.rays.size())};
}

}  // namespace

void AddSurfaceCases(std::vector<Case>& cases) {
  const CaseAdder add{cases, "geometry", Truth::kRate};
  add({"leave-grazing", "rays that leave a square at angles from 1 to 1e-7",
       "none meets the square again",
       DecadesAxis("sine of the angle", "", {-8, 0}, {-6, 0}), LeaveGrazing});
  add({"gap", "two squares of side 1, a gap of 1 to 1e-8 apart",
       "the nearer one is hit, and no ray from it passes the other",
       DecadesAxis("gap", "sides", {-8, 0}, {-6, 0}), Gap});
  add({"coincident-surfaces", "1 to 100 000 copies of one square in the same place",
       "the first is hit, and rays that leave it meet no other",
       DecadesAxis("copies", "", {0, 5}, {0, 5}), Coincident, "embree"});
}

}  // namespace lanelight::stress
