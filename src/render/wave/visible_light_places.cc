#include "src/render/wave/visible_lights.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "src/base/core/vec.h"
#include "src/scene/compiled/lights.h"
#include "src/scene/compiled/scene.h"
#include "src/scene/geometry/geometry.h"
#include "src/scene/prepare/prepared_scene.h"
#include "src/vocabulary/path/scene_kinds.h"

namespace lanelight {
namespace {

struct Ball {
  Vec3d center;
  double radius = 0;
};

// Around an emitting shape; nothing for lights without one.
std::optional<Ball> BallOf(const Geometry& g, const LightRecord& light) {
  switch (static_cast<LightShape>(light.shape)) {
    case LightShape::kTriangle: {
      const TriangleRecord& t = g.triangles[light.primitive];
      const Vec3d a = ToVec(t.p[0]), b = ToVec(t.p[1]), c = ToVec(t.p[2]);
      const Vec3d center = (1.0 / 3) * (a + b + c);
      return Ball{center,
                  std::max({Length(a - center), Length(b - center), Length(c - center)})};
    }
    case LightShape::kRectangle: {
      const double x = light.size[0], y = light.size[1];
      const Vec3d across = x * ToVec(light.direction) + y * ToVec(light.side);
      return Ball{ToVec(light.position) + 0.5 * across, 0.5 * std::hypot(x, y)};
    }
    case LightShape::kSphere: {
      const SphereRecord& s = g.spheres[light.primitive - g.ranges.spheres];
      return Ball{ToVec(s.center), s.radius};
    }
    case LightShape::kDisk: {
      const DiskRecord& d = g.disks[light.primitive - g.ranges.disks];
      return Ball{ToVec(d.center), d.radius};
    }
    default:
      return std::nullopt;
  }
}

// A ball's picture: a disk on the film, in pixels.
struct Picture {
  double x = 0, y = 0, radius = 0;
};

// Projects from the scene to the film: the inverse of kernels/generate/camera-inl.h.
class Projector {
 public:
  explicit Projector(const CompiledCamera& camera)
      : camera_(camera),
        right_(VecCast<double>(camera.right)),
        up_(VecCast<double>(camera.up)),
        forward_(VecCast<double>(camera.forward)) {}

  std::optional<Picture> Project(const Ball& ball) const {
    if (!HasPlane()) return std::nullopt;
    const bool perspective = camera_.kind == CameraKind::kPerspective;
    Vec3d p = Local(ball.center - VecCast<double>(camera_.origin));
    // Shapes at the camera have no picture of finite size.
    if (perspective && !(p.z > 2 * ball.radius)) return std::nullopt;
    const double depth = p.z, shrink = perspective ? 1 / depth : 1;
    const double lens = camera_.lens_radius;
    const double blur = lens * std::abs(1 - depth / camera_.focal_distance);
    p = shrink * p - VecCast<double>(camera_.base);
    // In the plane of the film: p = x dx + y dy.
    const Vec3d dx = VecCast<double>(camera_.dx), dy = VecCast<double>(camera_.dy);
    const double area = dx.x * dy.y - dx.y * dy.x;
    const double pixel = std::min(Length(dx), Length(dy));
    if (area == 0 || !(pixel > 0)) return std::nullopt;
    return Picture{(p.x * dy.y - p.y * dy.x) / area, (dx.x * p.y - dx.y * p.x) / area,
                   (ball.radius + blur) * shrink / pixel};
  }

 private:
  // Returns whether pixels are those of a plane. Others find small lights by chance.
  bool HasPlane() const {
    return camera_.kind == CameraKind::kPerspective ||
           camera_.kind == CameraKind::kOrthographic;
  }
  Vec3d Local(Vec3d v) const {
    const double volume = Dot(right_, Cross(up_, forward_));
    return {Dot(v, Cross(up_, forward_)) / volume,
            Dot(v, Cross(forward_, right_)) / volume,
            Dot(v, Cross(right_, up_)) / volume};
  }

  const CompiledCamera& camera_;
  Vec3d right_, up_, forward_;
};

}  // namespace

std::vector<std::uint32_t> PlacesOfSmallLights(const PreparedScene& scene) {
  const Projector projector(scene.view->camera);
  const int width = scene.view->film.width, height = scene.view->film.height;
  std::vector<std::uint32_t> places;
  for (const LightRecord& light : scene.compiled->lights.lights) {
    const std::optional<Ball> ball = BallOf(scene.compiled->geometry, light);
    if (!ball) continue;
    const std::optional<Picture> at = projector.Project(*ball);
    if (!at || !(at->radius < kSmallLight) || !std::isfinite(at->x + at->y)) continue;
    const double reach_x = at->radius + double(scene.compiled->filter.x_radius) - 0.5;
    const double reach_y = at->radius + double(scene.compiled->filter.y_radius) - 0.5;
    const auto clamp = [](double v, int maximum) {
      return int(std::clamp(std::floor(v), -1.0, double(maximum)));
    };
    const int x0 = std::max(0, clamp(at->x - reach_x, width));
    const int x1 = std::min(width - 1, clamp(at->x + reach_x, width));
    const int y0 = std::max(0, clamp(at->y - reach_y, height));
    const int y1 = std::min(height - 1, clamp(at->y + reach_y, height));
    for (int y = y0; y <= y1; ++y) {
      for (int x = x0; x <= x1; ++x) {
        places.push_back(std::uint32_t(y) * std::uint32_t(width) + std::uint32_t(x));
      }
    }
  }
  std::ranges::sort(places);
  places.erase(std::unique(places.begin(), places.end()), places.end());
  return places;
}

}  // namespace lanelight
