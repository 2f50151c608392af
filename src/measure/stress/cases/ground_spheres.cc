// Spheres of a radius up to 1e9 times the height from which they are seen.
#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "src/measure/stress/cases/cases.h"
#include "src/measure/stress/cases/ray_trial.h"

namespace lanelight::stress {
namespace {

// The nearest distance > 0 at which |o + t d - c| = r, in long double; infinite if none.
long double NearestRoot(const WorldRay& ray, Vec3d center, double radius) {
  using Real = long double;
  Real f2 = 0, b = 0, a = 0;
  for (int i = 0; i < 3; ++i) {
    const Real f = Real(ray.origin[i]) - center[i], d = ray.direction[i];
    f2 += f * f, b += f * d, a += d * d;
  }
  const Real c = f2 - Real(radius) * radius, discriminant = b * b - a * c;
  const Real infinite = std::numeric_limits<Real>::infinity();
  if (discriminant < 0) return infinite;
  const Real q = -(b + std::copysign(std::sqrt(discriminant), b));
  const Real t0 = std::min(c / q, q / a), t1 = std::max(c / q, q / a);
  return t0 > 0 ? t0 : t1 > 0 ? t1 : infinite;
}

// Along no axis, so that no coordinate is a round number.
const Vec3d& kUp = kLeaning;

// Its top is the origin.
std::string Ground(double radius) { return Sphere(-radius * kUp, radius); }

// The eye one unit above: the ground is as bright as the sky makes it.
std::vector<Point> GroundUnderSky(double radius, const Effort& effort) {
  const std::string camera = CameraText(kUp, 0.05 * Across(kUp).u, 20);
  return ExpectBothWays(0.6, SkyScene(camera, 0.6, Ground(radius)), {}, effort);
}

// A point light of intensity 1 two units above the ground, seen straight from above. Off
// the foot x the ground falls away by x^2 / 2 r: less than 1e-6 in this narrow view.
std::vector<Point> GroundUnderLamp(double radius, const Effort& effort) {
  const std::string text =
      CameraText(kUp, {}, 0.1) + "WorldBegin\n" +
      fmt::format("LightSource \"point\" \"point3 from\" [{}]\n", Numbers(2 * kUp)) +
      "Material " + Diffuse(0.6) + "\n" + Ground(radius);
  return {Expect(0.6 / M_PI / 4, text, {.quick = 16}, effort)};
}

// A ball of radius 1 that rests on the ground, lit by it from below and by the sky.
// Everything is of albedo 1, so that all light is that of the sky.
std::vector<Point> BallOnGround(double radius, const Effort& effort) {
  const std::string camera = CameraText(kUp - 5.0 * Across(kUp).u, kUp, 20);
  return ExpectBothWays(1, SkyScene(camera, 1, Ground(radius) + Sphere(kUp, 1)),
                        {.full = 1024, .depth = 1000, .relative = 1e-4}, effort);
}

// Rays from one unit above the ground.
void LookDown(const Effort& effort, Draws& draws, RayTrial& trial) {
  const Across flat(kUp);
  for (int i = 0; i < effort(2000, 200000); ++i) {
    const Vec3d aside = draws(-1, 1) * flat.u + draws(-1, 1) * flat.v;
    trial.rays.push_back({kUp + aside, -draws.Above(kUp, 0.05)});
  }
}

// Distances along rays, against extended precision.
std::vector<Point> GroundByRays(double radius, const Effort& effort) {
  Draws draws(effort.seed);
  RayTrial trial(effort, Ground(radius), kUp);
  LookDown(effort, draws, trial);
  const std::vector<WorldHit> hits = trial.tracer.Trace(trial.rays);
  double worst = 0;
  for (std::size_t i = 0; i < hits.size(); ++i) {
    const WorldRay& ray = trial.rays[i];
    const double t = double(NearestRoot(ray, -radius * kUp, radius));
    if (std::isinf(t) && !hits[i].found) continue;
    // Off the ground, not along the ray: the angle to it would multiply any error.
    const double sine = std::abs(Dot(hits[i].normal, ray.direction));
    worst = std::max(worst, hits[i].found ? std::abs(hits[i].t / t - 1) * sine : 1.0);
  }
  return {BoundPoint(worst, 1e-5)};
}

// Rays that leave the ground do not meet it again.
std::vector<Point> LeaveGround(double radius, const Effort& effort) {
  Draws draws(effort.seed);
  RayTrial trial(effort, Ground(radius), kUp);
  LookDown(effort, draws, trial);
  const std::uint64_t missed = trial.CountBad([&](const WorldHit& hit, std::size_t) {
    trial.leaving.push_back(draws.Above(hit.normal, 1e-3));
    return hit.found;
  });
  return {NoFailures(trial.CountMet(), trial.rays.size() - missed)};
}

}  // namespace

void AddGroundSphereCases(std::vector<Case>& cases) {
  const CaseAdder closed{cases, "geometry", Truth::kClosedForm};
  const CaseAdder bounds{cases, "geometry", Truth::kBound};
  const CaseAdder rates{cases, "geometry", Truth::kRate};
  const Axis radii = DecadesAxis("radius over height of the eye", "", {0, 9}, {0, 8});
  closed({"ground-sphere-sky", "the eye one unit above a sphere of radius 1 to 1e9",
          "a sky of 1 makes it as bright as its albedo", radii, GroundUnderSky});
  closed({"ground-sphere-lamp", "a lamp two units above a sphere of radius 1e3 to 1e9",
          "the ground below has albedo / pi / 4",
          DecadesAxis("radius over height of the eye", "", {4, 9}, {4, 8}),
          GroundUnderLamp});
  closed({"ball-on-ground-sphere",
          "a unit ball resting on a sphere of radius 1 to 1e9, albedo 1",
          "everything is as bright as the sky",
          DecadesAxis("radius of the ground over the ball's", "", {0, 9, 3}, {0, 8}),
          BallOnGround});
  bounds({"ground-sphere-rays", "rays from one unit above a sphere of radius 1 to 1e9",
          "they end within 1e-5 of the distance off the exact sphere", radii,
          GroundByRays});
  rates({"ground-sphere-leave",
         "rays that leave a sphere of radius 1 to 1e9, seen from close by",
         "none meets the sphere again", radii, LeaveGround});
}

}  // namespace lanelight::stress
