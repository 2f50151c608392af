// Spheres that are huge, tiny, far, one in another, by rays and in closed form.
#include "src/stress/cases/cases.h"
#include "src/stress/cases/points.h"
#include "src/stress/shapes_text.h"
#include "src/stress/trace_rays.h"

namespace lanelight::stress {
namespace {

// A unit sphere far from the origin, and rays that begin `from` away: they hit it if they
// pass its centre within 1 - `off`, and miss it beyond 1 + `off`.
std::vector<Point> SilhouetteAt(double distance, double from, double off,
                                const Effort& effort) {
  Draws draws(effort.seed);
  const Vec3d center = distance * Normalize(Vec3d{1, 2, -0.3});
  const Vec3d eye = center + from * Normalize(Vec3d{-2, 1, 1});
  RayTracer tracer(RayScene(SphereText(center, 1), eye));
  std::vector<WorldRay> rays;
  std::vector<bool> inside;
  for (int i = 0; i < effort(2000, 200000); ++i) {
    const Vec3d d = -draws.Direction();
    const Across across(d);
    const double phi = draws(0, 2 * M_PI);
    inside.push_back(i % 2 == 0);
    const double rim = inside.back() ? 1 - off : 1 + off;
    const Vec3d edge = rim * (std::cos(phi) * across.u + std::sin(phi) * across.v);
    rays.push_back({center + edge - from * d, d});
  }
  std::uint64_t failures = 0;
  const std::vector<WorldHit> hits = tracer.Trace(rays);
  for (std::size_t i = 0; i < hits.size(); ++i) failures += hits[i].found != inside[i];
  return {RatePoint(failures, rays.size())};
}

std::vector<Point> SphereFarFromOrigin(double distance, const Effort& effort) {
  return SilhouetteAt(distance, 5, 1e-4, effort);
}

std::vector<Point> SphereFarFromEye(double distance, const Effort& effort) {
  return SilhouetteAt(0, distance, 4e-7 * distance, effort);
}

// Two balls of clear glass under a sky of 1: through them, too, everything is 1.
std::vector<Point> TwoGlasses(double apart, const Effort& effort) {
  const std::string text = CameraText({0.1, -6.3, 0.7}, {}, 14) +
                           "WorldBegin\nLightSource \"infinite\" \"rgb L\" [1 1 1]\n"
                           "Material \"dielectric\" \"float eta\" 1.5\n" +
                           SphereText({}, 1) +
                           SphereText(apart * Normalize(Vec3d{3, 1, -0.3}), 1);
  return {Measure({.text = text, .expected = 1, .quick = 256, .depth = 300}, effort)};
}

// A sphere of radius 1 in one of radius 1 + gap: rays from each reach the other.
std::vector<Point> Shells(double gap, const Effort& effort) {
  Draws draws(effort.seed);
  RayTracer tracer(RayScene(SphereText({}, 1) + SphereText({}, 1 + gap)));
  // Steep enough for the inner sphere, and not as far as through the outer one.
  const double steep = 0.05 + 1.3 * std::sqrt(2 * gap), reach = 1.5 * gap / steep;
  std::vector<WorldRay> inward, outward;
  std::vector<Vec3d> in, out;
  for (int i = 0; i < effort(2000, 200000); ++i) {
    const Vec3d n = draws.Direction();
    inward.push_back({3.0 * n, -n});
    outward.push_back({0.2 * n, n});
    in.push_back(-draws.Above(n, steep));
    out.push_back(draws.Above(n, 0.01));
  }
  std::uint64_t failures = 0;
  for (const WorldHit& hit : tracer.Trace(inward)) {
    failures += !hit.found || std::abs(Length(hit.point) - 1 - gap) > 0.5 * gap;
  }
  for (const bool blocked : tracer.Blocked(in, reach)) failures += !blocked;
  for (const WorldHit& hit : tracer.Trace(outward)) {
    failures += !hit.found || std::abs(Length(hit.point) - 1) > 0.5 * gap;
  }
  for (const bool blocked : tracer.Blocked(out)) failures += !blocked;
  return {RatePoint(failures, 4 * inward.size())};
}

// The eye in a ball that glows with 1 and has albedo 1/2, at a distance from its wall:
// all around there is 1 + 1/2 + 1/4 + ...
std::vector<Point> InsideSphere(double distance, const Effort& effort) {
  const std::string text =
      CameraText({1 - distance, 0, 0}, {-1, 0.3, 0.2}, 90) +
      "WorldBegin\nAreaLightSource \"diffuse\" \"rgb L\" [1 1 1]\n"
      "Material \"diffuse\" \"rgb reflectance\" [0.5 0.5 0.5]\nReverseOrientation\n" +
      SphereText({}, 1);
  return {Measure(
      {.text = text, .expected = 2, .relative = 1e-4, .quick = 1024, .depth = 100},
      effort)};
}

// Spheres of every size next to each other: each is left without being met again.
std::vector<Point> LeaveSphere(double radius, const Effort& effort) {
  Draws draws(effort.seed);
  const Vec3d center{0.3, -0.8, 0.5};
  RayTracer tracer(RayScene(SphereText(center, radius) + SphereText({-6, 0, 0}, 0.1)));
  std::vector<WorldRay> rays;
  std::vector<Vec3d> leaving;
  std::uint64_t failures = 0;
  for (int i = 0; i < effort(2000, 200000); ++i) {
    const Vec3d n = draws.Direction();
    rays.push_back({center + 1.5 * radius * n, -n});
  }
  for (const WorldHit& hit : tracer.Trace(rays)) {
    failures += !hit.found;
    leaving.push_back(draws.Above(hit.normal, 1e-3));
  }
  for (const bool blocked : tracer.Blocked(leaving, radius)) failures += blocked;
  return {RatePoint(failures, 2 * rays.size())};
}

}  // namespace

void AddSphereCases(std::vector<Case>& cases) {
  cases.push_back({"sphere-far-from-origin", "geometry",
                   "a unit sphere at a distance from the origin, to 1e12",
                   "its outline is that of a unit sphere within 1e-4",
                   "pbrt-v3 #44, #265: spheres at 8e5 shrink", Truth::kRate,
                   Decades("distance from the origin", "radii", 0, 12, 2, 0, 10),
                   SphereFarFromOrigin});
  cases.push_back({"sphere-far-from-eye", "geometry",
                   "a unit sphere and rays that start as far as 1e6 from it",
                   "its outline is right within 4e-7 of the distance", "", Truth::kRate,
                   Decades("distance of the eye", "radii", 1, 6, 1, 1, 6),
                   SphereFarFromEye});
  cases.push_back({"two-glass-spheres", "geometry",
                   "two balls of clear glass, 1e9 radii apart",
                   "under a sky of 1 everything is 1", "", Truth::kClosedForm,
                   Decades("distance of the two", "radii", 1, 9, 2, 1, 9), TwoGlasses});
  cases.push_back({"concentric-spheres", "geometry",
                   "a sphere in one that is larger by 1e-1 to 1e-7 of the radius",
                   "rays from each reach the other", "mitsuba3 #1871: radii 1, 1 + 4e-5",
                   Truth::kRate, Decades("gap", "radii", -7, -1, 1, -6, -1), Shells});
  cases.push_back({"eye-inside-sphere", "geometry",
                   "the eye in a glowing ball, 1 to 1e-7 of its radius from the wall",
                   "all around is L / (1 - albedo)", "", Truth::kClosedForm,
                   Decades("distance from the wall", "radii", -7, 0, 1, -7, 0),
                   InsideSphere});
  cases.push_back(
      {"sphere-leave", "geometry",
       "a sphere of radius 1e-6 to 1 away from the middle of a scene of size 1",
       "rays that leave it do not meet it again", "", Truth::kRate,
       Decades("radius", "", -7, 0, 1, -6, 0), LeaveSphere});
}

}  // namespace lanelight::stress
