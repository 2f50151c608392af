// Film and integrator of a scene file.
#pragma once

#include <optional>
#include <string>

#include "src/base/core/source_location.h"
#include "src/base/image/color_spaces.h"
#include "src/base/image/pixel_rect.h"
#include "src/base/image/spectral_buckets.h"
#include "src/vocabulary/path/scene_kinds.h"

namespace lanelight {

struct Film {
  int width = 1280, height = 720;
  int crop[4] = {0, 0, 0, 0};  // pixel bounds x0 x1 y0 y1; all 0: whole image
  std::string filename = "lanelight.exr";
  double imaging_ratio = 1;  // exposure time * ISO / 100
  FilmResponse response;
  std::string color_space = "srgb";  // of the image
  Gbuffer gbuffer = Gbuffer::kNone;
  SpectralBuckets buckets;  // Film "spectral"
};

struct Integrator {
  int max_depth = 5;     // scattering events at most, as in pbrt
  std::string strategy;  // changes to the strategy (src/vocabulary/strategy/strategy.h)
  SourceLocation strategy_where;
  /// The file asks for paths from the lights as well (pbrt-v4's "bdpt", "lightpath"),
  /// there.
  std::optional<SourceLocation> from_lights;
  /// Surfaces scatter evenly, with the reflectance that their material has for light from
  /// where they are seen (pbrt-v4's option "forcediffuse").
  bool force_diffuse = false;
  /// Microfacets are rougher behind a bounce that is not specular: below 0.3, alpha
  /// becomes 2 alpha, but at least 0.1 and at most 0.3 (pbrt-v4's "regularize").
  bool regularize = false;
  /// Nothing: the file does not say it. CompileScene then takes RGB.
  std::optional<Transport> transport;
};

/// The film's crop window; the whole image if it has none.
inline PixelRect RenderedPixels(const Film& film) {
  const int* c = film.crop;
  if (c[0] == 0 && c[1] == 0 && c[2] == 0 && c[3] == 0) {
    return {0, 0, film.width, film.height};
  }
  return {c[0], c[2], c[1], c[3]};
}

}  // namespace lanelight
