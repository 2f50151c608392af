#include "src/scene/compile/camera.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "src/base/core/check.h"
#include "src/base/core/error.h"
#include "src/scene/compile/focus.h"
#include "src/scene/compile/world_frame.h"

namespace lanelight {
namespace {

struct Window {
  double x0, x1, y0, y1;
};

// As in pbrt, the shorter axis of the screen spans [-1, 1].
Window ScreenWindow(const Camera& camera, const Film& film) {
  const double* w = camera.screen_window;
  if (w[0] != 0 || w[1] != 0 || w[2] != 0 || w[3] != 0) return {w[0], w[1], w[2], w[3]};
  const double aspect = camera.frame_aspect > 0
                            ? camera.frame_aspect
                            : static_cast<double>(film.width) / film.height;
  if (aspect > 1) return {-aspect, aspect, -1, 1};
  return {-1, 1, -1 / aspect, 1 / aspect};
}

void Check(const Camera& camera, const Window& window) {
  const Transform& t = camera.world_from_camera;
  if (!t.IsInvertible() || t(3, 0) != 0 || t(3, 1) != 0 || t(3, 2) != 0 || t(3, 3) != 1) {
    throw InputError(camera.where,
                     "the camera's transform is singular or projective; only invertible "
                     "affine transforms are supported");
  }
  if (camera.kind == CameraKind::kPerspective && !(camera.fov > 0 && camera.fov < 180)) {
    throw InputError(camera.where,
                     fmt::format("field of view {} degrees; supported are values between "
                                 "0 and 180",
                                 camera.fov));
  }
  if (!(window.x0 != window.x1 && window.y0 != window.y1)) {
    throw InputError(camera.where,
                     fmt::format("empty screen window [{} {} {} {}]", window.x0,
                                 window.x1, window.y0, window.y1));
  }
}

// `extent` is in units of the scene's size.
void CheckExtent(const Camera& camera, double extent) {
  if (extent <= kFarthestInScene) return;
  throw InputError(camera.where,
                   fmt::format("the camera's screen or lens is {:.2g} times as large as "
                               "the scene; up to {:.2g} is supported",
                               extent, kFarthestInScene));
}

void SetMotion(const Camera& camera, const WorldFrame& frame, CompiledCamera& out) {
  if (camera.end == nullptr) return;
  RequireInScene(frame.After(*camera.end).Point({0, 0, 0}), camera.where, "camera");
  out.moves = true;
  out.motion = RecordOf(OfCamera({camera.world_from_camera, *camera.end}, frame));
}

}  // namespace

CompiledCamera CompileCamera(const Camera& camera, const Film& film,
                             const WorldFrame& frame) {
  LL_CHECK(film.width > 0 && film.height > 0);
  const Window window = ScreenWindow(camera, film);
  Check(camera, window);

  // Camera axes in the scene, measured in units of `unit` scene lengths per camera
  // length, so that a camera under a uniform scale has unit axes. Mirrored cameras keep
  // mirrored axes (pbrt scenes use Scale -1 1 1).
  const Transform t = frame.After(camera.world_from_camera);
  const Vec3d right = t.Vector({1, 0, 0}), up = t.Vector({0, 1, 0});
  const Vec3d forward = t.Vector({0, 0, 1});
  const double unit = Length(forward);
  if (!(unit > 0) || !std::isfinite(unit)) {
    throw InputError(camera.where,
                     "the camera's transform scales by a number that is "
                     "too small or too large for double precision");
  }

  CompiledCamera out;
  out.kind = camera.kind;
  out.time_first = static_cast<float>(camera.time_first);
  out.time_rate = static_cast<float>(camera.time_rate);
  out.right = ToFloat(right / unit);
  out.up = ToFloat(up / unit);
  out.forward = ToFloat(forward / unit);
  RequireInScene(t.Point({0, 0, 0}), camera.where, "camera");
  out.origin = ToFloat(t.Point({0, 0, 0}));
  SetMotion(camera, frame, out);
  CheckExtent(camera, camera.lens_radius * unit);
  out.lens_radius = static_cast<float>(camera.lens_radius * unit);
  // At this distance all rays of a pixel are parallel.
  out.focal_distance =
      static_cast<float>(std::min(camera.focal_distance * unit, kFarthestInScene));

  if (camera.kind == CameraKind::kSpherical) {
    out.mapping = camera.mapping;
    out.dx = ToFloat({1.0 / film.width, 0, 0});
    out.dy = ToFloat({0, 1.0 / film.height, 0});
    return out;
  }
  if (camera.kind == CameraKind::kRealistic) {
    // The lenses invert the image.
    const double aspect = static_cast<double>(film.height) / film.width;
    const double x = camera.film_diagonal / std::hypot(1, aspect), y = aspect * x;
    out.base = ToFloat({x / 2, -y / 2, 0});
    out.dx = ToFloat({-x / film.width, 0, 0});
    out.dy = ToFloat({0, y / film.height, 0});
    out.lenses = CompileLenses(camera, unit);
    return out;
  }
  // Perspective: the film lies at z = 1. Orthographic: screen units are camera lengths.
  const bool perspective = camera.kind == CameraKind::kPerspective;
  const double k = perspective ? std::tan(camera.fov * (std::numbers::pi / 360)) : unit;
  CheckExtent(camera, std::abs(k) * std::max({std::abs(window.x0), std::abs(window.x1),
                                              std::abs(window.y0), std::abs(window.y1)}));
  out.base = ToFloat({window.x0 * k, window.y1 * k, perspective ? 1.0 : 0.0});
  out.dx = ToFloat({(window.x1 - window.x0) / film.width * k, 0, 0});
  out.dy = ToFloat({0, (window.y0 - window.y1) / film.height * k, 0});
  return out;
}

}  // namespace lanelight
