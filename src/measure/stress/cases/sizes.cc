// Scenes of any size, and of nothing.
#include <cmath>
#include <utility>

#include "src/measure/stress/cases/cases.h"
#include "src/measure/stress/cases/ray_trial.h"

namespace lanelight::stress {
namespace {

// A square light of side 1 at height 1 over a floor, seen at a point of the floor: the
// closed form is that of its four right angles. In any unit of length.
std::vector<Point> LampOverFloor(double unit, const Effort& effort) {
  const double u = unit;
  const std::string text = CameraText({0, 0, u / 2}, {0, 0, 0}, 0.01) +
                           "WorldBegin\nMaterial " + Diffuse(0.5) + "\n" +
                           Rectangle({-5 * u, -5 * u, 0}, {5 * u, 5 * u, 0}) + Glow(1) +
                           Rectangle({-u / 2, -u / 2, u}, {u / 2, u / 2, u}, false);
  // Form factor of a parallel rectangle above its corner, a = b = 1/2, four times.
  const double x = 0.5 / std::sqrt(1.25);
  return {Expect(0.5 * 4 / M_PI * x * std::atan(x), text, {.quick = 256, .depth = 1},
                 effort)};
}

// Flat patches of a side of 10^k, and far from the origin by as much: rays end on them
// and leave them.
std::vector<Point> Patches(double size, const Effort& effort) {
  Draws draws(effort.seed);
  const Vec3d center = size * Vec3d{3, -1, 2};
  const Vec3d n = Normalize(Vec3d{0.2, 0.3, 1});
  const Across a(n);
  std::string text = "Shape \"bilinearmesh\" \"point3 P\" [";
  for (const auto& [s, t] : {std::pair{-1, -1}, {1, -1}, {-1, 1}, {1, 1}}) {
    text += Numbers(center + size * (double(s) * a.u + double(t) * a.v));
  }
  RayTrial trial(effort, text + "] \"integer indices\" [0 1 2 3]\n",
                 center + 3 * size * n);
  for (int i = 0; i < effort(2000, 200000); ++i) {
    const Vec3d d = -draws.Above(n, 0.2);
    trial.Aim(center + 0.9 * size * (draws(-1, 1) * a.u + draws(-1, 1) * a.v), d, size);
    trial.leaving.push_back(draws.Above(n, 1e-3));
  }
  const std::uint64_t bad = trial.CountBad([&](const WorldHit& hit, std::size_t) {
    return hit.found && std::abs(hit.t / size - 1) <= 1e-5;
  });
  return {NoFailures(bad + trial.CountMet(), 2 * trial.rays.size())};
}

// Nothing to hit: what is there is the sky.
std::vector<Point> Empty(double, const Effort& effort) {
  std::vector<Point> points;
  const std::pair<const char*, const char*> scenes[] = {
      {"no shape", ""},
      {"degenerate",
       "Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 1 1 2 2 2] \"integer indices\" "
       "[0 1 2]\n"},
      {"alpha 0", "Shape \"sphere\" \"float alpha\" 0\n"},
      {"interface", "Material \"interface\"\nShape \"sphere\"\n"}};
  for (const auto& [name, shapes] : scenes) {
    points.push_back(
        Named(name, Expect(1, SkyScene(CameraText({0, 0, 5}, {}, 30), 0.5, shapes),
                           {.quick = 4, .size = 4, .relative = 1e-6}, effort)));
  }
  return points;
}

}  // namespace

void AddSizeCases(std::vector<Case>& cases) {
  const CaseAdder closed{cases, "geometry", Truth::kClosedForm};
  const CaseAdder rates{cases, "geometry", Truth::kRate};
  closed({"lamp-over-floor",
          "a square light one unit above a floor, the unit 1e-15 to 1e15",
          "the floor under it is as bright as the formula says",
          DecadesAxis("unit of length", "", {-15, 15, 5}, {-15, 15}), LampOverFloor,
          "mitsuba2 #171 (1 to 1e7), mitsuba3 #1962 (1e-3), embree #416 (6e11)"});
  rates({"patches", "flat patches of sides 1 to 1e12, and as far",
         "rays end on them and leave them", DecadesAxis("side", "", {0, 12, 2}, {0, 12}),
         Patches, "pbrt-v4 #186 (1e4 to 1e6)"});
  closed({"nothing-to-hit", "scenes without a shape that can be hit", "one sees the sky",
          Single(), Empty, "embree"});
}

}  // namespace lanelight::stress
