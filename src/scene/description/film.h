// The film of a scene file: its size, and what it makes of light.
#pragma once

#include <string>

#include "src/base/image/film_response.h"
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

}  // namespace lanelight
