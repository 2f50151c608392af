// Instances: many, nested, huge, tiny, sheared and mirrored.
#include <fmt/format.h>

#include <utility>

#include "src/measure/stress/cases/cases.h"
#include "src/measure/stress/cases/ray_trial.h"

namespace lanelight::stress {
namespace {

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
  for (int i = 0; i < effort(1000, 100000); ++i) {
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
  return "Material " + Diffuse(0.5) + "\n" + Rectangle({-2, -2, 0}, {2, 2, 0}) + Glow(1) +
         lamps;
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

// Spheres under transforms that stretch them are refused; under others they are round.
std::vector<Point> StretchedSphere(double stretch, const Effort& effort) {
  const std::string sphere =
      Block("Rotate 20 1 1 0\n" + Scale(1, stretch, 1) + "Shape \"sphere\"");
  return Furnace(CameraText({3, 0.5, 1}, {}, 10), sphere, 1e-5, effort);
}

}  // namespace

void AddInstanceCases(std::vector<Case>& cases) {
  const CaseAdder rates{cases, "geometry", Truth::kRate};
  const CaseAdder closed_geometry{cases, "geometry", Truth::kClosedForm};
  const CaseAdder closed_lights{cases, "lights", Truth::kClosedForm};
  rates({"instances", "1 to 100 000 instances in a row",
         "each is hit, and left without being met again",
         DecadesAxis("instances", "", {0, 5}, {0, 5}), Count});
  closed_geometry({"nested-instance-scale",
                   "a mesh made 1e-6 to 1e6 times too large, brought to size by nested "
                   "transforms",
                   "convex, so as bright as its albedo",
                   DecadesAxis("scale", "", {-6, 6, 2}, {-6, 6}), NestedScale});
  closed_geometry({"tiny-instance",
                   "an instance of 1 to 1e-6 times the size of another beside it",
                   "convex, so as bright as its albedo",
                   DecadesAxis("scale", "", {-6, 0}, {-6, 0}), TinyInstance});
  closed_geometry({"sheared-instance",
                   "instances sheared, stretched and flattened 1 to 1e6 times",
                   "convex, so as bright as its albedo",
                   DecadesAxis("factor", "", {0, 6}, {0, 6}), Sheared});
  closed_geometry({"mirrored", "scene and camera mirrored in eight ways",
                   "the lamp shines to its own side", Single(), Mirrored});
  closed_lights(
      {"coplanar-lights", "two lights side by side in one plane, in both orders",
       "they light the floor as one light of both would", Single(), CoplanarLights});
  closed_geometry({"stretched-sphere", "a sphere stretched by 1 + 1e-7 to 1e6",
                   "round within 1e-5, or refused",
                   Axis{"stretch",
                        "",
                        true,
                        1 - 1e-5,
                        1 + 1e-5,
                        {1e-6, 0.5, 1 - 1e-7, 1, 1 + 1e-6, 2, 1e6},
                        {}},
                   StretchedSphere, "pbrt-v4, extreme transforms"});
}

}  // namespace lanelight::stress
