// Lights of any size and place: disks, quads, spots, points at the surface, far suns.
#include <fmt/format.h>

#include <array>
#include <cmath>

#include "src/base/core/pi.h"
#include "src/measure/stress/cases/cases.h"
#include "src/measure/stress/cases/points.h"
#include "src/measure/stress/cases/scene_text.h"
#include "src/measure/stress/closed_forms.h"

namespace lanelight::stress {
namespace {

constexpr double kAlbedo = 0.5;
// Returns the radiance of a diffuse plane under an irradiance.
constexpr double Shown(double irradiance) { return kAlbedo / kPi * irradiance; }

const Quality kDirect = {.depth = 1};

// A point of the plane, aslant from above, and a lamp.
std::string Below(const std::string& lamp) {
  return "LookAt 0 -1 1  0 0 0  0 0 1\nCamera \"orthographic\" \"float screenwindow\" "
         "[-1e-6 1e-6 -1e-6 1e-6]\nPixelFilter \"box\"\nWorldBegin\n" +
         Plane(Diffuse(kAlbedo)) + Block(lamp);
}

// A disk above the origin, parallel to the plane: pi L r^2 / (r^2 + d^2).
std::vector<Point> Disk(double radius, const Effort& effort) {
  std::vector<Point> points;
  const double radiance = 1 / (radius * radius);
  for (const bool two_sided : {false, true}) {
    const std::string text = Below(
        AreaLightText(radiance, two_sided) + (two_sided ? "" : "ReverseOrientation\n") +
        fmt::format("Translate 0 0 2\nMaterial {}\nShape \"disk\" \"float radius\" "
                    "{:.17g}",
                    Diffuse(0), radius));
    points.push_back(
        Named(two_sided ? "two-sided" : "one-sided",
              Expect(Shown(kPi / (radius * radius + 4)), text, kDirect, effort)));
  }
  return points;
}

// A quad two units above the plane, aside of what is seen.
std::vector<Point> Quad(double half, const Effort& effort) {
  const double x = 1;
  const std::array<Vec3d, 4> corner = {
      Vec3d{x - half, -half, 2}, Vec3d{x + half, -half, 2}, Vec3d{x + half, half, 2},
      Vec3d{x - half, half, 2}};
  const double radiance = 1 / (half * half);
  const std::string text = Below(AreaLightText(radiance, true) + "Material " +
                                 Diffuse(0) + "\n" + Rectangle(corner[0], corner[2]));
  return {Expect(Shown(radiance * PolygonIrradiance(corner)), text, kDirect, effort)};
}

// A window ten heights wide below a point light: its share of the light is a solid angle.
std::vector<Point> NearPoint(double height, const Effort& effort) {
  const double half = 5 * height;
  const std::string text =
      ViewOfPlane(1, half) + Plane(Diffuse(kAlbedo)) + Sphere({3, 3, -3}, 1, Diffuse(0)) +
      fmt::format("LightSource \"point\" \"point3 from\" [0 0 {:.17g}]{}\n", height,
                  Grey("I", height * height));
  const double irradiance =
      height * height * SquareSolidAngle(half, height) / (4 * half * half);
  Point point = Expect(Shown(irradiance), text, kDirect, effort);
  // Places are rounded to single precision in a frame as large as the scene.
  point.tolerance += 0x1p-24 / height * point.expected;
  return {point};
}

// Within the cone, and all of it: the smooth step between the angles is 1/2 in the mean.
std::vector<Point> Spot(double degrees, const Effort& effort) {
  const double angle = degrees * kPi / 180;
  const auto scene = [&](double half, double delta) {
    return ViewOfPlane(1, half) + Plane(Diffuse(kAlbedo)) +
           fmt::format(
               "LightSource \"spot\" \"point3 from\" [0 0 2] \"point3 to\" [0 0 0] "
               "\"rgb I\" [4 4 4] \"float coneangle\" {:.17g} \"float "
               "conedeltaangle\" {:.17g}\n",
               degrees, delta * degrees);
  };
  const double inner = 2 * std::tan(0.3 * angle), outer = 2.1 * std::tan(angle);
  // 1 - cos t = 2 sin^2 (t / 2), for cones that cosines cannot tell apart.
  const auto cap = [](double t) { return 2 * std::sin(t / 2) * std::sin(t / 2); };
  const double flux = 4 * 2 * kPi * (cap(angle) + cap(angle / 2)) / 2;
  return {
      Named("middle", Expect(Shown(4 * SquareSolidAngle(inner, 2) / (4 * inner * inner)),
                             scene(inner, 0.5), kDirect, effort)),
      Named("whole cone", Expect(Shown(flux / (4 * outer * outer)), scene(outer, 0.5),
                                 kDirect, effort)),
      Named("without falloff", Expect(Shown(8 * kPi * cap(angle) / (4 * outer * outer)),
                                      scene(outer, 0), kDirect, effort))};
}

// A sun of always the same angle, farther and farther away.
std::vector<Point> FarSun(double distance, const Effort& effort) {
  std::vector<Point> points;
  for (double sine : {5e-3, 1e-5}) {
    const double radiance = 1 / (sine * sine);
    const std::string text =
        ViewOfPlane() + Plane(Diffuse(kAlbedo)) +
        SphereLight({0.6 * distance, 0, 0.8 * distance}, sine * distance, radiance);
    points.push_back(Named(fmt::format("sine {:g}", sine),
                           Expect(kAlbedo * 0.8, text, kDirect, effort)));
  }
  return points;
}

}  // namespace

void AddLightSizeCases(std::vector<Case>& cases) {
  const CaseAdder add{cases, "lights", Truth::kClosedForm};
  add({"disk-light-radius", "radius of a disk light, from 100 to 1e-8 of its distance",
       "the radiance of the plane below equals the closed form, for one-sided and "
       "two-sided lamps",
       LogAxis("radius", "", {1e-8, 100}, Decades(-8, 2, 2), Decades(-8, 2)), Disk});
  add({"quad-light-size", "size of a quad light, from 100 to 1e-8 of its distance",
       "Lambert's formula for polygons",
       LogAxis("half side", "", {1e-6, 100}, Decades(-8, 2, 2), Decades(-8, 2)), Quad});
  add({"point-light-height", "a point light 1 to 1e-8 above a surface",
       "the irradiance on a square equals the solid angle, within the rounding of "
       "positions",
       LogAxis("height", "", {1e-6, 1}, Decades(-8, 0)), NearPoint});
  add({"spot-cone-angle", "a spot light with a cone of 60 to 1e-3 degrees",
       "intensity and flux of the cone",
       LogAxis("cone angle", "degrees", {1e-3, 60}, {1e-3, 1e-2, 0.1, 1, 10, 60}), Spot});
  add({"sun-distance", "a sun of the same angle, 10 to 1e9 units away",
       "the plane has the same radiance",
       LogAxis("distance", "", {10, 1e7}, Decades(1, 9, 2), Decades(1, 9)), FarSun,
       "povray #469"});
}

}  // namespace lanelight::stress
