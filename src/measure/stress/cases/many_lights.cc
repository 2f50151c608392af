// Very many lights.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <string>

#include "src/measure/stress/cases/cases.h"
#include "src/measure/stress/cases/points.h"
#include "src/measure/stress/cases/scene_text.h"
#include "src/measure/stress/closed_forms.h"

namespace lanelight::stress {
namespace {

Point Selected(const std::string& selection, const std::string& text, double expected,
               const Effort& effort) {
  Quality quality = {1024, 16384, 1};
  quality.strategy = "light-selection=" + selection;
  return Named(quality.strategy, Expect(expected, text, quality, effort));
}

std::vector<Point> Points(double count, const Effort& effort) {
  const LightRing ring = RingOfLights(static_cast<int>(count));
  return {Selected("power", ring.text, ring.expected, effort),
          Selected("tree", ring.text, ring.expected, effort)};
}

// A square lamp above the plane, in n x n x 2 triangles that are lights of their own.
std::string Tessellated(int n, double radiance) {
  std::string positions, indices;
  for (int i = 0; i < (n + 1) * (n + 1); ++i) {
    positions += fmt::format(" {} {} 2", 0.5 + double(i % (n + 1)) / n,
                             -0.5 + double(i / (n + 1)) / n);
  }
  for (int i = 0; i < n * n; ++i) {
    const int at = i / n * (n + 1) + i % n;
    indices += fmt::format(" {} {} {} {} {} {}", at, at + 1, at + n + 2, at, at + n + 2,
                           at + n + 1);
  }
  return Block(AreaLightText(radiance, true) + "Material " + Diffuse(0) +
               "\nShape \"trianglemesh\" \"integer indices\" [" + indices +
               "] \"point3 P\" [" + positions + "]");
}

std::vector<Point> Triangles(double count, const Effort& effort) {
  const std::array<Vec3d, 4> corners = {Vec3d{0.5, -0.5, 2}, Vec3d{1.5, -0.5, 2},
                                        Vec3d{1.5, 0.5, 2}, Vec3d{0.5, 0.5, 2}};
  const double expected = 0.5 / 3.14159265358979 * PolygonIrradiance(corners);
  const int side = static_cast<int>(std::lround(std::sqrt(count / 2)));
  const std::string text =
      ViewOfPlane() + Plane(Diffuse(0.5)) + Tessellated(std::max(side, 1), 1);
  return {Selected("uniform", text, expected, effort),
          Selected("power", text, expected, effort),
          Selected("tree", text, expected, effort)};
}

}  // namespace

void AddManyLightCases(std::vector<Case>& cases) {
  const CaseAdder add{cases, "lights", Truth::kClosedForm};
  add({"many-lights", "1 to 1e6 point lights, over six decades of intensity",
       "the radiance of the plane below equals the sum over the lights",
       LogAxis("lights", "", {1, 1e6}, {1, 100, 1e4, 262144},
               {1, 10, 100, 1e3, 1e4, 1e5, 262144, 1e6}),
       Points});
  add({"emitting-triangles", "a lamp tessellated into 2 to 1e6 triangles",
       "the radiance of the plane below equals Lambert's formula for the whole lamp",
       LogAxis("triangles", "", {1, 1e6}, {2, 200, 20000}, {2, 200, 20000, 2e5, 2e6}),
       Triangles});
}

}  // namespace lanelight::stress
