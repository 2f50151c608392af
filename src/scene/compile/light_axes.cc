#include "src/scene/compile/light_axes.h"

#include <algorithm>
#include <cmath>

#include "src/base/core/error.h"
#include "src/base/core/pi.h"
#include "src/scene/compile/store.h"

namespace lanelight {
namespace {

// Beyond this ratio of axes the edge of a stretched cone is not searched for its widest
// place: the cone is then all directions.
constexpr double kMaxSearchedRatio = 100;
constexpr int kEdgeRays = 4096;
// For what lies between them, relative.
constexpr double kEdgeMargin = 1.01;

// 1 - cos of the angle between unit vectors.
double Versine(Vec3d a, Vec3d b) { return Dot(a - b, a - b) / 2; }

double RatioOfAxes(const Transform& t) {
  const double a = Length(t.Vector({1, 0, 0})), b = Length(t.Vector({0, 1, 0})),
               c = Length(t.Vector({0, 0, 1}));
  // The volume tells how far from rectangular the axes are.
  const double volume = std::abs(t.Determinant3());
  return std::pow(std::max({a, b, c}), 3) / volume;
}

}  // namespace

Transform LightFromScene(const Light& light) {
  const Transform inverse = light.world_from_light.Inverse();
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      const double value = std::abs(inverse(row, column));
      if (value <= 1e18) continue;  // squares must stay in float32
      throw InputError(light.where,
                       "the transform of this light shrinks by more than 1e18");
    }
  }
  return inverse;
}

void StoreAxes(const Light& light, const LightAxes& axes, LightImage& image) {
  const Transform t = LightFromScene(light);
  // Dot(axis, t w) = Dot(transposed t axis, w).
  const Transform transposed = t.Transposed();
  Store(transposed.Vector(axes.x), image.x_axis);
  Store(transposed.Vector(axes.y), image.y_axis);
  Store(transposed.Vector(axes.z), image.z_axis);
}

LightCone ConeAround(const Light& light, Vec3d axis, const std::vector<Vec3d>& edge) {
  const Transform& t = light.world_from_light;
  LightCone cone{Normalize(t.Vector(axis))};
  for (const Vec3d& ray : edge) {
    cone.versine = std::max(cone.versine, Versine(cone.axis, Normalize(t.Vector(ray))));
  }
  return cone;
}

LightCone StretchedCone(const Light& light, Vec3d axis, double degrees) {
  if (degrees >= 90 || RatioOfAxes(light.world_from_light) > kMaxSearchedRatio) {
    return {Normalize(light.world_from_light.Vector(axis)), 2};
  }
  const Vec3d helper = std::abs(axis.x) < 0.5 ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0};
  const Vec3d x = Normalize(Cross(axis, helper)), y = Cross(axis, x);
  const double angle = degrees * (kPi / 180);
  std::vector<Vec3d> edge;
  for (int i = 0; i < kEdgeRays; ++i) {
    const double turn = 2 * kPi * i / kEdgeRays;
    edge.push_back(axis * std::cos(angle) +
                   (x * std::cos(turn) + y * std::sin(turn)) * std::sin(angle));
  }
  LightCone cone = ConeAround(light, axis, edge);
  cone.versine = std::min(cone.versine * kEdgeMargin, 2.0);
  return cone;
}

}  // namespace lanelight
