// Sample points: net structure of Sobol' points, independence across keys and groups,
// uniformity, and equality over SIMD targets (golden by cross-check with a scalar twin).
#include "kernels/points/probe.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "kernels/simd/target.h"

namespace lanelight {
namespace {

struct Drawn {
  std::vector<float> u0, u1;
};

Drawn Draw(PointsQuery q) {
  Drawn p{std::vector<float>(q.count + 16), std::vector<float>(q.count + 16)};
  ProbePoints(q, p.u0.data(), p.u1.data());
  p.u0.resize(q.count);
  p.u1.resize(q.count);
  return p;
}

// True if each cell of an a x b grid over the unit square holds exactly one point.
bool OnePerCell(const Drawn& p, std::size_t first, int a, int b) {
  std::vector<int> cells(static_cast<std::size_t>(a * b));
  for (int i = 0; i < a * b; ++i) {
    const int x = static_cast<int>(p.u0[first + static_cast<std::size_t>(i)] * float(a));
    const int y = static_cast<int>(p.u1[first + static_cast<std::size_t>(i)] * float(b));
    ++cells[static_cast<std::size_t>(y * a + x)];
  }
  for (int n : cells) {
    if (n != 1) return false;
  }
  return true;
}

struct Lcg {  // PCG-4D, scalar, written from the paper's equations
  std::uint32_t v[4];
  void Mix() {
    v[0] += v[1] * v[3];
    v[1] += v[2] * v[0];
    v[2] += v[0] * v[1];
    v[3] += v[1] * v[2];
  }
  Lcg(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d)
      : v{a, b, c, d} {
    for (auto& x : v) x = x * 1664525u + 1013904223u;
    Mix();
    for (auto& x : v) x ^= x >> 16;
    Mix();
  }
};

}  // namespace

TEST_CASE("sobol: every aligned power-of-two block is a (0, m, 2)-net", "[points]") {
  for (const std::string& target : AvailableTargets()) {
    ForceTarget(target);
    for (std::uint32_t pixel : {0u, 1u, 77777u}) {
      const Drawn p = Draw({Points::kSobol, 7, pixel, 256, 3, 0, 256});
      for (int m = 0; m <= 8; ++m) {
        for (std::size_t first = 0; first < 256; first += std::size_t{1} << m) {
          for (int k = 0; k <= m; ++k)
            REQUIRE(OnePerCell(p, first, 1 << k, 1 << (m - k)));
        }
      }
    }
  }
  ForceTarget("");
}

TEST_CASE("sobol: groups are different randomisations", "[points]") {
  const Drawn p = Draw({Points::kSobol, 1, 5, 16, 0, 0, 64});
  for (std::size_t group = 0; group < 4; ++group) CHECK(OnePerCell(p, group * 16, 4, 4));
  // Independently scrambled nets do not continue each other.
  CHECK_FALSE(OnePerCell(p, 0, 8, 8));
}

TEST_CASE("points: different keys, pixels and seeds are uncorrelated", "[points]") {
  const std::uint32_t n = 4096;
  for (Points policy : {Points::kIndependent, Points::kSobol}) {
    const PointsQuery base = {policy, 3, 10, 1, 20, 0, n};
    PointsQuery key = base, pixel = base, seed = base;
    key.key = 21;
    pixel.pixel = 11;
    seed.seed = 4;
    const Drawn a = Draw(base);
    for (const PointsQuery& q : {key, pixel, seed}) {
      const Drawn b = Draw(q);
      double covariance = 0;
      for (std::size_t i = 0; i < n; ++i) covariance += (a.u0[i] - 0.5) * (b.u0[i] - 0.5);
      // Standard deviation of the sum is sqrt(n) / 12; 5 of them: one false alarm in
      // 10^6.
      CHECK(std::abs(covariance) < 5 * std::sqrt(double(n)) / 12);
    }
  }
}

TEST_CASE("points: in [0, 1), uniform, and equal on all targets", "[points]") {
  const std::uint32_t n = 1 << 16;
  for (Points policy : {Points::kIndependent, Points::kSobol}) {
    Drawn first;
    for (const std::string& target : AvailableTargets()) {
      ForceTarget(target);
      const Drawn p = Draw({policy, 9, 123, 1, 4, 0, n});
      if (first.u0.empty()) first = p;
      CHECK(p.u0 == first.u0);
      CHECK(p.u1 == first.u1);
    }
    ForceTarget("");
    double chi2 = 0;
    std::vector<double> cells(256);
    for (std::size_t i = 0; i < n; ++i) {
      REQUIRE(first.u0[i] >= 0);
      REQUIRE(first.u0[i] < 1);
      ++cells[static_cast<std::size_t>(first.u0[i] * 16) * 16 +
              static_cast<std::size_t>(first.u1[i] * 16)];
    }
    for (double c : cells) chi2 += (c - n / 256.0) * (c - n / 256.0) / (n / 256.0);
    // 255 degrees of freedom: mean 255, standard deviation 22.6.
    CHECK(chi2 < 255 + 6 * 22.6);
  }
}

TEST_CASE("independent points equal the scalar PCG-4D", "[points]") {
  const Drawn p = Draw({Points::kIndependent, 42, 1000, 1, 17, 5, 100});
  for (std::uint32_t i = 0; i < 100; ++i) {
    const Lcg h(1000, 5 + i, 17, 42);
    CHECK(p.u0[i] == float(h.v[0] >> 8) * 0x1p-24f);
    CHECK(p.u1[i] == float(h.v[1] >> 8) * 0x1p-24f);
  }
}

}  // namespace lanelight
