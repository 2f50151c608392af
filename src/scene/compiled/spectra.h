// Spectra of paths that carry wavelengths, by bins of wavelengths.
//
// A path carries three wavelengths in its colour columns: a long one for red, a middle
// one and a short one, bins 2 N + i, N + i and i of triple i
// (src/base/image/wavelengths.h). Radiance is in units of D65, so light of colour (1, 1,
// 1) is 1 at all wavelengths and greys are as in RGB. The film converts the three to
// linear sRGB (kernels/texture/wavelengths-inl.h).
#pragma once

#include <cstdint>

#include "src/base/core/aligned.h"

namespace lanelight {

/// Kind of a colour that varies by path, in the spectrum columns of materials.
enum class PathColor : std::int32_t {
  kReflectance = -1,
  kUnbounded = -2,        // an index of refraction, say
  kMetalExtinction = -3,  // k of a metal that is given by its reflectance, whose index is
                          // color0 of the material
  kScaledReflectance = -4,  // times color_scale of the material, 1 at most
};

struct SpectrumTable {
  AlignedVector<float> rows;     // kWavelengthBins each
  AlignedVector<float> indices;  // of refraction, at the edges of bins: kWavelengthEdges
  AlignedVector<float> film[3];  // what 1 in a bin adds to red, green and blue
  AlignedVector<float>
      place;  // of bins: argument of sigmoids (src/base/image/upsampling.h)
  // Filled if colours vary by path: PolynomialThrough(), row by row, and
  // UpsamplingTable().
  AlignedVector<float> polynomial, sigmoids;
  float per_half_tangent = 0;  // 1 / HalfTangentOfGrey(1 - kMinUpsampled)
};

}  // namespace lanelight
