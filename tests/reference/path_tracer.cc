#include "tests/reference/path_tracer.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "src/base/core/check.h"
#include "src/base/core/parallel.h"
#include "tests/reference/camera.h"
#include "tests/reference/frame.h"
#include "tests/reference/material.h"
#include "tests/reference/media.h"
#include "tests/reference/bump_maps.h"
#include "tests/reference/snapshot.h"

namespace lanelight {
namespace reference {
namespace {

struct Tracer {
  const SceneDescription& scene;
  const Geometry& geometry;
  const Lights& lights;
  const TwinOptions& options;
  Random& random;

  bool samples_lights() const {
    return options.estimator == ReferenceEstimator::kLightSampling;
  }
  Rgb Unoccluded(Ray shadow, double reach, Index medium) const;
  Rgb Connect(const LightConnection& light, const Ray& shadow, Rgb scattered,
              Index medium) const;
  /// The light that arrives at `p` by connections, weighed by scattered(toward); `medium`
  /// in direction `toward`, by medium(toward).
  template <typename Scattered, typename SignificantLogGain>
  Rgb Direct(Vec3d p, int primitive, const Scattered& scattered,
             const SignificantLogGain& medium) const;
  Rgb Trace(Ray ray) const;
};

// Returns the transmittance of surfaces and media over the first `reach` of a ray.
Rgb Tracer::Unoccluded(Ray shadow, double reach, Index medium) const {
  Rgb left = {1, 1, 1};
  for (;;) {
    const Hit hit = geometry.Intersect(shadow, reach, random);
    const double length = hit.primitive == kNone ? reach : hit.t;
    left = left * MediumTransmittance(scene, medium, shadow, length, random);
    if (hit.primitive == kNone) return left;
    const Primitive& met = geometry.primitives()[hit.primitive];
    if (scene.materials[met.material].kind != MaterialKind::kInterface) return {};
    const SurfacePoint at = geometry.Describe(shadow, hit);
    medium = MediumBehind(met, at.ng, shadow.d, medium);
    shadow = {at.p, shadow.d, hit.primitive};
    reach -= hit.t;
  }
}

Rgb Tracer::Connect(const LightConnection& light, const Ray& shadow, Rgb scattered,
                    Index medium) const {
  if (light.radiance == Rgb{} || scattered == Rgb{}) return {};
  // The point on an emitting surface must not hide itself.
  const double reach = light.distance * (1 - 1e-9);
  return scattered * light.radiance * Unoccluded(shadow, reach, medium);
}

template <typename Scattered, typename SignificantLogGain>
Rgb Tracer::Direct(Vec3d p, int primitive, const Scattered& scattered,
                   const SignificantLogGain& medium) const {
  Rgb sum;
  const auto add = [&](const LightConnection& light) {
    const Ray shadow = {p, light.toward, primitive};
    sum += Connect(light, shadow, scattered(light.toward), medium(light.toward));
  };
  for (const LightConnection& light : lights.DeltaLights(p)) add(light);
  const auto sampled =
      samples_lights() ? lights.AreaLights(p, random) : lights.UnseenLights(p, random);
  for (const LightConnection& light : sampled) add(light);
  return sum;
}

Rgb Tracer::Trace(Ray ray) const {
  const int max_depth = options.max_depth.value_or(scene.integrator.max_depth);
  Rgb beta = {1, 1, 1}, sum;
  bool counts_emission = true, regular = false;
  Index medium = scene.camera.medium;
  // A path through media is one of a single channel.
  const int channel = scene.media.empty() ? 0 : static_cast<int>(3 * random.Uniform());
  if (!scene.media.empty()) beta = OnlyChannel(channel);
  for (int depth = 0;;) {
    const Hit hit = geometry.Intersect(ray, kInfinity, random);
    const Collision collision = NextCollision(scene, medium, ray, hit.t, channel, random);
    if (collision.t < hit.t) {
      const Medium& m = scene.media[medium];
      const double absorbed = Channel(collision.at.sigma_a, channel);
      const double scattered = Channel(collision.at.sigma_s, channel);
      // Every collision, of either kind, sees what the medium emits.
      sum += beta * collision.at.emission * (absorbed / (absorbed + scattered));
      beta *= scattered / (absorbed + scattered);
      // Inside of a material no event counts.
      if ((!m.in_material && depth++ == max_depth) || scattered == 0) return sum;
      const Vec3d p = ray.o + ray.d * collision.t;
      const auto phase = [&](Vec3d toward) {
        return Rgb{1, 1, 1} * PhaseFunction(m.g, Dot(ray.d, toward));
      };
      sum += beta * Direct(p, kNone, phase, [&](Vec3d) { return medium; });
      counts_emission = !samples_lights();
      regular = scene.integrator.regularize;
      ray = {p, SamplePhaseFunction(m.g, ray.d, random), kNone};
      continue;
    }
    if (hit.primitive == kNone) {
      if (counts_emission) sum += beta * lights.Environment(ray.o, ray.d);
      return sum;
    }
    const SurfacePoint at = geometry.Describe(ray, hit);
    if (counts_emission) sum += beta * lights.Emitted(hit.primitive, at, -ray.d);
    const Primitive& met = geometry.primitives()[hit.primitive];
    const Index index = met.material;
    if (scene.materials[index].kind == MaterialKind::kInterface) {
      medium = MediumBehind(met, at.ng, ray.d, medium);
      ray = {at.p, ray.d, hit.primitive};
      continue;
    }
    const bool inside = medium != kNone && scene.media[medium].in_material;
    if (!inside && depth++ == max_depth) return sum;
    LocalMaterial material = EvaluateMaterial(scene, index, at, options.texture, random);
    if (regular) Regularize(material);
    const SurfacePoint shaded = WithBumpMaps(scene, *material.source, at, -ray.d,
                                             options.texture, options.normal_map);
    const TangentFrame frame = MakeFrame(shaded.ns, shaded.dpdu);
    const Vec3d wo = frame.ToLocal(-ray.d);
    if (scene.integrator.force_diffuse) material = MadeDiffuse(material, wo, random);
    const auto reflected = [&](Vec3d toward) {
      return EvaluateCos(material, wo, frame.ToLocal(toward), random);
    };
    const auto beyond = [&](Vec3d d) { return MediumBehind(met, at.ng, d, medium); };
    sum += beta * Direct(at.p, hit.primitive, reflected, beyond);
    const auto next = SampleBsdf(material, wo, random);
    if (!next || next->weight == Rgb{}) return sum;
    beta = beta * next->weight;
    counts_emission = next->specular || !samples_lights();
    regular |= scene.integrator.regularize && !next->specular;
    ray = {at.p, Normalize(frame.ToWorld(next->wi)), hit.primitive};
    medium = beyond(ray.d);
  }
}

}  // namespace
}  // namespace reference

Rgb ReferenceRadiance(const SceneDescription& scene, const reference::Geometry& geometry,
                      const reference::Lights& lights, reference::Ray ray,
                      const TwinOptions& options, reference::Random& random) {
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
  const double maximum = std::max({x, y, z});
  if (maximum > film.response.max_component)
    v = v * (film.response.max_component / maximum);
  const Vec3d* m = film.response.matrix.row;
  return {m[0].x * v.x + m[0].y * v.y + m[0].z * v.z,
          m[1].x * v.x + m[1].y * v.y + m[1].z * v.z,
          m[2].x * v.x + m[2].y * v.y + m[2].z * v.z};
}

// The scene at one time.
struct Still {
  SceneDescription scene;
  reference::Geometry geometry;
  reference::Lights lights;
  reference::CameraRays camera;

