// Planes and disks that are far, seen at grazing angles, or thin as a hair.
#include <fmt/format.h>

#include "src/stress/cases/cases.h"
#include "src/stress/cases/points.h"
#include "src/stress/shapes_text.h"
#include "src/stress/trace_rays.h"

namespace lanelight::stress {
namespace {

// A disk across the unit vector n.
std::string Disk(Vec3d center, Vec3d n, double radius, double inner = 0) {
  const Across a(n);
  const auto column = [](Vec3d v) {
    return fmt::format("{:.17g} {:.17g} {:.17g} ", v.x, v.y, v.z);
  };
  return fmt::format(
      "AttributeBegin\nConcatTransform [{}0 {}0 {}0 {}1]\nShape \"disk\" \"float "
      "radius\" {:.17g} \"float innerradius\" {:.17g}\nAttributeEnd\n",
      column(a.u), column(a.v), column(n), column(center), radius, inner);
}

const Vec3d kTilted = Normalize(Vec3d{-0.4, 0.5, 0.7});

// Rays at an angle to a plane or disk end where they are aimed, along the surface within
// 2e-6 / sine and off it within 1e-6.
std::vector<Point> GrazingRays(double sine, const std::string& shape,
                               const Effort& effort) {
  Draws draws(effort.seed);
  RayTracer tracer(RayScene(shape, {0, 0, 1}));
  std::vector<WorldRay> rays;
  for (int i = 0; i < effort(2000, 200000); ++i) {
    const double phi = draws(0, 2 * M_PI), cosine = std::sqrt(1 - sine * sine);
    const Vec3d d{cosine * std::cos(phi), cosine * std::sin(phi), -sine};
    rays.push_back({Vec3d{draws(-0.1, 0.1), draws(-0.1, 0.1), 0} - 0.5 * d, d});
  }
  const std::vector<WorldHit> hits = tracer.Trace(rays);
  double worst = 0;
  for (std::size_t i = 0; i < hits.size(); ++i) {
    const WorldRay ray = tracer.Rounded(rays[i]);
    const double t = -ray.origin.z / ray.direction.z;
    worst = std::max(worst, hits[i].found ? std::abs(hits[i].t / t - 1) : 1.0);
  }
  return {BoundPoint(worst, 1e-6)};
}

std::vector<Point> GrazingDisk(double sine, const Effort& effort) {
  return GrazingRays(sine, Disk({}, {0, 0, 1}, 1), effort);
}

std::vector<Point> GrazingPlane(double sine, const Effort& effort) {
  return GrazingRays(sine, "Shape \"plane\"\n" + SphereText({3, 0, 0}, 0.5), effort);
}

// A unit disk at a distance from the origin: hit inside its rim by 1e-4, missed outside.
std::vector<Point> DiskFarFromOrigin(double distance, const Effort& effort) {
  Draws draws(effort.seed);
  const Vec3d center = distance * Normalize(Vec3d{-1, 0.4, 2});
  RayTracer tracer(RayScene(Disk(center, kTilted, 1), center + 5.0 * kTilted));
  const Across across(kTilted);
  std::vector<WorldRay> rays;
  for (int i = 0; i < effort(2000, 200000); ++i) {
    const double phi = draws(0, 2 * M_PI), off = i % 2 == 0 ? 1 - 1e-4 : 1 + 1e-4;
    const Vec3d rim = off * (std::cos(phi) * across.u + std::sin(phi) * across.v);
    const Vec3d d = -draws.Above(kTilted, 0.2);
    rays.push_back({center + rim - 3.0 * d, d});
  }
  std::uint64_t failures = 0;
  const std::vector<WorldHit> hits = tracer.Trace(rays);
  for (std::size_t i = 0; i < hits.size(); ++i) failures += hits[i].found != (i % 2 == 0);
  return {RatePoint(failures, rays.size())};
}

// Rays that leave a plane or a disk at an angle to it do not meet it again.
std::vector<Point> LeaveFlat(double sine, const Effort& effort) {
  Draws draws(effort.seed);
  std::vector<Point> points;
  const Across across(kTilted);
  const std::string plane = fmt::format(
      "AttributeBegin\nLookAt 0 0 0  {:.17g} {:.17g} {:.17g}  0 0 1\n"
      "Shape \"plane\"\nAttributeEnd\n",
      kTilted.x, kTilted.y, -kTilted.z);
  const std::string shapes[] = {Disk({}, kTilted, 1), plane};
  for (const bool is_plane : {false, true}) {
    RayTracer tracer(RayScene(shapes[is_plane] + SphereText({9, 9, 9}, 0.1), {0, 0, 5}));
    std::vector<WorldRay> rays;
    std::vector<Vec3d> leaving;
    for (int i = 0; i < effort(2000, 200000); ++i) {
      const Vec3d target = draws(-0.5, 0.5) * across.u + draws(-0.5, 0.5) * across.v;
      rays.push_back({target + 2.0 * kTilted, -kTilted});
    }
    for (const WorldHit& hit : tracer.Trace(rays)) {
      const Vec3d n = hit.found ? hit.normal : kTilted;
      const Across flat(n);
      const double phi = draws(0, 2 * M_PI);
      leaving.push_back(std::sqrt(1 - sine * sine) *
                            (std::cos(phi) * flat.u + std::sin(phi) * flat.v) +
                        sine * n);
    }
    std::uint64_t failures = 0;
    for (const bool blocked : tracer.Blocked(leaving, 10)) failures += blocked;
    points.push_back(RatePoint(failures, rays.size(), 0, is_plane ? "plane" : "disk"));
  }
  return points;
}

// A ring of outer radius 1 and a width, at a distance of 1 from a small view of the
// floor right under its centre: E = pi L (1 / (1 + ri^2) - 1 / (1 + ro^2)).
std::vector<Point> ThinRing(double width, const Effort& effort) {
  const double inner = 1 - width;
  const double form = width * (2 - width) / (2 * (1 + inner * inner));
  const std::string text =
      CameraText({0, 0, 0.5}, {0, 0, 0}, 0.01) +
      "WorldBegin\nMaterial \"diffuse\" \"rgb reflectance\" [0.5 0.5 0.5]\n"
      "Shape \"disk\" \"float radius\" 2\nAttributeBegin\n"
      "AreaLightSource \"diffuse\" \"rgb L\" [1 1 1] \"bool twosided\" true\n" +
      Disk({0, 0, 1}, {0, 0, 1}, 1, inner) + "AttributeEnd\n";
  return {Measure({.text = text,
                   .expected = 0.5 * form,
                   .relative = 1e-5 + 1e-7 / width,
                   .quick = 1024,
                   .depth = 1},
                  effort)};
}

// The eye a height above a plane with a ball of radius 1 on it, under a sky: the plane
// covers the lower half of the view exactly.
std::vector<Point> Horizon(double height, const Effort& effort) {
  const std::string text =
      CameraText({0, -5, height}, {0, 5, height}, 90) +
      "WorldBegin\nLightSource \"infinite\" \"rgb L\" [1 1 1]\n"
      "Material \"diffuse\" \"rgb reflectance\" [0.5 0.5 0.5]\nShape \"plane\"\n" +
      SphereText({0, 50, -2}, 1);
  return MeasureFurnace({.text = text, .expected = 0.75, .pixels = 16}, effort);
}

}  // namespace

void AddPlaneAndDiskCases(std::vector<Case>& cases) {
  const auto angles = [](double low) {
    return Decades("sine of the angle", "", -8, 0, 1, low, 0);
  };
  cases.push_back({"disk-grazing", "geometry", "rays at a disk, at angles from 1 to 1e-7",
                   "their length is right within 1e-6", "", Truth::kBound, angles(-7),
                   GrazingDisk});
  cases.push_back(
      {"plane-grazing", "geometry", "rays at an infinite plane, at angles from 1 to 1e-7",
       "their length is right within 1e-6", "", Truth::kBound, angles(-7), GrazingPlane});
  cases.push_back({"disk-far-from-origin", "geometry",
                   "a unit disk at a distance from the origin, to 1e10",
                   "its rim is that of a unit disk within 1e-4", "", Truth::kRate,
                   Decades("distance from the origin", "radii", 0, 12, 2, 0, 10),
                   DiskFarFromOrigin});
  cases.push_back({"leave-plane-and-disk", "geometry",
                   "rays that leave a plane or a disk at angles from 1 to 1e-7",
                   "none meets it again", "", Truth::kRate, angles(-6), LeaveFlat});
  cases.push_back(
      {"thin-ring", "lights", "a glowing ring of radius 1 and width 1 to 1e-5",
       "it lights the floor under it as the formula says", "", Truth::kClosedForm,
       Decades("width of the ring", "radii", -6, 0, 1, -5, 0), ThinRing});
  cases.push_back({"plane-horizon", "geometry",
                   "the eye a height of 1e-6 to 1e8 above an infinite plane",
                   "the plane covers half of the view", "", Truth::kClosedForm,
                   Decades("height", "", -6, 8, 2, -6, 8), Horizon});
}

}  // namespace lanelight::stress
