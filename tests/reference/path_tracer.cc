#include "tests/reference/path_tracer.h"

#include <algorithm>

#include "src/core/check.h"
#include "src/core/parallel.h"
#include "tests/reference/camera.h"
#include "tests/reference/frame.h"
#include "tests/reference/material.h"
#include "tests/reference/relief.h"

namespace lanelight {
namespace reference {
namespace {

struct Tracer {
  const SceneDescription& scene;
  const Geometry& geometry;
  const Lights& lights;
  const ReferenceOptions& options;
  Random& random;

  bool samples_lights() const {
    return options.estimator == ReferenceEstimator::kLightSampling;
  }
  Rgb Connect(const LightConnection& light, const Ray& shadow,
              const LocalMaterial& material, Vec3d wo, Vec3d wi) const;
  Rgb Direct(const SurfacePoint& at, int primitive, const LocalMaterial& material,
             const Frame& frame, Vec3d wo) const;
  Rgb Trace(Ray ray) const;
};

Rgb Tracer::Connect(const LightConnection& light, const Ray& shadow,
                    const LocalMaterial& material, Vec3d wo, Vec3d wi) const {
  if (light.radiance == Rgb{}) return {};
  const Rgb scattered = EvaluateCos(material, wo, wi, random);
  if (scattered == Rgb{}) return {};
  // The point on an emitting surface must not hide itself.
  const double reach = light.distance * (1 - 1e-9);
  return geometry.Visible(shadow, reach, random) ? scattered * light.radiance : Rgb{};
}

Rgb Tracer::Direct(const SurfacePoint& at, int primitive, const LocalMaterial& material,
                   const Frame& frame, Vec3d wo) const {
  Rgb sum;
  const auto add = [&](const LightConnection& light) {
    const Ray shadow = {at.p, light.toward, primitive};
    sum += Connect(light, shadow, material, wo, frame.ToLocal(light.toward));
  };
  for (const LightConnection& light : lights.DeltaLights(at.p)) add(light);
  if (samples_lights()) {
    for (const LightConnection& light : lights.AreaLights(at.p, random)) add(light);
  }
  return sum;
}

Rgb Tracer::Trace(Ray ray) const {
  const int max_depth = options.max_depth.value_or(scene.integrator.max_depth);
  Rgb beta = {1, 1, 1}, sum;
  bool counts_emission = true;
  for (int depth = 0;;) {
    const Hit hit = geometry.Intersect(ray, kInfinity, random);
    if (hit.primitive == kNone) {
      if (counts_emission) sum += beta * lights.Environment(ray.o, ray.d);
      return sum;
    }
    const SurfacePoint at = geometry.Describe(ray, hit);
    if (counts_emission) sum += beta * lights.Emitted(hit.primitive, at, -ray.d);
    const Index index = geometry.primitives()[hit.primitive].material;
    if (scene.materials[index].kind == MaterialKind::kInterface) {
      ray = {at.p, ray.d, hit.primitive};
      continue;
    }
    if (depth++ == max_depth) return sum;
    const LocalMaterial material =
        EvaluateMaterial(scene, index, at, options.texture, random);
    const SurfacePoint shaded = WithRelief(scene, *material.source, at, -ray.d,
                                           options.texture, options.normal_map);
    const Frame frame = MakeFrame(shaded.ns, shaded.dpdu);
    const Vec3d wo = frame.ToLocal(-ray.d);
    sum += beta * Direct(at, hit.primitive, material, frame, wo);
    const auto next = SampleBsdf(material, wo, random);
    if (!next || next->weight == Rgb{}) return sum;
    beta = beta * next->weight;
    counts_emission = next->specular || !samples_lights();
    ray = {at.p, Normalize(frame.ToWorld(next->wi)), hit.primitive};
  }
}

}  // namespace
}  // namespace reference

Rgb ReferenceRadiance(const SceneDescription& scene, const reference::Geometry& geometry,
                      const reference::Lights& lights, reference::Ray ray,
                      const ReferenceOptions& options, reference::Random& random) {
  return reference::Tracer{scene, geometry, lights, options, random}.Trace(ray);
}

namespace {

// What the film makes of radiance: exposure, the limit on X, Y and Z (of sRGB's primaries
// and white as IEC 61966-2-1 rounds them), then the image's primaries.
Rgb OnFilm(const Film& film, Rgb radiance) {
  Rgb v = film.imaging_ratio * radiance;
  const double x = 0.4124 * v.x + 0.3576 * v.y + 0.1805 * v.z;
  const double y = 0.2126 * v.x + 0.7152 * v.y + 0.0722 * v.z;
  const double z = 0.0193 * v.x + 0.1192 * v.y + 0.9505 * v.z;
  const double most = std::max({x, y, z});
  if (most > film.response.max_component) v = v * (film.response.max_component / most);
  const Vec3d* m = film.response.matrix.row;
  return {m[0].x * v.x + m[0].y * v.y + m[0].z * v.z,
          m[1].x * v.x + m[1].y * v.y + m[1].z * v.z,
          m[2].x * v.x + m[2].y * v.y + m[2].z * v.z};
}

}  // namespace

ReferenceImage RenderReference(const SceneDescription& scene,
                               const ReferenceOptions& options) {
  LL_CHECK_GE(options.samples, 2);
  const Film& film = scene.film;
  int crop[4] = {0, film.width, 0, film.height};
  if (film.crop[1] > film.crop[0]) std::copy(film.crop, film.crop + 4, crop);
  const reference::Geometry geometry(scene, options.texture);
  const reference::Lights lights(scene, geometry, options.environment);
  const reference::CameraRays camera(scene.camera, film);
  ReferenceImage image;
  image.width = crop[1] - crop[0];
  image.height = crop[3] - crop[2];
  image.samples = options.samples;
  image.mean.resize(static_cast<std::size_t>(image.width) * image.height);
  image.variance_of_mean.resize(image.mean.size());
  ParallelFor(image.mean.size(), [&](std::size_t i) {
    const int x = crop[0] + static_cast<int>(i) % image.width;
    const int y = crop[2] + static_cast<int>(i) / image.width;
    reference::Random random(options.seed, i);
    // Welford's running mean and sum of squared deviations.
    Rgb mean, squares;
    for (int s = 1; s <= options.samples; ++s) {
      const double fx =
          x + 0.5 + reference::SampleFilter(scene.filter, scene.filter.x_radius, random);
      const double fy =
          y + 0.5 + reference::SampleFilter(scene.filter, scene.filter.y_radius, random);
      const reference::CameraSample from = camera.Sample(fx, fy, random);
      Rgb value;
      if (from.weight > 0) {
        value = OnFilm(film, from.weight * ReferenceRadiance(scene, geometry, lights,
                                                            from.ray, options, random));
      }
      const Rgb delta = value - mean;
      mean += delta / s;
      squares += delta * (value - mean);
    }
    image.mean[i] = mean;
    image.variance_of_mean[i] =
        squares / (static_cast<double>(options.samples - 1) * options.samples);
  });
  return image;
}

}  // namespace lanelight
