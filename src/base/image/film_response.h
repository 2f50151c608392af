// The response of a film: white balance, a limit, and the primaries of the image. As in
// pbrt-v4, samples are limited before they are converted to primaries.
#pragma once

#include <cstddef>
#include <limits>

#include "src/base/image/color_matrix.h"

namespace lanelight {

struct FilmResponse {
  /// From linear sRGB to what the image holds.
  ColorMatrix matrix = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  /// Most that X, Y or Z of a sample may be, the exposure included; larger ones are
  /// scaled down, which darkens the image: it is biased, as in pbrt-v4.
  double max_component = std::numeric_limits<double>::infinity();

  bool limits() const { return max_component < std::numeric_limits<double>::infinity(); }
  bool IsIdentity() const;
};

/// Planes of linear sRGB, changed in place.
struct ColorPlanes {
  float *r, *g, *b;
};
/// Scales down colours with a component above the limit.
void LimitColors(const FilmResponse& response, const ColorPlanes& planes,
                 std::size_t count);
/// Multiplies all colours by the matrix.
void ConvertColors(const FilmResponse& response, const ColorPlanes& planes,
                   std::size_t count);

}  // namespace lanelight
