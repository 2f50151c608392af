// Motions between two transforms, against quaternions.
#include "src/base/core/motion.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "tests/reference/snapshot.h"

namespace lanelight {
namespace {

class Numbers {
 public:
  double operator()(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }
  Vec3d Vector(double size) {
    return {(*this)(-size, size), (*this)(-size, size), (*this)(-size, size)};
  }
  // With shear, mirrored or not, turned any way.
  Transform Any(bool mirrored) {
    const auto turn = [&] { return Transform::Rotate((*this)(0, 360), Vector(1)); };
    const double side = mirrored ? -1 : 1;
    const Vec3d scale = {(*this)(0.2, 3), side * (*this)(0.2, 3), (*this)(0.2, 3)};
    return Transform::Translate(Vector(5)) * turn() * Transform::Scale(scale) * turn();
  }

 private:
  std::mt19937 engine_{7};
};

double FarthestEntry(const Transform& a, const Transform& b) {
  double maximum = 0;
  for (int i = 0; i < 16; ++i) {
    maximum = std::max(maximum, std::abs(a(i / 4, i % 4) - b(i / 4, i % 4)));
  }
  return maximum;
}

}  // namespace

TEST_CASE("motions agree with quaternion interpolation", "[core]") {
  Numbers random;
  for (int i = 0; i < 300; ++i) {
    const bool mirrored = i % 3 == 0;
    const Transform start = random.Any(mirrored), end = random.Any(mirrored);
    const Motion motion(start, end);
    INFO(i);
    CHECK(FarthestEntry(motion.At(0), start) < 1e-12);
    CHECK(FarthestEntry(motion.At(1), end) < 1e-9);
    for (const double s : {0.1, 0.5, 0.8}) {
      CHECK(FarthestEntry(motion.At(s), reference::Interpolate(start, end, s)) < 1e-8);
    }
  }
}

TEST_CASE("a rotation takes the shorter way at constant speed", "[core]") {
  const Vec3d axis = {0.6, 0, 0.8};
  for (const double degrees : {1e-7, 30.0, 179.9, 180.0}) {
    INFO(degrees);
    const Motion motion({}, Transform::Rotate(degrees, axis));
    for (const double s : {0.25, 0.5, 1.0}) {
      CHECK(FarthestEntry(motion.At(s), Transform::Rotate(s * degrees, axis)) < 1e-7);
    }
  }
  const Motion motion({}, Transform::Rotate(200, axis));
  CHECK(FarthestEntry(motion.At(0.5), Transform::Rotate(-80, axis)) < 1e-12);
  // What does not turn has ways that are straight, exactly.
  const Motion straight(Transform::Scale({1, 2, 3}), Transform::Scale({2, 2, 2}));
  CHECK(straight.angle == 0);
  CHECK(straight.Parts() == 1);
  CHECK(straight.Deviation(1) == 0);
}

TEST_CASE("within a part, points stay close to the straight line", "[core]") {
  Numbers random;
  double closest = 1e300;
  for (int i = 0; i < 100; ++i) {
    Motion motion(random.Any(false), random.Any(false));
    if (i % 2 != 0) motion.pivot = random.Vector(3);
    const double reach = random(0.1, 4), deviation = motion.Deviation(reach);
    const Vec3d p = random.Vector(reach);
    for (int part = 0; part < motion.Parts(); ++part) {
      const double step = 1.0 / motion.Parts();
      const Vec3d a = motion.At(part * step).Point(p);
      const Vec3d b = motion.At((part + 1) * step).Point(p);
      for (const double t : {0.3, 0.5}) {
        const Vec3d q = motion.At((part + t) * step).Point(p);
        const double off = Length(q - (a * (1 - t) + b * t));
        REQUIRE(off <= deviation);
        closest = std::min(closest, deviation / off);
      }
    }
  }
  // The bound means something: it is within some factor of what happens.
  CHECK(closest < 20);
}

}  // namespace lanelight
