// Weights of multiple importance sampling: what light samples and hits get of the light
// along one direction adds up to all of it.
#include "kernels/simd/each_target-inl.h"

#include "kernels/directions/heuristic-inl.h"
#include "src/base/core/source_location.h"
#include "tests/kernels/directions/heuristics.h"

LANELIGHT_BEGIN_KERNELS

void Weigh(const WeightBatch& w) {
  const DF df;
  for (int i = 0; i < w.n; i += static_cast<int>(hn::Lanes(df))) {
    const VF light = hn::LoadU(df, w.light_pdf + i), bsdf = hn::LoadU(df, w.bsdf_pdf + i);
    hn::StoreU(LightSampleWeight(w.mis, light, bsdf), df, w.of_light_sample + i);
    hn::StoreU(EmissionWeight(w.mis, bsdf, light), df, w.of_emission + i);
  }
}

LANELIGHT_END_KERNELS

#if HWY_ONCE
#include <catch2/catch.hpp>
#include <cmath>
#include <random>
#include <vector>

#include "src/scene/prepare/parameters.h"
#include "tests/support/each_target.h"

namespace lanelight {

HWY_EXPORT(Weigh);

namespace {

constexpr int kPairs = 1 << 12;
// Ratios of densities beyond 1e18 count as 1e18.
constexpr double kRatioTolerance = 1.01e-18;

struct Weights {
  std::vector<float> light_pdf, bsdf_pdf, light, emission;

  // Densities of 24 decades each, and 0: a delta light, a specular event.
  explicit Weights(const std::string& strategy) {
    std::mt19937 engine(19);
    std::uniform_real_distribution<float> exponent(-12, 12);
    const auto density = [&] {
      return engine() % 16 == 0 ? 0.0f : std::pow(10.0f, exponent(engine));
    };
    for (int i = 0; i < kPairs; ++i) {
      light_pdf.push_back(density());
      bsdf_pdf.push_back(density());
    }
    light.resize(kPairs), emission.resize(kPairs);
    Strategy s;
    ApplyStrategy(strategy, {}, s);
    LANELIGHT_ON(TestTarget(), Weigh)
    ({kPairs, MakeMisParameters(s), light_pdf.data(), bsdf_pdf.data(), light.data(),
      emission.data()});
  }
};

// Veach's heuristics in double precision: power with exponent 2, or balance (1).
double VeachWeight(double exponent, double mine, double other) {
  return 1 / (1 + std::pow(other / mine, exponent));
}

}  // namespace

TEST_CASE("the weights of both techniques add up to one", "[directions]") {
  const EachTarget target;
  for (double exponent : {1.0, 2.0}) {
    CAPTURE(exponent);
    const Weights w(exponent == 1 ? "directions=mis:balance" : "directions=mis:power");
    for (int i = 0; i < kPairs; ++i) {
      const double p = w.light_pdf[i], q = w.bsdf_pdf[i];
      INFO("densities " << p << " and " << q);
      // A delta light is found by light samples alone; what is seen after a specular
      // event, by hits alone.
      const double of_light = p == 0 ? 1 : q == 0 ? 1 : VeachWeight(exponent, p, q);
      const double of_hit = q == 0 ? 1 : p == 0 ? 1 : VeachWeight(exponent, q, p);
      REQUIRE(w.light[i] == Approx(of_light).epsilon(1e-6).margin(kRatioTolerance));
      REQUIRE(w.emission[i] == Approx(of_hit).epsilon(1e-6).margin(kRatioTolerance));
      if (p > 0 && q > 0) REQUIRE(w.light[i] + w.emission[i] == Approx(1).epsilon(1e-6));
    }
  }
}

TEST_CASE("directions=light counts light samples only", "[directions]") {
  const EachTarget target;
  const Weights w("directions=light");
  for (int i = 0; i < kPairs; ++i) {
    REQUIRE(w.light[i] == 1);
    REQUIRE(w.emission[i] == (w.bsdf_pdf[i] == 0 ? 1 : 0));
  }
}

}  // namespace lanelight
#endif
