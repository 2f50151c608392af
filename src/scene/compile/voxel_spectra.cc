#include "src/scene/compile/voxel_spectra.h"

#include <algorithm>
#include <cmath>

#include "src/base/image/upsampling.h"

namespace lanelight {

VoxelSpectrum SpectrumOfVoxel(Rgb color) {
  const double scale = 2 * std::max({color.x, color.y, color.z});
  VoxelSpectrum spectrum = {{0, 0, 0}, static_cast<float>(scale)};
  const bool grey = color.x == color.y && color.y == color.z;
  if (grey || !(scale > 0)) return spectrum;
  const SigmoidSpectrum shape = SigmoidByTable(color / scale);
  for (std::size_t k = 0; k < 3; ++k) spectrum.c[k] = static_cast<float>(shape.c[k]);
  return spectrum;
}

void AppendSpectrum(Rgb color, AlignedVector<float>& values) {
  const VoxelSpectrum s = SpectrumOfVoxel(color);
  values.insert(values.end(), {s.c[0], s.c[1], s.c[2], s.scale});
}

// A sigmoid grows with its argument, and a quadratic is largest at an end of the range or
// where its slope is 0. Both multiply-adds of a kernel, and the rounded position, err by
// about 2^-24 of the sum of the coefficients. A sigmoid has a slope of at most 1/2.
double LargestOf(const VoxelSpectrum& spectrum) {
  static const double low = SigmoidPlace(CarriedWavelengths().centre.front());
  static const double high = SigmoidPlace(CarriedWavelengths().centre.back());
  const double c0 = spectrum.c[0], c1 = spectrum.c[1], c2 = spectrum.c[2];
  const auto at = [&](double t) { return (c0 * t + c1) * t + c2; };
  double most = std::max(at(low), at(high));
  const double flat = -c1 / (2 * c0);
  if (flat > low && flat < high) most = std::max(most, at(flat));
  const double rounding = (std::abs(c0) + std::abs(c1) + std::abs(c2)) * 0x1p-23;
  const double sigmoid = 0.5 + 0.5 * most / std::sqrt(1 + most * most);
  return spectrum.scale * std::min(1.0, sigmoid + rounding);
}

}  // namespace lanelight
