// The colours of an image as three planes, and errors between two images.
#pragma once

#include <array>
#include <vector>

#include "src/base/image/image.h"

namespace lanelight {

/// Values of one channel, rows from the top.
using Plane = std::vector<float>;

/// Linear sRGB.
struct LinearImage {
  int width = 0, height = 0;
  std::array<Plane, 3> planes;

  std::size_t pixels() const { return static_cast<std::size_t>(width) * height; }
  /// Returns the values of all pixels, each with its three channels.
  std::vector<float> Interleaved() const;
};

/// Returns the colour channels of an image, decoded if they are bytes; grey becomes three
/// equal planes. Throws InputError for an image without colour.
LinearImage LinearOf(const Image& image);

/// Errors of each pixel; NaN where a value of either image is invalid.
struct ErrorMaps {
  Plane difference;  // (a - b) / sqrt(b^2 + kRelativeEpsilon), of the channels' means
  Plane relative;    // root of the mean of (a - b)^2 / (b^2 + kRelativeEpsilon)
  Plane absolute;    // root of the mean of (a - b)^2
};

ErrorMaps ErrorMapsOf(const LinearImage& test, const LinearImage& reference);

/// Returns the end of a colour scale: a number with one digit that 98 % of |values| do
/// not exceed. 1 if all are zero, or none is finite.
double ScaleOf(const Plane& values);

struct ErrorTile {
  int x = 0, y = 0, width = 0, height = 0;  // in pixels
  double relmse = 0;  // mean of (a - b)^2 / (b^2 + kRelativeEpsilon)
  double share = 0;   // fraction of the sum over all tiles
};

/// Returns at most `maximum` tiles (of LayoutOf()) with the largest sums of relative
/// squared errors, largest first. Tiles without error and invalid values are left out.
std::vector<ErrorTile> WorstTiles(const LinearImage& test, const LinearImage& reference,
                                  std::size_t maximum);

}  // namespace lanelight
