// The RGB colour of a coated base stands for its spectrum.
#include "src/scene/compile/coat.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "src/base/image/upsampling.h"

namespace lanelight {

TEST_CASE("coat color: the response is the truncated geometric series", "[coat]") {
  CHECK(CoatedResponse(0.5, 0.6, 1) == Approx(0.5));
  CHECK(CoatedResponse(0.5, 0.6, 3) == Approx(0.5 * (1 + 0.3 + 0.09)));
  CHECK(CoatedResponse(1, 0.6, 200) == Approx(1 / 0.4));
  CHECK(CoatedResponse(0, 0.6, 3) == 0);
  // Under a coat of index 10 thousands of terms count.
  CHECK(CoatedResponse(1, 0.996, 5000) == Approx(250));
  CHECK(CoatedResponse(1, 1, 5000) == 5000);
}

TEST_CASE("coat color: a spectrum has its specified colour", "[coat]") {
  for (const Rgb rgb : {Rgb{0.8, 0.4, 0.2}, Rgb{0.1, 0.5, 0.3}, Rgb{0.2, 0.2, 0.7},
                        Rgb{0.5, 0.5, 0.5}, Rgb{0.63, 0.065, 0.05}}) {
    const Rgb color = ColorUnderD65(ReflectanceOfRgb(rgb));
    CHECK(Length(color - rgb) < 2e-3);
  }
}

TEST_CASE("coat color: greys and single bounces are unchanged", "[coat]") {
  CHECK(EffectiveCoatBase({0.7, 0.7, 0.7}, 0.6, 5) == Rgb{0.7, 0.7, 0.7});
  const Rgb color = {0.8, 0.4, 0.2};
  CHECK(Length(EffectiveCoatBase(color, 0.6, 1) - color) < 1e-6);
  CHECK(Length(EffectiveCoatBase(color, 0.0, 5) - color) < 1e-6);
}

TEST_CASE("coat color: interreflection averages over wavelengths", "[coat]") {
  // The response is convex: a red that is 1 only in the mean returns less than a flat 1.
  const Rgb orange = {1, 0.378676, 0.013473};
  const Rgb effective = EffectiveCoatBase(orange, 0.6, 5);
  CHECK(effective.x < 0.99);
  CHECK(effective.x > 0.85);
  // The colour of the spectral response, computed here again.
  const Spectrum base = ReflectanceOfRgb(orange);
  const Rgb wanted =
      ColorUnderD65([&](double nm) { return CoatedResponse(base(nm), 0.6, 5); });
  CHECK(CoatedResponse(effective.x, 0.6, 5) == Approx(wanted.x).epsilon(0.03));
}

}  // namespace lanelight
