// The wavelengths that paths carry, in three bins each.
//
// The visible range is cut into three segments of N bins. Bins i, N + i and 2 N + i are a
// triple; a path draws one of the N triples. The edges are such that every triple has the
// same share of each channel of D65, so white light is white in every triple. Colours
// therefore add no noise to greys, and little to anything else. The relative variance
// over triples of a diffuse surface under D65 is 0 for white and 0.003 for skin. With
// three wavelengths a third of pbrt-v4's density apart it is 0.32 and 0.25.
//
// A glass that spreads colours leaves a path one of its three wavelengths, all alike
// likely (hero wavelengths: Wilkie et al. 2014).
#pragma once

#include <array>
#include <vector>

#include "src/base/image/spectrum_integral.h"

namespace lanelight {

struct WavelengthBins {
  std::array<double, kWavelengthEdges> edge;   // nm, increasing
  std::array<double, kWavelengthBins> centre;  // of what the film sees in a bin
  /// Linear sRGB of 1 in a bin, in units of D65, times N: a triple of ones is (1, 1, 1).
  std::array<Rgb, kWavelengthBins> film;
};

/// Returns the bins, which are computed once.
const WavelengthBins& CarriedWavelengths();

/// Means of a spectrum over the bins, weighted by the response of the film.
std::vector<float> BinMeans(const Spectrum& spectrum);
/// The same for smooth spectra: values at the centres.
std::vector<float> BinValues(const Spectrum& spectrum);

/// Colour of values in the bins: of a reflectance under D65, or of light in units of it.
Rgb ColorOfBins(const std::vector<float>& values);

}  // namespace lanelight
