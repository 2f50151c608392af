#include "src/scene/compile/lights.h"

#include <algorithm>
#include <cmath>

#include "src/base/core/error.h"
#include "src/base/core/pi.h"
#include "src/scene/compile/world_frame.h"

namespace lanelight {

namespace {

// Beyond this ratio of axes the edge of a stretched cone is not searched for its widest
// place: the cone is then all directions.
constexpr double kMaxSearchedRatio = 100;
constexpr int kEdgeRays = 4096;
// Relative margin for directions between the edge rays.
constexpr double kEdgeMargin = 1.01;

// 1 - cos of the angle between unit vectors.
double Versine(Vec3d a, Vec3d b) { return Dot(a - b, a - b) / 2; }

double RatioOfAxes(const Transform& t) {
  const double a = Length(t.Vector({1, 0, 0})), b = Length(t.Vector({0, 1, 0})),
               c = Length(t.Vector({0, 0, 1}));
  // The volume measures how far the axes are from orthogonal.
  const double volume = std::abs(t.Determinant3());
  return std::pow(std::max({a, b, c}), 3) / volume;
}

// The flux of an intensity image: its weighted mean over a domain of some size.
struct ImageFlux {
  Rgb mean;
  double size;
};

// Adds the light whose power is that of its image times its intensity, scaled to the
// power that is asked for.
void AddWithPower(const Light& light, const WorldFrame& frame, const ImageFlux& flux,
                  LightRecord& record, LightList& lights) {
  const auto& [mean, size] = flux;
  const double unit_power = size * Luminance(mean);
  Rgb intensity = light.emission;
  if (light.power > 0) intensity *= light.power / unit_power;
  intensity *= frame.scale * frame.scale;
  Store(intensity, record.radiance);
  Store(PositionOf(light, frame), record.position);
  lights.Push(record, Luminance(intensity * mean) * size, light);
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

void AddGoniometric(const Light& light, const WorldFrame& frame, LightImageTable& images,
                    LightList& lights) {
  const LightFile file = {light.where, "goniometric light's image", light.image_path};
  LightImage image = images.Load(file, LightImageTable::Use::kGrey);
  RequireSquareMap(file, image.width, image.height);
  const Rgb mean = images.Mean(image);
  if (!(Luminance(mean) > 0)) return;
  StoreAxes(light, {{1, 0, 0}, {0, 0, 1}, {0, 1, 0}}, image);
  LightRecord record = EmptyRecord(LightShape::kGoniometric);
  record.image = images.Add(image);
  lights.table.has_goniometric = true;
  AddWithPower(light, frame, {mean, 4 * kPi}, record, lights);
}

void AddProjection(const Light& light, const WorldFrame& frame, LightImageTable& images,
                   LightList& lights) {
  const LightFile file = {light.where, "projection light's image", light.image_path};
  LightImage image = images.Load(file, LightImageTable::Use::kColor);
  // Half the sides of the picture at distance 1; the shorter one spans the field of view.
  const double aspect = static_cast<double>(image.width) / image.height;
  const double opposite = std::tan(light.fov * (kPi / 360));
  const double half_x = opposite * std::max(aspect, 1.0);
  const double half_y = opposite * std::max(1 / aspect, 1.0);
  // A pixel of the picture fills the solid angle cos^3 dA.
  const Rgb mean = images.Mean(image, [&](int column, int row) {
    const double x = half_x * ((2 * column + 1.0) / image.width - 1);
    const double y = half_y * ((2 * row + 1.0) / image.height - 1);
    return std::pow(1 + x * x + y * y, -1.5);
  });
  if (!(Luminance(mean) > 0)) return;
  StoreAxes(light, {{1 / half_x, 0, 0}, {0, -1 / half_y, 0}, {0, 0, 1}}, image);
  LightRecord record = EmptyRecord(LightShape::kProjection);
  record.image = images.Add(image);
  const LightCone cone = ConeAround(light, {0, 0, 1},
                                    {{half_x, half_y, 1},
                                     {half_x, -half_y, 1},
                                     {-half_x, half_y, 1},
                                     {-half_x, -half_y, 1}});
  Store(cone.axis, record.direction);
  record.size[0] = static_cast<float>(cone.versine);
  lights.table.has_projection = true;
  AddWithPower(light, frame, {mean, 4 * half_x * half_y}, record, lights);
}

}  // namespace lanelight
