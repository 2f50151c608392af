#include "src/base/image/spectrum.h"

#include <cmath>

#include "src/base/core/check.h"
#include "src/base/image/color_spaces.h"
#include "src/base/image/spectrum_integral.h"
#include "src/base/image/wavelengths.h"

namespace lanelight {

Spectrum NormalizedBlackbody(double kelvin) {
  return [kelvin](double nm) {
    const double x = kSecondRadiation / (nm * kelvin);
    if (x > 700) return 0.0;  // below 1e-290
    const double q = x / kPlanckPeak, q2 = q * q;
    return q2 * q2 * q * (std::expm1(kPlanckPeak) / std::expm1(x));
  };
}

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

std::vector<float> UnitsOfBlackbody() {
  const Spectrum d65 = DaylightD65();
  std::vector<float> units = BinMeans([&](double nm) { return 1 / d65(nm); });
  const double scale = kPhotometricIntegral / Luminance(ColorOfBins(units));
  for (float& v : units) v = static_cast<float>(double(v) * scale);
  return units;
}

}  // namespace lanelight
