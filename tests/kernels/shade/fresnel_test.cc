// Fresnel equations against closed forms in double precision.
#include <array>
#include <catch2/catch.hpp>
#include <cmath>

#include "tests/kernels/probe/math_probe.h"
#include "src/measure/stress/closed_forms.h"
#include "tests/kernels/shade/probe_batch.h"
#include "tests/reference/optics.h"
#include "tests/support/each_target.h"

namespace lanelight {

namespace {

constexpr int kCount = 4096;

struct Incidences {
  std::vector<float> c, out, cos_t;
  Incidences(float eta, float k) : c(kCount), out(kCount), cos_t(kCount) {
    for (int i = 0; i < kCount; ++i) c[i] = (i + 0.5f) / kCount;
    for (int i = 0; i < 16; ++i) c[i] = std::ldexp(1.f, -24 + i);  // grazing
    const float critical = k < 0 && eta < 1 ? std::sqrt((1 - eta) * (1 + eta)) : 0;
    for (int i = 0; i < 8; ++i) {
      c[100 + i] = critical + std::pow(10.f, -i) * (1 - critical);
    }
    c[kCount - 1] = 1;
    const std::vector<float> etas(kCount, eta), ks(kCount, k);
    ProbeFresnel(TestTarget(), {kCount, c.data(), etas.data(),
                                k < 0 ? nullptr : ks.data(), out.data(), cos_t.data()});
  }
};

}  // namespace

TEST_CASE("dielectric reflectance", "[shade][fresnel]") {
  const EachTarget target;
  for (float eta : {1.5f, 1.33f, 2.4f, 1 / 1.5f, 0.4f}) {
    const Incidences at(eta, -1);
    double worst = 0, worst_cosine = 0;
    for (int i = 0; i < kCount; ++i) {
      worst = std::max(worst,
                       std::abs(at.out[i] - reference::FresnelDielectric(at.c[i], eta)));
      const double cos_t = reference::RefractedCosine(at.c[i], eta);
      // Near the critical angle the cosine is the root of a small difference.
      worst_cosine = std::max(
          worst_cosine, std::abs(Dot(Vec3d{at.cos_t[i], 0, 0}, {at.cos_t[i], 0, 0}) -
                                 std::max(cos_t, 0.) * std::max(cos_t, 0.)));
    }
    INFO("eta " << eta);
    // F changes like the root of the distance to the critical angle.
    CHECK(worst < (eta < 1 ? 2e-3 : 1e-6));
    CHECK(worst_cosine < 1e-6);
  }
  const Incidences normal(1.5f, -1);
  CHECK(normal.out[kCount - 1] == Approx(0.04).epsilon(1e-6));
}

TEST_CASE("indices close to one keep their relative accuracy", "[shade][fresnel]") {
  const EachTarget target;
  for (float eta : {1 + 0x1p-20f, 1 + 0x1p-10f, 1 - 0x1p-20f}) {
    const Incidences at(eta, -1);
    double worst = 0;
    for (int i = 0; i < kCount; ++i) {
      const long double c = at.c[i], n = eta, contrast = (n - 1) * (n + 1);
      if (c * c < -2 * contrast) continue;  // near or beyond the critical angle
      const long double g = std::sqrt(contrast + c * c);
      const long double s = contrast / ((g + c) * (g + c));
      const long double p = s * (c * (g + c) - 1) / (c * (g - c) + 1);
      const long double want = (s * s + p * p) / 2;
      worst = std::max<double>(worst, std::abs(at.out[i] / want - 1));
    }
    INFO("eta - 1 = " << eta - 1);
    CHECK(worst < 3e-5);
  }
  const Incidences none(1, -1);
  double maximum = 0;
  for (int i = 0; i < kCount; ++i) maximum = std::max<double>(maximum, none.out[i]);
  CHECK(maximum == 0);
}

TEST_CASE("conductor reflectance", "[shade][fresnel]") {
  const EachTarget target;
  const float metals[][2] = {{0.2f, 3.9f}, {1.1f, 2.1f}, {0.04f, 0.001f}, {1, 1e-4f},
                             {60, 60},     {1.5f, 0},    {0, 2}};
  for (const auto& [eta, k] : metals) {
    const Incidences at(eta, k);
    double worst = 0;
    for (int i = 0; i < kCount; ++i) {
      const double want = reference::FresnelConductor(at.c[i], eta, k);
      worst = std::max(worst, std::abs(at.out[i] - want));
    }
    INFO("eta " << eta << ", k " << k);
    CHECK(worst < (eta < 0.1f && k < 0.1f ? 2e-3 : 2e-6));
  }
}

// Within 3e-5 of itself (kernels/bsdf/fresnel-inl.h), and what a rounding of the cosine
// changes: from grazing angles to 1e-7 above the critical one.
TEST_CASE("reflectance keeps its relative accuracy for any index", "[shade][fresnel]") {
  std::vector<std::array<float, 2>> media;
  for (double contrast = 1e-7; contrast < 2e3; contrast *= 10) {
    media.push_back({static_cast<float>(1 + contrast), -1});
    media.push_back({static_cast<float>(1 / (1 + contrast)), -1});
  }
  for (const float eta : {0.999f, 0.75f, 0.1f}) media.push_back({eta, -1});
  for (double k = 1e-9; k < 2e9; k *= std::pow(10, 1.5)) {
    for (const float eta : {0.01f, 1.f, 100.f}) {
      media.push_back({eta, static_cast<float>(k)});
    }
  }
  const EachTarget target;
  for (const auto& [eta, k] : media) {
    const auto exact = [&, eta = eta, k = k](double c) {
      return k < 0 ? stress::FresnelDielectric(c, eta)
                   : stress::FresnelConductor(c, eta, k);
    };
    const Incidences at(eta, k);
    int wrong = 0;
    for (int i = 0; i < kCount; ++i) {
      const double c = at.c[i], want = exact(c);
      const double slope =
          std::abs(exact(std::min(1., c * (1 + 0x1p-22))) - exact(c * (1 - 0x1p-22)));
      wrong += !(std::abs(at.out[i] - want) <= 3e-5 * want + slope);
    }
    INFO("eta " << eta << ", k " << k);
    CHECK(wrong == 0);
  }
}

}  // namespace lanelight
