#include "src/scene/compile/lights.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "src/base/core/error.h"
#include "src/base/core/pi.h"
#include "src/base/image/octahedral.h"
#include "src/scene/compile/environment.h"

namespace lanelight {
namespace {

// Largest error of the cosines of a rectangle's angles, as in pbrt.
constexpr double kRectangular = 1e-3;

// Texel of an octahedral map, also of those just beyond an edge, across which the same
// edge follows, mirrored about its middle.
Rgb MapTexel(const Environment& e, int x, int y) {
  const int last = e.size - 1;
  if (x < 0 || x > last) y = last - y, x = std::clamp(x, 0, last);
  if (y < 0 || y > last) x = last - x, y = std::clamp(y, 0, last);
  const float* rgb = &e.rgb[3 * (static_cast<std::size_t>(y) * std::size_t(e.size) +
                                 static_cast<std::size_t>(x))];
  return {rgb[0], rgb[1], rgb[2]};
}

Rgb MapRadiance(const Environment& e, Vec3d scene) {
  const float* m = e.light_from_scene;
  const Vec3d local = {Dot({m[0], m[1], m[2]}, scene), Dot({m[3], m[4], m[5]}, scene),
                       Dot({m[6], m[7], m[8]}, scene)};
  const auto [s, t] = DirectionToOctahedral(Normalize(local));
  const double x = s * e.size - 0.5, y = t * e.size - 0.5;
  const int i = static_cast<int>(std::floor(x)), j = static_cast<int>(std::floor(y));
  const double right = x - i, below = y - j;
  const Rgb top = (1 - right) * MapTexel(e, i, j) + right * MapTexel(e, i + 1, j);
  const Rgb bottom =
      (1 - right) * MapTexel(e, i, j + 1) + right * MapTexel(e, i + 1, j + 1);
  return (1 - below) * top + below * bottom;
}

struct Side {
  Vec3d x, y;  // unit
};

Side SidesOf(const Light& light) {
  const std::vector<Vec3d>& p = light.portal;
  const Vec3d x = Normalize(p[3] - p[0]), y = Normalize(p[1] - p[0]);
  const double off =
      std::max({std::abs(Dot(y, Normalize(p[2] - p[3])) - 1),
                std::abs(Dot(x, Normalize(p[2] - p[1])) - 1), std::abs(Dot(x, y))});
  if (!(off <= kRectangular)) {
    throw InputError(light.where,
                     "the corners of the portal are not those of a rectangle, in order "
                     "around it");
  }
  return {x, y};
}

// A direction of the square of (s, t), along the portal's axes, and its solid angle per
// area of the square.
struct Direction {
  Vec3d local;
  double solid_angle;
};
Direction DirectionOf(double s, double t) {
  const double a = kPi * (s - 0.5), b = kPi * (t - 0.5);
  const Vec3d w = Normalize(Vec3d{std::sin(a) * std::cos(b), std::cos(a) * std::sin(b),
                                  std::cos(a) * std::cos(b)});
  return {w, kPi * kPi * (1 - w.x * w.x) * (1 - w.y * w.y) / w.z};
}

Environment MapOf(const Light& light, std::vector<Note>& notes) {
  if (!light.image_path.empty()) return CompileEnvironment(light, &notes);
  Image pixel = MakeImage(1, 1, {"R", "G", "B"});
  for (int c = 0; c < 3; ++c) pixel.At(0, 0, c) = static_cast<float>(light.emission[c]);
  Light constant = light;
  constant.world_from_light = Transform();
  return CompileEnvironment(constant, pixel);
}

// Returns the flux through a portal of area 1.
double Flux(const Portal& portal) {
  double sum = 0;
  const auto n = static_cast<std::size_t>(portal.size);
  for (std::size_t i = 0; i < n * n; ++i) {
    const Direction at =
        DirectionOf((double(i % n) + 0.5) / double(n), (double(i / n) + 0.5) / double(n));
    const float* rgb = &portal.rgb[3 * i];
    sum += Luminance({rgb[0], rgb[1], rgb[2]}) * at.local.z * at.solid_angle;
  }
  return sum / double(n * n);
}

}  // namespace

Portal CompilePortal(const Light& light, const WorldFrame& frame,
                     const Environment& environment) {
  const Side side = SidesOf(light);
  const Vec3d z = Cross(side.x, side.y);
  Portal portal;
  portal.size = environment.size;
  Store(side.x, portal.x_axis);
  Store(side.y, portal.y_axis);
  Store(z, portal.z_axis);
  Store(frame.Point(light.portal[0]), portal.low);
  Store(frame.Point(light.portal[2]), portal.high);
  const auto n = static_cast<std::size_t>(portal.size);
  portal.rgb.resize(3 * n * n);
  portal.sums.assign((n + 1) * (n + 1), 0.0);
  for (std::size_t y = 0; y < n; ++y) {
    double row = 0;
    for (std::size_t x = 0; x < n; ++x) {
      const Direction at =
          DirectionOf((double(x) + 0.5) / double(n), (double(y) + 0.5) / double(n));
      const Vec3d w = side.x * at.local.x + side.y * at.local.y + z * at.local.z;
      const Rgb radiance = MapRadiance(environment, w);
      Store(radiance, &portal.rgb[3 * (y * n + x)]);
      row += Luminance(radiance) * at.solid_angle;
      portal.sums[(y + 1) * (n + 1) + x + 1] = portal.sums[y * (n + 1) + x + 1] + row;
    }
  }
  return portal;
}

void AddPortalLight(const Light& light, const WorldFrame& frame, std::vector<Note>& notes,
                    LightList& lights) {
  for (const Vec3d& corner : light.portal) {
    RequireInScene(frame.Point(corner), light.where, "portal");
  }
  Portal portal = CompilePortal(light, frame, MapOf(light, notes));
  const double area = Length(light.portal[3] - light.portal[0]) *
                      Length(light.portal[1] - light.portal[0]) * frame.scale *
                      frame.scale;
  const double power = area * Flux(portal);
  if (!(power > 0)) return;
  LightRecord record = EmptyRecord(LightShape::kPortal);
  Store({1, 1, 1}, record.radiance);
  record.image = static_cast<std::uint32_t>(lights.table.portals.size());
  lights.table.portals.push_back(std::move(portal));
  lights.table.infinite.push_back(
      static_cast<std::uint32_t>(lights.Push(record, power, light)));
}

}  // namespace lanelight