  Still(SceneDescription at, const TwinOptions& options)
      : scene(std::move(at)),
        geometry(scene, options.texture),
        lights(scene, geometry, options.environment),
        camera(scene.camera, scene.film) {}
};

// Of a scene that moves so many, at times in equal parts of what the shutter is open for.
constexpr int kStills = 512;

std::vector<std::unique_ptr<const Still>> StillsOf(const SceneDescription& scene,
                                                   const TwinOptions& options) {
  bool moves = scene.camera.end != nullptr;
  for (const Instance& instance : scene.instances) moves |= instance.end != nullptr;
  std::vector<std::unique_ptr<const Still>> stills;
  reference::Random random(options.seed, ~std::uint64_t{0});
  for (int i = 0; i < (moves ? kStills : 1); ++i) {
    const double u = moves ? (i + random.Uniform()) / kStills : 0;
    const double time = scene.camera.time_first + u * scene.camera.time_rate;
    stills.push_back(std::make_unique<const Still>(
        reference::Snapshot(scene, std::clamp(time, 0.0, 1.0)), options));
  }
  return stills;
}

}  // namespace

ReferenceImage RenderReference(const SceneDescription& scene,
                               const TwinOptions& options) {
  LL_CHECK_GE(options.samples, 2);
  const Film& film = scene.film;
  int crop[4] = {0, film.width, 0, film.height};
  if (film.crop[1] > film.crop[0]) std::copy(film.crop, film.crop + 4, crop);
  const auto stills = StillsOf(scene, options);
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
      const std::size_t when =
          stills.size() == 1 ? 0 : static_cast<std::size_t>(random.Uniform() * kStills);
      const Still& still = *stills[when];
      const reference::CameraSample from = still.camera.Sample(fx, fy, random);
      Rgb value;
      if (from.weight > 0) {
        value = OnFilm(film, from.weight * ReferenceRadiance(still.scene, still.geometry,
                                                             still.lights, from.ray,
                                                             options, random));
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
