// Scenes of any size, with instances of any size, and with nothing in them.
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "tests/extremes/ray_trial.h"

namespace lanelight::stress {
namespace {

// A square light of side 1 at height 1 over a floor, seen at a point of the floor: the
// closed form is that of its four right angles. In any unit of length.
std::vector<Point> LampOverFloor(double unit, const Effort& effort) {
  const double u = unit;
  const std::string text =
      CameraText({0, 0, u / 2}, {0, 0, 0}, 0.01) + "WorldBegin\nMaterial " +
      Diffuse(0.5) + "\n" + Rectangle({-5 * u, -5 * u, 0}, {5 * u, 5 * u, 0}) +
      AreaLightText(1) + Rectangle({-u / 2, -u / 2, u}, {u / 2, u / 2, u}, false);
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
  for (int i = 0; i < 2000; ++i) {
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

std::string Object(const std::string& shapes) {
  return "ObjectBegin \"thing\"\n" + shapes + "ObjectEnd\n";
}

std::string Placed(const std::string& transforms) {
  return Block(transforms + "ObjectInstance \"thing\"");
}

std::string Scale(double x, double y, double z) {
  return fmt::format("Scale {:.17g} {:.17g} {:.17g}\n", x, y, z);
}

std::vector<Point> Furnace(const std::string& camera, const std::string& shapes,
                           double relative, const Effort& effort) {
  return ExpectBothWays(0.5, SkyScene(camera, 0.5, shapes), {.relative = relative},
                        effort);
}

// What a floor of albedo 1/2 has one unit below the middle of a square light of side 2
// and radiance 1: the form factor of a parallel square above its corner, four times.
double UnderLamp() {
  const double half = 1 / std::sqrt(2.0);
  return 0.5 * 4 / M_PI * half * std::atan(half);
}

// As many instances of a square, in one place: hit, and left again.
std::vector<Point> Count(double count, const Effort& effort) {
  Draws draws(effort.seed);
  std::string text = Object(Rectangle({-1, -1, 0}, {1, 1, 0}));
  const int n = static_cast<int>(std::lround(count));
  for (int i = 0; i < n; ++i) {
    text += Placed(fmt::format("Translate {} 0 0\n", 3 * i));
  }
  RayTrial trial(effort, text);
  for (int i = 0; i < 1000; ++i) {
    const double x = 3 * std::floor(draws(0, n)) + draws(-0.9, 0.9);
    const Vec3d d = -draws.Above({0, 0, 1}, 0.5);
    trial.Aim({x, draws(-0.9, 0.9), 0}, d, 1);
    trial.leaving.push_back(draws.Above({0, 0, 1}, 1e-3));
  }
  const std::uint64_t bad = trial.CountBad([&](const WorldHit& hit, std::size_t) {
    return hit.found && std::abs(hit.t - 1) <= 1e-6 * n;
  });
  return {NoFailures(bad + trial.CountMet(), 2 * trial.rays.size())};
}

// A closed mesh, made in other units and brought to size by nested transforms.
std::vector<Point> NestedScale(double scale, const Effort& effort) {
  const std::string text =
      Object(SphereMesh(16, 32, {}, 1 / scale).Text()) +
      Placed(Scale(scale * scale, scale * scale, scale * scale) + "Rotate 33 1 2 3\n" +
             Scale(1 / scale, 1 / scale, 1 / scale));
  return Furnace(CameraText({3, 0.5, 1}, {}, 20), text, 1e-5, effort);
}

// The same mesh, tiny beside one of size 1, seen from close by.
std::vector<Point> TinyInstance(double scale, const Effort& effort) {
  const std::string text = Object(SphereMesh(16, 32, {}, 1).Text()) +
                           Placed("Translate -2 0 0\n") +
                           Placed(Scale(scale, scale, scale));
  return Furnace(CameraText(scale * Vec3d{3, 0.5, 1}, {}, 20), text, 1e-4, effort);
}

// A sphere sheared or stretched is convex still: what leaves it does not come back.
std::vector<Point> Sheared(double shear, const Effort& effort) {
  std::vector<Point> points;
  const std::string object = Object(SphereMesh(16, 32, {}, 1).Text());
  const std::pair<const char*, std::string> kinds[] = {
      {"shear ",
       fmt::format("ConcatTransform [1 0 0 0  {:.17g} 1 0 0  0 0 1 0  0 0 0 1]\n",
                   shear)},
      {"stretch ", Scale(shear, 1, 1)},
      {"flat ", Scale(1, 1, 1 / shear)}};
  for (const auto& [name, transform] : kinds) {
    // In the transformed coordinates all of them look like the unit sphere's middle.
    for (const Point& point : Furnace(CameraText({0.1, 0, 4}, {0.1, 0, 0}, 2 / shear),
                                      object + Placed(transform), 1e-4, effort)) {
      points.push_back(Named(name + point.series, point));
    }
  }
  return points;
}

// The floor, and lamps one unit above it.
std::string UnderLamps(const std::string& lamps) {
  return "Material " + Diffuse(0.5) + "\n" + Rectangle({-2, -2, 0}, {2, 2, 0}) +
         AreaLightText(1) + lamps;
}

// A lamp that shines to one side only, told in eight mirrored ways.
std::vector<Point> Mirrored(double, const Effort& effort) {
  std::vector<Point> points;
  for (int k = 0; k < 8; ++k) {
    const double x = k & 1 ? -1 : 1, y = k & 2 ? -1 : 1, z = k & 4 ? -1 : 1;
    const std::string text = "LookAt 0 0 0.5  0 0 0  0 1 0\n" + Scale(x, y, z) +
                             "Camera \"perspective\" \"float fov\" 0.01\nWorldBegin\n" +
                             Scale(x, y, z) +
                             UnderLamps(Rectangle({-1, -1, 1}, {1, 1, 1}, false));
    points.push_back(Named(fmt::format("{} {} {}", x, y, z),
                           Expect(UnderLamp(), text, {.depth = 1}, effort)));
  }
  return points;
}

// Two glowing squares side by side in one plane, in both orders, and both as one.
std::vector<Point> CoplanarLights(double, const Effort& effort) {
  const std::string left = Rectangle({-1, -1, 1}, {0, 1, 1}, false);
  const std::string right = Rectangle({0, -1, 1}, {1, 1, 1}, false);
  const auto lit = [&](const std::string& lamps) {
    return Expect(UnderLamp(),
                  CameraText({0, 0, 0.5}, {}, 0.01) + "WorldBegin\n" + UnderLamps(lamps),
                  {.quick = 256, .depth = 1}, effort);
  };
  return {Named("left first", lit(left + right)),
          Named("right first", lit(right + left))};
}

std::vector<Point> StretchedSphere(double stretch, const Effort& effort) {
  const std::string sphere =
      Block("Rotate 20 1 1 0\n" + Scale(1, stretch, 1) + "Shape \"sphere\"");
  return Furnace(CameraText({3, 0.5, 1}, {}, 10), sphere, 1e-5, effort);
}

}  // namespace

// mitsuba2 #171 (1 to 1e7), mitsuba3 #1962 (1e-3), embree #416 (6e11).
TEST_CASE("extremes: a lamp over a floor in units of 1e-15 to 1e15") {
  CheckPoints(Decades(-15, 15, 5), LampOverFloor);
}
// pbrt-v4 #186 (1e4 to 1e6).
TEST_CASE("extremes: rays end on flat patches of sides 1 to 1e12, and leave them") {
  CheckPoints(Decades(0, 12, 2), Patches);
}
TEST_CASE("extremes: scenes without a shape that can be hit show the sky") {
  CheckPoints(Empty);
}
TEST_CASE("extremes: 1 to 100 000 instances are hit, and left") {
  CheckPoints(Decades(0, 5), Count);
}
TEST_CASE("extremes: nested transforms that undo a scale of 1e-6 to 1e6") {
  CheckPoints(Decades(-6, 6, 2), NestedScale);
}
TEST_CASE("extremes: an instance 1e-6 times the size of another") {
  CheckPoints(Decades(-6, 0), TinyInstance);
}
TEST_CASE("extremes: instances sheared, stretched and flattened up to 1e6 times") {
  CheckPoints(Decades(0, 6), Sheared);
}
TEST_CASE("extremes: a lamp emits to its own side under any mirroring") {
  CheckPoints(Mirrored);
}
TEST_CASE("extremes: two lights side by side are one light, in both orders") {
  CheckPoints(CoplanarLights);
}
TEST_CASE("extremes: a sphere stretched by 1e-7 is round within 1e-5") {
  CheckPoints({1 - 1e-7, 1, 1 + 1e-6}, StretchedSphere);
}

}  // namespace lanelight::stress
