// Spheres, planes and disks that are huge, tiny, far, thin or seen at grazing angles.
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <cmath>

#include "tests/extremes/ray_trial.h"

namespace lanelight::stress {
namespace {

// A unit sphere far from the origin, and rays that begin `from` away: they hit it if they
// pass its centre within 1 - `off`, and miss it beyond 1 + `off`.
std::vector<Point> SilhouetteAt(double distance, double from, double off,
                                const Effort& effort) {
  Draws draws(effort.seed);
  const Vec3d center = distance * Normalize(Vec3d{1, 2, -0.3});
  RayTrial trial(effort, Sphere(center, 1), center + from * Normalize(Vec3d{-2, 1, 1}));
  for (int i = 0; i < 2000; ++i) {
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
  for (int i = 0; i < 2000; ++i) {
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
  for (int i = 0; i < 2000; ++i) {
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

// A disk across the unit vector n.
std::string Disk(Vec3d center, Vec3d n, double radius, double inner = 0) {
  const Across a(n);
  return Block(fmt::format(
      "ConcatTransform [{}0 {}0 {}0 {}1]\nShape \"disk\" \"float radius\" {:.17g} "
      "\"float innerradius\" {:.17g}",
      Numbers(a.u), Numbers(a.v), Numbers(n), Numbers(center), radius, inner));
}

const Vec3d kTilted = Normalize(Vec3d{-0.4, 0.5, 0.7});

// Rays at an angle to a plane or disk end where they are aimed, along the surface within
// 2e-6 / sine and off it within 1e-6.
std::vector<Point> GrazingRays(double sine, const std::string& shape,
                               const Effort& effort) {
  Draws draws(effort.seed);
  RayTrial trial(effort, shape, {0, 0, 1});
  for (int i = 0; i < 2000; ++i) {
    const double phi = draws(0, 2 * M_PI), cosine = std::sqrt(1 - sine * sine);
    const Vec3d d{cosine * std::cos(phi), cosine * std::sin(phi), -sine};
    const Vec3d target{draws(-0.1, 0.1), draws(-0.1, 0.1), 0};
    trial.Aim(target, d, 0.5);
  }
  const double worst = trial.Worst([&](const WorldHit& hit, std::size_t i) {
    const WorldRay ray = trial.tracer.Rounded(trial.rays[i]);
    return std::abs(hit.t / (-ray.origin.z / ray.direction.z) - 1);
  });
  return {BoundPoint(worst, 1e-6)};
}

std::vector<Point> GrazingDisk(double sine, const Effort& effort) {
  return GrazingRays(sine, Disk({}, {0, 0, 1}, 1), effort);
}

std::vector<Point> GrazingPlane(double sine, const Effort& effort) {
  return GrazingRays(sine, "Shape \"plane\"\n" + Sphere({3, 0, 0}, 0.5), effort);
}

// A unit disk at a distance from the origin: hit inside its rim by 1e-4, missed outside.
std::vector<Point> DiskFarFromOrigin(double distance, const Effort& effort) {
  Draws draws(effort.seed);
  const Vec3d center = distance * Normalize(Vec3d{-1, 0.4, 2});
  RayTrial trial(effort, Disk(center, kTilted, 1), center + 5.0 * kTilted);
  const Across across(kTilted);
  for (int i = 0; i < 2000; ++i) {
    const Vec3d rim = across.At(draws(0, 2 * M_PI));
    const Vec3d d = -draws.Above(kTilted, 0.2);
    trial.Aim(center + (i % 2 == 0 ? 1 - 1e-4 : 1 + 1e-4) * rim, d, 3);
  }
  const std::uint64_t failures = trial.CountBad(
      [](const WorldHit& hit, std::size_t i) { return hit.found == (i % 2 == 0); });
  return {NoFailures(failures, trial.rays.size())};
}

// Rays that leave a plane or a disk at an angle to it do not meet it again.
std::vector<Point> LeaveFlat(double sine, const Effort& effort) {
  Draws draws(effort.seed);
  const Across across(kTilted);
  const auto leave = [&](const std::string& shape) {
    RayTrial trial(effort, shape + Sphere({9, 9, 9}, 0.1), {0, 0, 5});
    for (int i = 0; i < 2000; ++i) {
      const Vec3d target = draws(-0.5, 0.5) * across.u + draws(-0.5, 0.5) * across.v;
      trial.Aim(target, -kTilted, 2);
    }
    for (const WorldHit& hit : trial.tracer.Trace(trial.rays)) {
      trial.leaving.push_back(draws.AtSine(hit.found ? hit.normal : kTilted, sine));
    }
    return NoFailures(trial.CountMet(10), trial.rays.size());
  };
  const std::string plane =
      Block(fmt::format("LookAt 0 0 0  {} 0 0 1\nShape \"plane\"",
                        Numbers({kTilted.x, kTilted.y, -kTilted.z})));
  return {Named("disk", leave(Disk({}, kTilted, 1))), Named("plane", leave(plane))};
}

// A ring of outer radius 1 and a width, at a distance of 1 from a small view of the
// floor right under its centre: E = pi L (1 / (1 + ri^2) - 1 / (1 + ro^2)).
std::vector<Point> ThinRing(double width, const Effort& effort) {
  const double inner = 1 - width;
  const double form = width * (2 - width) / (2 * (1 + inner * inner));
  const std::string text =
      CameraText({0, 0, 0.5}, {0, 0, 0}, 0.01) + "WorldBegin\nMaterial " + Diffuse(0.5) +
      "\nShape \"disk\" \"float radius\" 2\n" +
      Block(AreaLightText(1, true) + Disk({0, 0, 1}, {0, 0, 1}, 1, inner));
  return {Expect(0.5 * form, text,
                 {.quick = 1024, .depth = 1, .relative = 1e-5 + 1e-7 / width}, effort)};
}

// The eye a height above a plane with a ball of radius 1 on it, under a sky: the plane
// covers the lower half of the view exactly.
std::vector<Point> Horizon(double height, const Effort& effort) {
  const std::string camera = CameraText({0, -5, height}, {0, 5, height}, 90);
  return ExpectBothWays(
      0.75, SkyScene(camera, 0.5, "Shape \"plane\"\n" + Sphere({0, 50, -2}, 1)),
      {.size = 16}, effort);
}

}  // namespace

// pbrt-v3 #44, #265: spheres at 8e5 shrink.
TEST_CASE("extremes: spheres keep their outline up to 1e10 radii from the origin") {
  CheckPoints(Decades(0, 10, 2), SphereFarFromOrigin);
}
TEST_CASE("extremes: spheres keep their outline up to 1e6 radii from the eye") {
  CheckPoints(Decades(1, 6), SphereFarFromEye);
}
TEST_CASE("extremes: two glass spheres 1e9 radii apart are white in a furnace") {
  CheckPoints(Decades(1, 9, 2), TwoGlasses);
}
// mitsuba3 #1871: radii 1, 1 + 4e-5.
TEST_CASE("extremes: rays between spheres 1e-6 of their radius apart reach the other") {
  CheckPoints(Decades(-6, -1), Shells);
}
TEST_CASE("extremes: a glowing ball is even 1e-7 of its radius from the wall") {
  CheckPoints(Decades(-7, 0), InsideSphere);
}
TEST_CASE("extremes: rays leave spheres of 1e-6 of the scene") {
  CheckPoints(Decades(-6, 0), LeaveSphere);
}
TEST_CASE("extremes: ground spheres of radius 1e8 are as bright as their albedo") {
  CheckPoints(Decades(0, 8), GroundUnderSky);
}
TEST_CASE("extremes: a lamp above a ground sphere of radius 1e8") {
  CheckPoints(Decades(4, 8), GroundUnderLamp);
}
TEST_CASE("extremes: a ball on a ground sphere of radius 1e6") {
  CheckPoints(Decades(0, 6, 3), BallOnGround);
}
TEST_CASE("extremes: rays at disks and planes at angles to 1e-7 have the right length") {
  CheckPoints(Decades(-7, 0), GrazingDisk);
  CheckPoints(Decades(-7, 0), GrazingPlane);
}
TEST_CASE("extremes: disks keep their rim up to 1e10 radii from the origin") {
  CheckPoints(Decades(0, 10, 2), DiskFarFromOrigin);
}
TEST_CASE("extremes: grazing rays leave planes and disks") {
  CheckPoints(Decades(-6, 0), LeaveFlat);
}
TEST_CASE("extremes: rings of width 1e-5 light the floor as the formula says") {
  CheckPoints(Decades(-5, 0), ThinRing);
}
TEST_CASE("extremes: an infinite plane covers half of the view from heights to 1e8") {
  CheckPoints(Decades(-6, 8, 2), Horizon);
}

}  // namespace lanelight::stress
