#include "src/scene/compile/footprint.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "src/scene/compile/world_frame.h"

namespace lanelight {
namespace {

Vec3d ToDouble(Vec3f v) { return VecCast<double>(v); }

// A camera-space vector in the scene.
Vec3d InScene(const CompiledCamera& camera, Vec3f v) {
  return ToDouble(camera.right) * v.x + ToDouble(camera.up) * v.y +
         ToDouble(camera.forward) * v.z;
}

Vec3d UnitOr(Vec3d v, Vec3d otherwise) {
  return Length(v) > 0 ? Normalize(v) : otherwise;
}

// The part of v across the unit vector n.
Vec3d Across(Vec3d v, Vec3d n) { return v - n * Dot(v, n); }

// Smallest angle between the directions of neighbouring pixels, least cosine of a
// direction to the middle, over a grid on the film.
void MeasureDirections(const CompiledCamera& camera, const Film& film,
                       PixelFootprint* out) {
  constexpr int kGrid = 16;
  const auto direction = [&](double x, double y) {
    return Normalize(InScene(camera, camera.base) + InScene(camera, camera.dx) * x +
                     InScene(camera, camera.dy) * y);
  };
  double least_x = 4, least_y = 4, cosine = 1;
  for (int i = 0; i <= kGrid * kGrid + 2 * kGrid; ++i) {
    const double x = film.width * (i % (kGrid + 1)) / double{kGrid};
    const double y = film.height * (i / (kGrid + 1)) / double{kGrid};
    const Vec3d d = direction(x, y);
    least_x = std::min(least_x, Length(direction(x + 1, y) - d));
    least_y = std::min(least_y, Length(direction(x, y + 1) - d));
    cosine = std::min(cosine, Dot(d, ToDouble(out->forward)));
  }
  out->angle_x = static_cast<float>(least_x);
  out->angle_y = static_cast<float>(least_y);
  // Pixel filters reach beyond the film.
  out->min_cosine = static_cast<float>(std::max(0.01, 0.9 * cosine));
}

void SetAngles(const Camera& camera, const Film& film, PixelFootprint* out) {
  constexpr double kPi = std::numbers::pi;
  if (camera.mapping == SphericalMapping::kEqualArea) {
    // Every pixel has the same solid angle.
    const double pixels = static_cast<double>(film.width) * film.height;
    out->angle_x = out->angle_y = static_cast<float>(std::sqrt(4 * kPi / pixels));
    return;
  }
  out->angle_x = static_cast<float>(2 * kPi / film.width);
  out->angle_y = static_cast<float>(kPi / film.height);
}

}  // namespace

PixelFootprint CompileFootprint(const CompiledCamera& compiled, const Camera& camera,
                                const Film& film, int samples) {
  PixelFootprint out;
  const Vec3d forward = Normalize(ToDouble(compiled.forward));
  out.eye = compiled.origin;
  out.forward = ToFloat(forward);
  const Vec3d right = UnitOr(Across(ToDouble(compiled.right), forward), {1, 0, 0});
  out.axis_x = ToFloat(right);
  out.axis_y = ToFloat(Cross(forward, right));
  out.parallel = camera.kind == CameraKind::kOrthographic;
  if (camera.kind == CameraKind::kSpherical) {
    SetAngles(camera, film, &out);
  } else {
    MeasureDirections(compiled, film, &out);
  }
  const double scale = std::max(0.125, 1 / std::sqrt(std::max(samples, 1)));
  out.scale = static_cast<float>(scale);
  out.step_x = ToFloat(InScene(compiled, compiled.dx) * scale);
  out.step_y = ToFloat(InScene(compiled, compiled.dy) * scale);
  out.angle_x *= static_cast<float>(scale);
  out.angle_y *= static_cast<float>(scale);
  return out;
}

}  // namespace lanelight
