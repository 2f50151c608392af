#include "src/image/blackbody.h"

#include <cmath>

#include "src/core/check.h"
#include "src/image/color_matrix.h"
#include "src/image/spectrum_integral.h"

namespace lanelight {
namespace {

// Over its maximum, which by Wien's law is where h c / (lambda k T) = 4.965.
Spectrum NormalizedBlackbody(double kelvin) {
  constexpr double kSecondConstant = 1.438776877e7;  // h c / k, in nm K
  constexpr double kPeak = 4.965114231744276;
  return [kelvin](double nm) {
    const double x = kSecondConstant / (nm * kelvin);
    if (x > 700) return 0.0;  // below 1e-290
    const double q = x / kPeak, q2 = q * q;
    return q2 * q2 * q * (std::expm1(kPeak) / std::expm1(x));
  };
}

}  // namespace

Rgb RgbOfBlackbody(double kelvin) {
  LL_CHECK_GT(kelvin, 0);
  LL_CHECK(std::isfinite(kelvin));
  static const double unit =
      kPhotometricIntegral / Luminance(ColorOfLight([](double) { return 1.0; }));
  const Rgb color = ColorOfLight(NormalizedBlackbody(kelvin));
  const double luminance = Luminance(color);
  const Rgb seen = Max(color, Rgb{});
  if (!(luminance > 0)) return {};
  return seen * (unit * luminance / Luminance(seen));
}

}  // namespace lanelight
