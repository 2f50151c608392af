// The octahedral map is a bijection, preserves area, and is oriented as in pbrt-v4.
#include "src/base/image/octahedral.h"

#include <catch2/catch.hpp>
#include <random>

namespace lanelight {

TEST_CASE("square to sphere and back is the identity", "[image][octahedral]") {
  const int n = 257;
  double worst = 0;
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; j <= n; ++j) {
      const double u = (i + 0.5) / (n + 1), v = (j + 0.5) / (n + 1);
      const Vec3d d = OctahedralToDirection(u, v);
      CHECK(std::abs(Length(d) - 1) < 1e-14);
      const auto [u2, v2] = DirectionToOctahedral(d);
      worst = std::max({worst, std::abs(u - u2), std::abs(v - v2)});
    }
  }
  CHECK(worst < 1e-13);
}

TEST_CASE("sphere to square and back is the identity", "[image][octahedral]") {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  double worst = 0;
  for (int i = 0; i < 100000; ++i) {
    Vec3d d = Normalize(Vec3d{normal(random), normal(random), normal(random)});
    if (i % 4 == 0) d = Normalize(Vec3d{d.x * 1e-9, d.y * 1e-9, d.z});  // near the poles
    if (i % 4 == 1) d = Normalize(Vec3d{d.x, d.y, d.z * 1e-9});  // near the equator
    const auto [u, v] = DirectionToOctahedral(d);
    CHECK((u >= 0 && u <= 1 && v >= 0 && v <= 1));
    worst = std::max(worst, Length(OctahedralToDirection(u, v) - d));
  }
  CHECK(worst < 1e-7);  // the corners are singular: -z loses half the digits
}

TEST_CASE("poles, axes and corners agree with pbrt", "[image][octahedral]") {
  const auto near = [](Vec3d a, Vec3d b) { return Length(a - b) < 1e-12; };
  CHECK(near(OctahedralToDirection(0.5, 0.5), {0, 0, 1}));
  CHECK(near(OctahedralToDirection(1, 0.5), {1, 0, 0}));
  CHECK(near(OctahedralToDirection(0, 0.5), {-1, 0, 0}));
  CHECK(near(OctahedralToDirection(0.5, 1), {0, 1, 0}));
  CHECK(near(OctahedralToDirection(0.5, 0), {0, -1, 0}));
  for (double u : {0.0, 1.0}) {
    for (double v : {0.0, 1.0}) CHECK(near(OctahedralToDirection(u, v), {0, 0, -1}));
  }
  // On the diagonal inside the upper half: azimuth 45 degrees, z = 1 - ring^2.
  CHECK(near(OctahedralToDirection(0.625, 0.625),
             {std::sqrt((1 - 0.75 * 0.75) / 2), std::sqrt((1 - 0.75 * 0.75) / 2), 0.75}));
}

TEST_CASE("equal areas of the square are equal solid angles", "[image][octahedral]") {
  // Solid angle of a small quadrilateral, by its two triangles, against 4 pi * area.
  const int n = 64;
  const double h = 1e-5;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const double u = (i + 0.37) / n, v = (j + 0.59) / n;
      const Vec3d a = OctahedralToDirection(u, v), b = OctahedralToDirection(u + h, v),
                  c = OctahedralToDirection(u, v + h),
                  d = OctahedralToDirection(u + h, v + h);
      const double area = (Length(Cross(b - a, c - a)) + Length(Cross(b - d, c - d))) / 2;
      CHECK(area == Approx(4 * std::numbers::pi * h * h).epsilon(2e-3));
    }
  }
}

}  // namespace lanelight
