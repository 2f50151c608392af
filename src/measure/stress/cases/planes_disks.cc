// Planes and disks that are far, seen at grazing angles, or thin as a hair.
#include <fmt/format.h>

#include <cmath>

#include "src/measure/stress/cases/cases.h"
#include "src/measure/stress/cases/ray_trial.h"

namespace lanelight::stress {
namespace {

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
  for (int i = 0; i < effort(2000, 200000); ++i) {
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
  for (int i = 0; i < effort(2000, 200000); ++i) {
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
    for (int i = 0; i < effort(2000, 200000); ++i) {
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
  const std::string text = CameraText({0, 0, 0.5}, {0, 0, 0}, 0.01) +
                           "WorldBegin\nMaterial " + Diffuse(0.5) +
                           "\nShape \"disk\" \"float radius\" 2\n" +
                           Block(Glow(1, true) + Disk({0, 0, 1}, {0, 0, 1}, 1, inner));
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

void AddPlaneAndDiskCases(std::vector<Case>& cases) {
  const CaseAdder bounds{cases, "geometry", Truth::kBound};
  const CaseAdder rates{cases, "geometry", Truth::kRate};
  const CaseAdder closed_lights{cases, "lights", Truth::kClosedForm};
  const CaseAdder closed_geometry{cases, "geometry", Truth::kClosedForm};
  const auto angles = [](double low) {
    return DecadesAxis("sine of the angle", "", {-8, 0}, {low, 0});
  };
  bounds({"disk-grazing", "rays at a disk, at angles from 1 to 1e-7",
          "their length is right within 1e-6", angles(-7), GrazingDisk});
  bounds({"plane-grazing", "rays at an infinite plane, at angles from 1 to 1e-7",
          "their length is right within 1e-6", angles(-7), GrazingPlane});
  rates({"disk-far-from-origin", "a unit disk at a distance from the origin, to 1e10",
         "its rim is that of a unit disk within 1e-4",
         DecadesAxis("distance from the origin", "radii", {0, 12, 2}, {0, 10}),
         DiskFarFromOrigin});
  rates({"leave-plane-and-disk",
         "rays that leave a plane or a disk at angles from 1 to 1e-7",
         "none meets it again", angles(-6), LeaveFlat});
  closed_lights({"thin-ring", "a glowing ring of radius 1 and width 1 to 1e-5",
                 "it lights the floor under it as the formula says",
                 DecadesAxis("width of the ring", "radii", {-6, 0}, {-5, 0}), ThinRing});
  closed_geometry({"plane-horizon",
                   "the eye a height of 1e-6 to 1e8 above an infinite plane",
                   "the plane covers half of the view",
                   DecadesAxis("height", "", {-6, 8, 2}, {-6, 8}), Horizon});
}

}  // namespace lanelight::stress
