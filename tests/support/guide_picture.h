// What a guide has learned, for the eye: the light around the point that a pixel sees.
#pragma once

#include <atomic>
#include <cstdint>
#include <string>

#include "src/image/image.h"
#include "src/render/job.h"

namespace lanelight {

struct GuidePictureOptions {
  int x = 0, y = 0;                  // pixel of the image
  std::uint64_t samples = 1u << 24;  // of the image that the guide is trained for
  std::uint64_t rays = 1u << 16;     // of the pixel, for the other half of the picture
  int side = 384;                    // of a hemisphere, in pixels
  const std::atomic<bool>* stop = nullptr;
};

struct GuidePicture {
  /// Channel "Y": two hemispheres side by side, seen from above the surface, in projected
  /// solid angle; of each the density of directions over that of the cosine (1: no more
  /// than a diffuse surface expects), 0 outside. Left what the cell of the guide has
  /// learned, right what rays of this pixel have brought since, in squares.
  Image image;
  Vec3f point, normal;       // that the pixel sees
  double fraction = 0;       // with which the guide proposes there
  double bright_cosine = 0;  // largest density on the left over that of the cosine
  std::size_t cells = 0;
  std::string note;  // of the training
};

/// Trains guiding=radiance as a render of so many samples would, with the job's strategy
/// else. Throws InputError where the scene has no guide, the pixel is not in the image or
/// sees no surface that scatters, or after an interrupt.
GuidePicture PictureOfGuide(const Job& job, const GuidePictureOptions& options);

/// The same in colours: black, red, yellow, white by the logarithm, from a quarter of the
/// density of the cosine to 64 times as much.
Image ColoredGuide(const GuidePicture& picture);

}  // namespace lanelight
