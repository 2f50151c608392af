#include "src/scene/compile/coat_color.h"

#include <algorithm>
#include <cmath>

#include "src/base/image/upsampling.h"

namespace lanelight {
namespace {

// rho in [0, 1] of that response, by bisection of an increasing function.
double InvertResponse(double response, double internal, int bounces) {
  double low = 0, high = 1;
  for (int i = 0; i < 50; ++i) {
    const double middle = (low + high) / 2;
    (CoatedResponse(middle, internal, bounces) < response ? low : high) = middle;
  }
  return (low + high) / 2;
}

}  // namespace

double CoatedResponse(double rho, double internal, int bounces) {
  const double q = rho * internal;
  // (1 - q^n) / (1 - q); for q near 1 without cancellation.
  const double series = q == 1 ? bounces : -std::expm1(bounces * std::log(q)) / (1 - q);
  return rho * series;
}

Rgb EffectiveCoatBase(Rgb rgb, double internal, int bounces) {
  if (rgb.x == rgb.y && rgb.y == rgb.z) return rgb;
  const Spectrum base = ReflectanceOfRgb(Max(Min(rgb, {1, 1, 1}), {0, 0, 0}));
  return EffectiveCoatBase(rgb, base, internal, bounces);
}

Rgb EffectiveCoatBase(Rgb rgb, const Spectrum& base, double internal, int bounces) {
  const Rgb fitted = ColorUnderD65(base);
  const Rgb response = ColorUnderD65(
      [&](double nm) { return CoatedResponse(base(nm), internal, bounces); });
  Rgb effective;
  for (int c = 0; c < 3; ++c) {
    // What the fit misses of the colour is taken as a factor, so that a response that is
    // linear gives back the colour itself.
    const double miss = fitted[c] > 0.01 ? rgb[c] / fitted[c] : 1;
    const double wanted =
        fitted[c] > 0.01 ? response[c] * miss : CoatedResponse(rgb[c], internal, bounces);
    effective[c] = InvertResponse(std::max(wanted, 0.0), internal, bounces);
  }
  return effective;
}

}  // namespace lanelight
