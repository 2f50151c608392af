// Spheres that are huge, tiny, far, one in another, by rays and in closed form.
#include <cmath>

#include "src/measure/stress/cases/cases.h"
#include "src/measure/stress/cases/ray_trial.h"

namespace lanelight::stress {
namespace {

// A unit sphere far from the origin, and rays that begin `from` away: they hit it if they
// pass its centre within 1 - `off`, and miss it beyond 1 + `off`.
std::vector<Point> SilhouetteAt(double distance, double from, double off,
                                const Effort& effort) {
  Draws draws(effort.seed);
  const Vec3d center = distance * Normalize(Vec3d{1, 2, -0.3});
  RayTrial trial(effort, Sphere(center, 1), center + from * Normalize(Vec3d{-2, 1, 1}));
  for (int i = 0; i < effort(2000, 200000); ++i) {
    const Vec3d d = -draws.Direction();
    const Vec3d rim = Across(d).At(draws(0, 2 * M_PI));
    trial.Aim(center + (i % 2 == 0 ? 1 - off : 1 + off) * rim, d, from);
  }
  const std::uint64_t failures = trial.CountBad(
      [](const WorldHit& hit, std::size_t i) { return hit.found == (i % 2 == 0); });
  return {NoFailures(failures, trial.rays.size())};
}

std::vector<Point> SphereFarFromOrigin(double distance, const Effort& effort) {
  return SilhouetteAt(distance, 5, 1e-4, effort);
}

std::vector<Point> SphereFarFromEye(double distance, const Effort& effort) {
  return SilhouetteAt(0, distance, 4e-7 * distance, effort);
}

// Two balls of clear glass under a sky of 1: through them, too, everything is 1.
std::vector<Point> TwoGlasses(double apart, const Effort& effort) {
  const std::string text = CameraText({0.1, -6.3, 0.7}, {}, 14) + "WorldBegin\n" +
                           Sky(1) + Sphere({}, 1, Glass(1.5)) +
                           Sphere(apart * Normalize(Vec3d{3, 1, -0.3}), 1, Glass(1.5));
  return {Expect(1, text, {.quick = 256, .depth = 300}, effort)};
}

// A sphere of radius 1 in one of radius 1 + gap: rays from each reach the other.
std::vector<Point> Shells(double gap, const Effort& effort) {
  Draws draws(effort.seed);
  RayTrial trial(effort, Sphere({}, 1) + Sphere({}, 1 + gap));
  // Steep enough for the inner sphere, and not as far as through the outer one.
  const double steep = 0.05 + 1.3 * std::sqrt(2 * gap), reach = 1.5 * gap / steep;
  std::vector<WorldRay> outward;
  std::vector<Vec3d> out;
  for (int i = 0; i < effort(2000, 200000); ++i) {
    const Vec3d n = draws.Direction();
    trial.rays.push_back({3.0 * n, -n});
    outward.push_back({0.2 * n, n});
    trial.leaving.push_back(-draws.Above(n, steep));
    out.push_back(draws.Above(n, 0.01));
  }
  const auto count = [&](double radius, double length) {
    const std::uint64_t bad = trial.CountBad([&](const WorldHit& hit, std::size_t) {
      return hit.found && std::abs(Length(hit.point) - radius) <= 0.5 * gap;
    });
    return bad + trial.rays.size() - trial.CountMet(length);
  };
  std::uint64_t failures = count(1 + gap, reach);
  trial.rays = outward, trial.leaving = out;
  failures += count(1, std::numeric_limits<double>::infinity());
  return {NoFailures(failures, 4 * trial.rays.size())};
}

// The eye in a ball that glows with 1 and has albedo 1/2, at a distance from its wall:
// all around there is 1 + 1/2 + 1/4 + ...
std::vector<Point> InsideSphere(double distance, const Effort& effort) {
  const std::string text = CameraText({1 - distance, 0, 0}, {-1, 0.3, 0.2}, 90) +
                           "WorldBegin\n" + Walls(1, 0.5, 1);
  return {Expect(2, text, {.quick = 1024, .depth = 100, .relative = 1e-4}, effort)};
}

// Spheres of every size next to each other: each is left without being met again.
std::vector<Point> LeaveSphere(double radius, const Effort& effort) {
  Draws draws(effort.seed);
  const Vec3d center{0.3, -0.8, 0.5};
  RayTrial trial(effort, Sphere(center, radius) + Sphere({-6, 0, 0}, 0.1));
  for (int i = 0; i < effort(2000, 200000); ++i) {
    const Vec3d n = draws.Direction();
    trial.rays.push_back({center + 1.5 * radius * n, -n});
  }
  std::uint64_t failures = trial.CountBad([&](const WorldHit& hit, std::size_t) {
    trial.leaving.push_back(draws.Above(hit.normal, 1e-3));
    return hit.found;
  });
  failures += trial.CountMet(radius);
  return {NoFailures(failures, 2 * trial.rays.size())};
}

}  // namespace

void AddSphereCases(std::vector<Case>& cases) {
  const CaseAdder rates{cases, "geometry", Truth::kRate};
  const CaseAdder closed{cases, "geometry", Truth::kClosedForm};
  rates({"sphere-far-from-origin", "a unit sphere at a distance from the origin, to 1e12",
         "its outline is that of a unit sphere within 1e-4",
         DecadesAxis("distance from the origin", "radii", {0, 12, 2}, {0, 10}),
         SphereFarFromOrigin, "pbrt-v3 #44, #265: spheres at 8e5 shrink"});
  rates({"sphere-far-from-eye", "a unit sphere and rays that start as far as 1e6 from it",
         "its outline is right within 4e-7 of the distance",
         DecadesAxis("distance of the eye", "radii", {1, 6}, {1, 6}), SphereFarFromEye});
  closed({"two-glass-spheres", "two balls of clear glass, 1e9 radii apart",
          "under a sky of 1 everything is 1",
          DecadesAxis("distance of the two", "radii", {1, 9, 2}, {1, 9}), TwoGlasses});
  rates({"concentric-spheres",
         "a sphere in one that is larger by 1e-1 to 1e-7 of the radius",
         "rays from each reach the other",
         DecadesAxis("gap", "radii", {-7, -1}, {-6, -1}), Shells,
         "mitsuba3 #1871: radii 1, 1 + 4e-5"});
  closed({"eye-inside-sphere",
          "the eye in a glowing ball, 1 to 1e-7 of its radius from the wall",
          "all around is L / (1 - albedo)",
          DecadesAxis("distance from the wall", "radii", {-7, 0}, {-7, 0}),
          InsideSphere});
  rates({"sphere-leave",
         "a sphere of radius 1e-6 to 1 away from the middle of a scene of size 1",
         "rays that leave it do not meet it again",
         DecadesAxis("radius", "", {-7, 0}, {-6, 0}), LeaveSphere});
}

}  // namespace lanelight::stress
