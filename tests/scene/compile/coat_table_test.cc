// Fluxes through coats against closed forms and identities.
#include "src/scene/compile/coat.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "src/base/core/check.h"
#include "tests/reference/optics.h"

namespace lanelight {

namespace {

double Mu(int i) { return i / (kCoatTableSize - 1.); }

// Mean transmittance over a cosine distribution, by the trapezoid rule of the table.
double MeanTransmittance(const CoatTable& t) {
  double sum = 0;
  for (int i = 0; i + 1 < kCoatTableSize; ++i) {
    sum += (Mu(i) * t.transmittance[i] + Mu(i + 1) * t.transmittance[i + 1]) /
           (kCoatTableSize - 1);
  }
  return sum;
}

}  // namespace

TEST_CASE("a smooth coat transmits what it does not reflect", "[scene][coat]") {
  const CoatTable t = ComputeCoatTable(0, 1.5, 0);
  for (int i = 1; i < kCoatTableSize; ++i) {
    CHECK(t.transmittance[i] == Approx(1 - reference::FresnelDielectric(Mu(i), 1.5)));
  }
  CHECK(t.transmittance[0] < 1e-4);
}

TEST_CASE("transmission into and out of a coat is reciprocal", "[scene][coat]") {
  // Reciprocity: eta^2 (1 - Fi) = mean transmittance from outside (no absorption). Rough
  // interfaces lose light on each side, by single scattering.
  for (double eta : {1.2, 1.5, 2.0}) {
    const CoatTable smooth = ComputeCoatTable(0, eta, 0);
    CHECK(eta * eta * (1 - smooth.internal_reflectance) ==
          Approx(MeanTransmittance(smooth)).margin(1e-3));
    const CoatTable rough = ComputeCoatTable(0.2, eta, 0);
    CHECK(rough.internal_reflectance < smooth.internal_reflectance);
    CHECK(rough.internal_reflectance > smooth.internal_reflectance - 0.12);
    CHECK(MeanTransmittance(rough) == Approx(MeanTransmittance(smooth)).margin(0.03));
  }
  // Egan and Hilgeman 1973: mean internal reflectance of n = 1.5 is 0.596.
  CHECK(ComputeCoatTable(0, 1.5, 0).internal_reflectance == Approx(0.596).margin(1e-3));
}

TEST_CASE("a coat of matched index only absorbs", "[scene][coat]") {
  const double thickness = 0.3;
  for (double alpha : {0.0, 0.3}) {
    const CoatTable t = ComputeCoatTable(alpha, 1, thickness);
    CHECK(t.internal_reflectance < 1e-12);
    for (int i = 8; i < kCoatTableSize; i += 5) {
      const double ratio = t.transmittance[i] / std::exp(-thickness / Mu(i));
      // G2 / G1 < 1 where rough.
      CHECK(ratio < 1 + 1e-6);
      CHECK(ratio > (alpha == 0 ? 1 - 1e-6 : 0.65));
    }
  }
}

TEST_CASE("a nearly smooth coat is close to a smooth one", "[scene][coat]") {
  const CoatTable smooth = ComputeCoatTable(0, 1.5, 0.01);
  const CoatTable fine = ComputeCoatTable(2e-3, 1.5, 0.01);
  CHECK(fine.internal_reflectance == Approx(smooth.internal_reflectance).margin(2e-3));
  for (int i = 4; i < kCoatTableSize; ++i) {
    CHECK(fine.transmittance[i] == Approx(smooth.transmittance[i]).margin(1e-3));
  }
}

TEST_CASE("coats out of range are refused", "[scene][coat]") {
  CHECK_THROWS_AS(ComputeCoatTable(-1, 1.5, 0), CheckFailure);
  CHECK_THROWS_AS(ComputeCoatTable(0.1, 0, 0), CheckFailure);
  CHECK_THROWS_AS(ComputeCoatTable(0.1, NAN, 0), CheckFailure);
  CHECK_THROWS_AS(ComputeCoatTable(0.1, 1.5, -0.1), CheckFailure);
}

}  // namespace lanelight
