// Elementary functions against libm in double: the bounds that math-inl.h states.
#include "kernels/simd/each_target-inl.h"

#include "kernels/simd/math-inl.h"

LANELIGHT_BEGIN_KERNELS

template <class Function>
void Map(const float* x, const float* y, float* a, float* b, int n, Function f) {
  const DF df;
  for (int i = 0; i < n; i += static_cast<int>(hn::Lanes(df))) {
    const SinCosPair r = f(hn::LoadU(df, x + i), hn::LoadU(df, y + i));
    hn::StoreU(r.sin, df, a + i);
    hn::StoreU(r.cos, df, b + i);
  }
}
void MapSinCos2Pi(const float* x, const float* y, float* a, float* b, int n) {
  Map(x, y, a, b, n, [](VF u, VF) HWY_ATTR { return SinCos2Pi(u); });
}
void MapSinCosOctant(const float* x, const float* y, float* a, float* b, int n) {
  Map(x, y, a, b, n, [](VF u, VF) HWY_ATTR { return SinCosOctant(u); });
}
void MapAtan2(const float* x, const float* y, float* a, float* b, int n) {
  Map(x, y, a, b, n,
      [](VF u, VF v) HWY_ATTR { return SinCosPair{Atan2(v, u), AtanUnit(u)}; });
}
void MapExp(const float* x, const float* y, float* a, float* b, int n) {
  Map(x, y, a, b, n, [](VF u, VF) HWY_ATTR { return SinCosPair{Exp(u), u}; });
}

LANELIGHT_END_KERNELS

#if HWY_ONCE
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "tests/support/each_target.h"

namespace lanelight {

HWY_EXPORT(MapSinCos2Pi);
HWY_EXPORT(MapSinCosOctant);
HWY_EXPORT(MapAtan2);
HWY_EXPORT(MapExp);

namespace {

constexpr int kCount = 1 << 16;
constexpr double kPiD = std::numbers::pi;

struct Columns {
  std::vector<float> x, y, a, b;
  Columns() : x(kCount), y(kCount), a(kCount), b(kCount) {}
  void Fill(double low, double high) {
    std::mt19937_64 engine(7);
    std::uniform_real_distribution<double> d(low, high);
    for (float& v : x) v = static_cast<float>(d(engine));
    for (float& v : y) v = static_cast<float>(d(engine));
  }
};

}  // namespace

TEST_CASE("SinCos2Pi stays within its bound", "[simd][math]") {
  const EachTarget target;
  for (double range : {1.0, 1000.0, 1048575.0}) {
    Columns c;
    c.Fill(-range, range);
    for (int i = 0; i < 64; ++i) c.x[i] = static_cast<float>(i) / 8 - 4;  // the seams
    LANELIGHT_ON(TestTarget(), MapSinCos2Pi)
    (c.x.data(), c.y.data(), c.a.data(), c.b.data(), kCount);
    double error = 0, norm = 0;
    for (int i = 0; i < kCount; ++i) {
      const double turn = c.x[i] - std::floor(static_cast<double>(c.x[i]));
      error = std::max(error, std::abs(c.a[i] - std::sin(2 * kPiD * turn)));
      error = std::max(error, std::abs(c.b[i] - std::cos(2 * kPiD * turn)));
      norm = std::max(norm,
                      std::abs(1. - double(c.a[i]) * c.a[i] - double(c.b[i]) * c.b[i]));
    }
    CHECK(error < 1.2e-7);
    CHECK(norm < 4e-7);
  }
}

TEST_CASE("SinCosOctant stays within its bound", "[simd][math]") {
  const EachTarget target;
  Columns c;
  c.Fill(-0.5, 0.5);
  LANELIGHT_ON(TestTarget(), MapSinCosOctant)
  (c.x.data(), c.y.data(), c.a.data(), c.b.data(), kCount);
  double error = 0;
  for (int i = 0; i < kCount; ++i) {
    error = std::max(error, std::abs(c.a[i] - std::sin(kPiD / 2 * c.x[i])));
    error = std::max(error, std::abs(c.b[i] - std::cos(kPiD / 2 * c.x[i])));
  }
  CHECK(error < 1.2e-7);
}

TEST_CASE("Atan2 and AtanUnit stay within their bounds", "[simd][math]") {
  const EachTarget target;
  Columns c;
  c.Fill(-1, 1);
  for (int i = 0; i < 1000; ++i) {
    c.x[i] *= 1e-6f;
    c.y[1000 + i] *= 1e-6f;
  }
  const float axes[] = {0, 1, -1};
  for (int i = 0; i < 9; ++i) {
    c.x[2000 + i] = axes[i % 3];
    c.y[2000 + i] = axes[i / 3];
  }
  LANELIGHT_ON(TestTarget(), MapAtan2)
  (c.x.data(), c.y.data(), c.a.data(), c.b.data(), kCount);
  double error = 0, unit_error = 0;
  for (int i = 0; i < kCount; ++i) {
    error =
        std::max(error, std::abs(c.a[i] - std::atan2(double(c.y[i]), double(c.x[i]))));
    unit_error = std::max(unit_error, std::abs(c.b[i] - std::atan(double(c.x[i]))));
  }
  CHECK(error < 4e-7);
  CHECK(unit_error < 1.5e-7);
  CHECK(c.a[2000] == 0);  // the origin
}

TEST_CASE("Exp stays within its bound", "[simd][math]") {
  const EachTarget target;
  for (double low : {-87.0, -1.0}) {
    Columns c;
    c.Fill(low, low == -1 ? 1 : 88);
    c.x[0] = 0;
    c.x[1] = -87.5f;
    c.x[2] = -1e30f;
    LANELIGHT_ON(TestTarget(), MapExp)
    (c.x.data(), c.y.data(), c.a.data(), c.b.data(), kCount);
    double error = 0;
    for (int i = 3; i < kCount; ++i) {
      error = std::max(error, std::abs(c.a[i] / std::exp(double(c.x[i])) - 1));
    }
    CHECK(error < 1.5e-7);
    CHECK(c.a[0] == 1);
    CHECK(c.a[1] == 0);
    CHECK(c.a[2] == 0);
  }
}

}  // namespace lanelight
#endif
