// Every warp against its density (chi-square), and its mean.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "tests/kernels/probe/math_probe.h"
#include "src/base/stat/hypothesis.h"
#include "tests/base/stat/chi2.h"
#include "tests/support/each_target.h"

namespace lanelight {

namespace {

constexpr int kCount = 1 << 16;
constexpr double kPiD = std::numbers::pi;

struct DrawnPoints {
  std::vector<float> u0, u1, x, y, z, pdf;
  explicit DrawnPoints(WarpId id) {
    for (auto* v : {&u0, &u1, &x, &y, &z, &pdf}) v->resize(kCount);
    std::mt19937_64 engine(11);
    for (int i = 0; i < kCount; ++i) {
      u0[i] = static_cast<float>(engine() >> 40) * 0x1p-24f;
      u1[i] = static_cast<float>(engine() >> 40) * 0x1p-24f;
    }
    u0[0] = u1[0] = u0[1] = u1[2] = 0;  // corners
    u1[1] = u0[2] = u0[3] = u1[3] = 1 - 0x1p-24f;
    ProbeWarp(TestTarget(), id,
              {kCount, u0.data(), u1.data(), x.data(), y.data(), z.data(), pdf.data()});
  }
};

// Probability of the cell [a0,a1) x [b0,b1) of the coordinates that Cell() below uses,
// by midpoints of the analytic density.
struct Coordinates {
  double a, b;  // in [0, 1)
};
Coordinates Locate(WarpId id, double x, double y, double z) {
  const double turn = std::atan2(y, x) / (2 * kPiD), t = turn < 0 ? turn + 1 : turn;
  switch (id) {
    case WarpId::kDisk:
      return {(x + 1) / 2, (y + 1) / 2};
    default:
      return {z, t};
  }
}
// Density in those coordinates, from first principles.
double Density(WarpId id, double a, double b) {
  switch (id) {
    case WarpId::kDisk: {
      const double x = 2 * a - 1, y = 2 * b - 1;
      return x * x + y * y < 1 ? 4 / kPiD : 0;
    }
    case WarpId::kCosine:
      return 2 * a;
    case WarpId::kInSphere:
      return 4 * a * a * a;
    default:
      return 1;
  }
}

double PValue(WarpId id, WarpId density) {
  const DrawnPoints p(id);
  constexpr int kCells = 12, kSub = 40;
  std::vector<double> observed(kCells * kCells, 0), expected(kCells * kCells, 0);
  for (int i = 0; i < kCount; ++i) {
    const Coordinates c = Locate(id, p.x[i], p.y[i], p.z[i]);
    const int a = std::clamp(static_cast<int>(c.a * kCells), 0, kCells - 1);
    const int b = std::clamp(static_cast<int>(c.b * kCells), 0, kCells - 1);
    observed[a * kCells + b] += 1;
  }
  constexpr int kFine = kCells * kSub;
  for (int i = 0; i < kFine * kFine; ++i) {
    const double a = (i / kFine + 0.5) / kFine, b = (i % kFine + 0.5) / kFine;
    expected[(i / kFine / kSub) * kCells + i % kFine / kSub] +=
        kCount * Density(density, a, b) / (double(kFine) * kFine);
  }
  return stat::ChiSquareTest(observed, expected).p;
}

}  // namespace

TEST_CASE("warps follow their densities", "[warp][stat]") {
  const auto targets = AvailableTargets();
  const double level =
      stat::SidakLevel(1e-3, static_cast<int>(targets.size() * std::size(kWarpIds)));
  const EachTarget target;
  for (WarpId id : kWarpIds) {
    INFO("warp " << static_cast<int>(id));
    CHECK(PValue(id, id) > level);
  }
  // Wrong densities are noticed.
  CHECK(PValue(WarpId::kCosine, WarpId::kUniformHemisphere) < 1e-9);
  CHECK(PValue(WarpId::kInSphere, WarpId::kCosine) < 1e-9);
}

TEST_CASE("the densities of warps are the stated ones", "[warp]") {
  const EachTarget target;
  for (WarpId id : kWarpIds) {
    const DrawnPoints p(id);
    double density = 0, length = 0;
    for (int i = 0; i < kCount; ++i) {
      const double z = p.z[i];
      double want = 0;
      switch (id) {
        case WarpId::kDisk:
          want = 1 / kPiD;
          break;
        case WarpId::kCosine:
          want = z / kPiD;
          break;
        case WarpId::kInSphere:
          want = 2 * z * z * z / kPiD;
          break;
        case WarpId::kUniformHemisphere:
          want = 1 / (2 * kPiD);
          break;
      }
      density = std::max(density, std::abs(p.pdf[i] / want - 1));
      if (id != WarpId::kDisk) {
        const double n =
            std::sqrt(double(p.x[i]) * p.x[i] + double(p.y[i]) * p.y[i] + z * z);
        length = std::max(length, std::abs(n - 1));
      }
    }
    INFO("warp " << static_cast<int>(id));
    CHECK(density < 1e-5);
    CHECK(length < 1e-6);
  }
}

TEST_CASE("warps of extreme random numbers are unit directions with densities",
          "[warp]") {
  constexpr float kEnds[] = {
      0,    0x1p-24f,        0x1p-12f, 0.25f,        0.5f - 0x1p-24f,
      0.5f, 0.5f + 0x1p-24f, 0.75f,    1 - 0x1p-12f, 1 - 0x1p-24f};
  constexpr std::size_t kSide = std::size(kEnds), kPairs = kSide * kSide;
  for (const std::string& target : AvailableTargets()) {
    for (WarpId id : kWarpIds) {
      std::vector<std::vector<float>> v(6,
                                        std::vector<float>(kPairs + kMathPadding, 0.5f));
      for (std::size_t i = 0; i < kPairs; ++i) {
        v[0][i] = kEnds[i % kSide];
        v[1][i] = kEnds[i / kSide];
      }
      ProbeWarp(SimdTarget(target), id,
                {static_cast<int>(kPairs), v[0].data(), v[1].data(), v[2].data(),
                 v[3].data(), v[4].data(), v[5].data()});
      int bad = 0;
      for (std::size_t i = 0; i < kPairs; ++i) {
        const double length = std::hypot(v[2][i], v[3][i], v[4][i]);
        const bool place = id == WarpId::kDisk
                               ? length < 1 + 1e-6
                               : std::abs(length - 1) < 1e-3 && v[4][i] > 0;
        bad += !(place && v[5][i] > 0 && std::isfinite(v[5][i]));
      }
      INFO(target << " warp " << static_cast<int>(id));
      CHECK(bad == 0);
    }
  }
}

TEST_CASE("mean cosines of the diffuse models", "[warp]") {
  const struct {
    WarpId id;
    double mean, second;  // of cos and cos^2, for the standard error
  } models[] = {{WarpId::kCosine, 2. / 3, 1. / 2},
                {WarpId::kUniformHemisphere, 1. / 2, 1. / 3},
                {WarpId::kInSphere, 4. / 5, 2. / 3}};
  const EachTarget target;
  for (const auto& m : models) {
    const DrawnPoints p(m.id);
    double sum = 0;
    float lowest = 1;
    for (float z : p.z) {
      sum += z;
      lowest = std::min(lowest, z);
    }
    const double error = std::sqrt((m.second - m.mean * m.mean) / kCount);
    INFO("warp " << static_cast<int>(m.id));
    CHECK(std::abs(sum / kCount - m.mean) < 4.5 * error);
    CHECK(lowest > 0);
  }
}

}  // namespace lanelight
