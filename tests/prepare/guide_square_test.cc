// The map between a hemisphere and the square of a guide's cell.
#include "src/prepare/guide_square.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <random>

namespace lanelight {
namespace {

Vec3d RandomUnit(std::mt19937& engine) {
  std::normal_distribution<double> normal;
  return Normalize(Vec3d{normal(engine), normal(engine), normal(engine)});
}

}  // namespace

TEST_CASE("guide square: there and back, about any normal", "[guide]") {
  std::mt19937 engine(1);
  std::uniform_real_distribution<double> uniform;
  for (int i = 0; i < 20'000; ++i) {
    Vec3d n = RandomUnit(engine);
    if (i % 5 == 0)
      n = Vec3d{i % 3 == 0 ? 1.0 : 0, i % 3 == 1 ? -1.0 : 0, i % 3 == 2 ? 1.0 : 0};
    const double u = uniform(engine), v = uniform(engine);
    const Vec3d d = FromGuideSquare(n, u, v);
    CHECK(Length(d) == Approx(1).epsilon(1e-12));
    CHECK(Dot(d, n) >= 0);
    const GuideSquarePoint at = ToGuideSquare(n, d);
    CHECK(at.u == Approx(u).margin(1e-7));
    CHECK(at.v == Approx(v).margin(1e-7));
    CHECK(at.cosine == Approx(Dot(d, n)).margin(1e-12));
    // Mirrored at the surface: the same point, nothing of a density.
    const GuideSquarePoint below = ToGuideSquare(n, d - n * (2 * Dot(d, n)));
    CHECK(below.u == Approx(u).margin(1e-7));
    CHECK(below.to_solid_angle <= 0);
  }
}

TEST_CASE("guide square: its factor is the ratio of areas", "[guide]") {
  // A small quadrilateral of the square, and the solid angle of its image.
  std::mt19937 engine(2);
  std::uniform_real_distribution<double> uniform(0.01, 0.99);
  const Vec3d n = RandomUnit(engine);
  constexpr double kSize = 1e-4;
  for (int i = 0; i < 2000; ++i) {
    const double u = uniform(engine), v = uniform(engine);
    if (std::abs(std::abs(2 * u - 1) - std::abs(2 * v - 1)) < 4 * kSize) continue;
    const Vec3d d = FromGuideSquare(n, u, v);
    const Vec3d du = FromGuideSquare(n, u + kSize, v) - FromGuideSquare(n, u - kSize, v);
    const Vec3d dv = FromGuideSquare(n, u, v + kSize) - FromGuideSquare(n, u, v - kSize);
    const double solid_angle = Length(Cross(du, dv)) / (16 * kSize * kSize);
    CHECK(ToGuideSquare(n, d).to_solid_angle * solid_angle == Approx(1).epsilon(1e-3));
  }
}

TEST_CASE("guide square: even masses are the cosine's", "[guide]") {
  std::mt19937 engine(3);
  std::uniform_real_distribution<double> uniform;
  std::vector<double> counts(kGuideSquares);
  constexpr int kSamples = 1 << 20;
  for (int i = 0; i < kSamples; ++i) {
    const double r = std::sqrt(uniform(engine)), z = std::sqrt(1 - r * r);
    const double phi = 2 * std::numbers::pi * uniform(engine);
    const auto at = ToGuideSquare({0, 0, 1}, {r * std::cos(phi), r * std::sin(phi), z});
    const auto x = static_cast<std::size_t>(at.u * kGuideGrid);
    const auto y = static_cast<std::size_t>(at.v * kGuideGrid);
    counts[y * kGuideGrid + x] += 1.0 / kSamples;
  }
  double sum = 0;
  for (std::size_t s = 0; s < kGuideSquares; ++s) {
    const double mass = CosineMasses()[s];
    sum += mass;
    // 6 standard errors: false alarms 2e-9 for each of 256.
    CHECK(std::abs(counts[s] - mass) < 6 * std::sqrt(mass / kSamples));
  }
  CHECK(sum == Approx(1));
}

}  // namespace lanelight
