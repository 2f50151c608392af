#include "src/scene/compile/camera.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "src/scene/compile/world_frame.h"

namespace lanelight {

namespace {

Vec3d ToDouble(Vec3f v) { return VecCast<double>(v); }

// Transforms a vector from camera to scene space.
Vec3d InScene(const CompiledCamera& camera, Vec3f v) {
  return ToDouble(camera.right) * v.x + ToDouble(camera.up) * v.y +
         ToDouble(camera.forward) * v.z;
}

Vec3d UnitOr(Vec3d v, Vec3d otherwise) {
  return Length(v) > 0 ? Normalize(v) : otherwise;
}

// Returns the part of v perpendicular to the unit vector n.
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
  double min_x = 4, min_y = 4, cosine = 1;
  for (int i = 0; i <= kGrid * kGrid + 2 * kGrid; ++i) {
    const double x = film.width * (i % (kGrid + 1)) / double{kGrid};
    const double y = film.height * (i / (kGrid + 1)) / double{kGrid};
    const Vec3d d = direction(x, y);
    min_x = std::min(min_x, Length(direction(x + 1, y) - d));
    min_y = std::min(min_y, Length(direction(x, y + 1) - d));
    cosine = std::min(cosine, Dot(d, ToDouble(out->forward)));
  }
  out->angle_x = static_cast<float>(min_x);
  out->angle_y = static_cast<float>(min_y);
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

GbufferSpace CompileGbufferSpace(const Film& film, const Camera& camera,
                                 const WorldFrame& frame) {
  if (film.gbuffer == Gbuffer::kNone) return {};
  const bool in_camera = film.gbuffer == Gbuffer::kCamera;
  // Subtracting first keeps the digits of nearby points.
  const Transform scene_from_space =
      in_camera ? frame.After(camera.world_from_camera) : frame.After(Transform());
  const Transform space_from_scene = scene_from_space.Inverse();
  const Vec3d columns[3] = {space_from_scene.Vector({1, 0, 0}),
                            space_from_scene.Vector({0, 1, 0}),
                            space_from_scene.Vector({0, 0, 1})};
  const Vec3d from = in_camera ? scene_from_space.Point({0, 0, 0}) : Vec3d{0, 0, 0};
  GbufferSpace space;
  space.of_camera = in_camera;
  space.from = ToFloat(from);
  space.to = ToFloat(in_camera ? Vec3d{0, 0, 0} : frame.center);
  space.x = ToFloat({columns[0].x, columns[1].x, columns[2].x});
  space.y = ToFloat({columns[0].y, columns[1].y, columns[2].y});
  space.z = ToFloat({columns[0].z, columns[1].z, columns[2].z});
  // Normals transform by the inverse transpose; their length does not matter.
  const double unit = Length(scene_from_space.Vector({0, 0, 1}));
  space.normal_x = ToFloat(scene_from_space.Vector({1, 0, 0}) / unit);
  space.normal_y = ToFloat(scene_from_space.Vector({0, 1, 0}) / unit);
  space.normal_z = ToFloat(scene_from_space.Vector({0, 0, 1}) / unit);
  return space;
}

}  // namespace lanelight
