#include "src/render/job/settings.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "src/base/core/error.h"
#include "src/base/image/image.h"
#include "src/render/train/training.h"
#include "src/scene/accel/build.h"
#include "src/scene/compile/compile.h"
#include "src/scene/description/description.h"
#include "src/scene/description/film.h"
#include "src/scene/prepare/prepared_scene.h"

namespace lanelight {
namespace {

// A scene's own crop window, carried over to another resolution.
void ScaleCrop(Film& film, int width, int height) {
  const double sx = double(width) / film.width, sy = double(height) / film.height;
  film.crop[0] = int(std::ceil(film.crop[0] * sx));
  film.crop[1] = int(std::ceil(film.crop[1] * sx));
  film.crop[2] = int(std::ceil(film.crop[2] * sy));
  film.crop[3] = int(std::ceil(film.crop[3] * sy));
}

void CheckSize(const Film& film) {
  if (film.width < 1 || film.height < 1 || film.width > kMaxImageSide ||
      film.height > kMaxImageSide) {
    throw InputError(
        fmt::format("resolution {}x{} is not supported: each side must be 1 to {}",
                    film.width, film.height, kMaxImageSide));
  }
}

void CheckCrop(const Film& film) {
  const PixelRect w = RenderedPixels(film);
  if (w.x0 < 0 || w.y0 < 0 || w.x1 > film.width || w.y1 > film.height || w.x0 >= w.x1 ||
      w.y0 >= w.y1) {
    throw InputError(
        fmt::format("crop window {},{},{},{} is empty or leaves the image of {}x{} "
                    "pixels; x0,y0,x1,y1 "
                    "are pixels, x1 and y1 exclusive",
                    w.x0, w.y0, w.x1, w.y1, film.width, film.height));
  }
}

void CheckSpp(std::int64_t spp) {
  if (spp >= 1 && std::uint64_t(spp) <= kMaxSpp) return;
  throw InputError(
      fmt::format("{} samples per pixel are not supported: 1 to {}", spp, kMaxSpp));
}

void CheckSppSetting(std::uint64_t spp) {
  constexpr auto kMaxInt64 = std::uint64_t(std::numeric_limits<std::int64_t>::max());
  CheckSpp(static_cast<std::int64_t>(std::min(spp, kMaxInt64)));
}

void CheckTarget(const std::optional<double>& target) {
  if (!target || (*target > 0 && std::isfinite(*target))) return;
  throw InputError(
      fmt::format("a target error of {} is not supported: finite and above 0", *target));
}

void ApplyFilm(const RenderSettings& settings, Film& film) {
  CheckSize(film);
  if (settings.resolution) {
    const auto [width, height] = *settings.resolution;
    ScaleCrop(film, width, height);
    film.width = width;
    film.height = height;
    CheckSize(film);
  }
  if (settings.crop) {
    const auto [x0, y0, x1, y1] = *settings.crop;
    const int bounds[4] = {x0, x1, y0, y1};
    std::copy(bounds, bounds + 4, film.crop);
    // All zero would mean the whole image.
    if (x0 == 0 && y0 == 0 && x1 == 0 && y1 == 0) film.crop[1] = film.crop[3] = -1;
  }
  CheckCrop(film);
}

// A film that keeps spectra needs wavelengths.
void ApplySpectralFilm(const std::optional<TransportSetting>& requested,
                       std::optional<Transport>& transport) {
  const bool rgb =
      requested ? *requested == TransportSetting::kRgb : transport == Transport::kRgb;
  if (rgb) {
    throw InputError(fmt::format(
        "the scene's Film \"spectral\" needs wavelengths, but {} renders RGB: remove "
        "that setting, or use Film \"rgb\"",
        requested ? "--transport rgb" : "the \"transport\" \"rgb\" of its Integrator"));
  }
  transport = Transport::kSpectral;
}

// Removes the transport where the scene decides.
void ApplyTransport(const std::optional<TransportSetting>& requested,
                    std::optional<Transport>& transport) {
  if (!requested) return;
  transport.reset();
  if (*requested == TransportSetting::kRgb) transport = Transport::kRgb;
  if (*requested == TransportSetting::kSpectral) transport = Transport::kSpectral;
}

}  // namespace

void ApplySettings(const RenderSettings& settings, SceneDescription& scene) {
  ApplyFilm(settings, scene.film);
  if (settings.spp) CheckSppSetting(*settings.spp);
  CheckTarget(settings.target_relmse);
  CheckTarget(settings.target_rmse);
  if (!settings.spp && !settings.seconds && !HasTarget(settings))
    CheckSpp(scene.sampler.spp);
  if (settings.seconds && !(*settings.seconds > 0 && *settings.seconds <= 1e9)) {
    throw InputError(
        fmt::format("a time budget of {} s is not supported: above 0, at most "
                    "1e9 seconds",
                    *settings.seconds));
  }
  if (settings.max_depth) scene.integrator.max_depth = *settings.max_depth;
  std::optional<Transport>& transport = scene.integrator.transport;
  if (scene.film.buckets.count > 0) {
    ApplySpectralFilm(settings.transport, transport);
  } else {
    ApplyTransport(settings.transport, transport);
  }
  const int depth = scene.integrator.max_depth;
  if (depth < 0 || depth > kMaxDepth) {
    throw InputError(
        fmt::format("maximum depth {} is not supported: 0 to {}", depth, kMaxDepth));
  }
  if (settings.wavefront > kMaxWavefront) {
    throw InputError(fmt::format("a wavefront of {} paths is not supported: 1 to {}",
                                 settings.wavefront, kMaxWavefront));
  }
  if (settings.sampler) scene.strategy.sampler = *settings.sampler;
  if (StartsAtLights(settings, scene)) {
    scene.strategy.light_paths = LightPaths::kSplats;
  } else if (DecidesByDefault(settings, scene)) {
    scene.strategy.decide = Decide::kPilot;
  }
  Apply(settings.strategy, scene.strategy);
  if (settings.seed) scene.sampler.seed = *settings.seed;
  if (settings.gbuffer) scene.film.gbuffer = *settings.gbuffer;
}

bool StartsAtLights(const RenderSettings& settings, const SceneDescription& scene) {
  return scene.integrator.from_lights && settings.strategy.text.empty() &&
         settings.compared.empty();
}

bool DecidesByDefault(const RenderSettings& settings, const SceneDescription& scene) {
  if (settings.decision == DefaultDecision::kNever || !settings.strategy.text.empty() ||
      !scene.integrator.strategy.empty()) {
    return false;
  }
  if (settings.decision == DefaultDecision::kAlways) return true;
  if (settings.seconds) return *settings.seconds >= kMinSecondsForTrial;
  const std::uint64_t pixels = RenderedPixels(scene.film).pixels();
  // A render with a target takes at least this many.
  const std::uint64_t own =
      HasTarget(settings) ? kTrainingSpp : std::uint64_t(scene.sampler.spp);
  const double samples = double(settings.spp.value_or(own)) * double(pixels);
  return samples >= double(DecidedBy(pixels));
}

bool HasTarget(const RenderSettings& settings) {
  return settings.target_relmse || settings.target_rmse;
}

Auxiliary AuxiliaryOf(const RenderSettings& settings, const Film& film) {
  if (film.gbuffer != Gbuffer::kNone) return Auxiliary::kGbuffer;
  return settings.aov ? Auxiliary::kAov : Auxiliary::kNone;
}

CompileOptions CompileOptionsOf(const RenderSettings& settings) {
  CompileOptions options;
  options.scattering = settings.scattering;
  options.build = settings.build.value_or(options.build);
  options.leaf_triangles = LeafTrianglesFor(SimdTarget(settings.target).lanes());
  options.copied_triangles = settings.copied_triangles;
  options.cached_bvh = settings.cached_bvh.get();
  return options;
}

PlanOptions PlanOptionsOf(const RenderSettings& settings, const SceneDescription& scene) {
  PlanOptions options;
  options.target = SimdTarget(settings.target);
  options.max_depth = std::uint32_t(scene.integrator.max_depth);
  options.auxiliary = AuxiliaryOf(settings, scene.film);
  options.spectral_film = scene.film.buckets.count > 0;
  options.wavefront = settings.wavefront;
  return options;
}

}  // namespace lanelight
