#include "src/measure/live/view.h"

#include <algorithm>
#include <cmath>

#include "src/render/job/loaded_scene.h"
#include "src/scene/compile/camera.h"
#include "src/scene/description/film.h"

namespace lanelight::live {
namespace {

// Returns the distance from the camera to the middle of the scene, around which the mouse
// rotates the camera.
double DistanceToMiddle(const Job& job) {
  const CompiledScene& scene = *job.scene.compiled;
  const Transform& t = job.loaded->description.camera.world_from_camera;
  const Vec3d low = VecCast<double>(scene.geometry.bounds_min);
  const Vec3d high = VecCast<double>(scene.geometry.bounds_max);
  const double size = Length(high - low) / scene.scale;
  const Vec3d middle = (low + high) / (2 * scene.scale) + scene.center;
  const Vec3d forward = Normalize(t.Vector({0, 0, 1}));
  const double along = Dot(middle - t.Point({0, 0, 0}), forward);
  if (!(size > 0) || !std::isfinite(size)) return 1;  // nothing finite is there
  return std::max(along, size / 8);
}

int Reduced(int pixels, int factor) { return (pixels + factor - 1) / factor; }

Film ReducedFilm(const Film& film, int factor) {
  Film out = film;
  out.width = Reduced(film.width, factor);
  out.height = Reduced(film.height, factor);
  const PixelRect window = RenderedPixels(film);
  out.crop[0] = window.x0 / factor;
  out.crop[1] = Reduced(window.x1, factor);
  out.crop[2] = window.y0 / factor;
  out.crop[3] = Reduced(window.y1, factor);
  return out;
}

}  // namespace

LiveScene::LiveScene(const std::string& scene, const RenderSettings& settings)
    : path(scene), job(PrepareJob(scene, settings)) {
  job.plan.options.spectral_film = false;  // pages show colours only
  pose = PoseOf(job.loaded->description.camera, DistanceToMiddle(job));
}

View MakeView(const LiveScene& live_scene, const CameraPose& pose, int factor) {
  const SceneDescription& scene = live_scene.job.loaded->description;
  const CompiledScene& compiled = *live_scene.job.scene.compiled;
  const WorldFrame frame = {compiled.center, compiled.scale};
  View view;
  view.pose = pose;
  view.factor = factor;
  view.described = MovedCamera(scene.camera, live_scene.pose, pose);
  view.film = factor > 1 ? ReducedFilm(scene.film, factor) : scene.film;
  Camera camera = view.described;
  // Rounding the size does not change the view.
  if (factor > 1 && !(camera.frame_aspect > 0)) {
    camera.frame_aspect = double(scene.film.width) / scene.film.height;
  }
  view.window = RenderedPixels(view.film);
  view.camera = CompileCamera(camera, view.film, frame);
  view.footprint = CompileFootprint(view.camera, camera, view.film, scene.sampler.spp);
  view.gbuffer = CompileGbufferSpace(view.film, camera, frame);
  return view;
}

}  // namespace lanelight::live
