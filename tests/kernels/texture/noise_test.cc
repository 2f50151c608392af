// Noise of every target against the scalar twin, and what must be true of it.
#include "kernels/simd/each_target-inl.h"

#include "kernels/texture/noise-inl.h"

LANELIGHT_BEGIN_KERNELS

// At a multiple of 16 points; planes of x, y, z.
void NoiseAt(const float* xyz, float* value, std::size_t count) {
  const DF df;
  for (std::size_t i = 0; i < count; i += hn::Lanes(df)) {
    const V3 p = {hn::LoadU(df, xyz + i), hn::LoadU(df, xyz + count + i),
                  hn::LoadU(df, xyz + 2 * count + i)};
    hn::StoreU(Noise(p), df, value + i);
  }
}

// Sums of octaves: four of each kind, two planes out.
void OctavesAt(const float* xyz, float* value, std::size_t count) {
  const DF df;
  for (std::size_t i = 0; i < count; i += hn::Lanes(df)) {
    const V3 p = {hn::LoadU(df, xyz + i), hn::LoadU(df, xyz + count + i),
                  hn::LoadU(df, xyz + 2 * count + i)};
    hn::StoreU(FBm(p, 4, 0.6f), df, value + i);
    hn::StoreU(Turbulence(p, 4, 0.6f), df, value + count + i);
  }
}

LANELIGHT_END_KERNELS

#if HWY_ONCE

#include <catch2/catch.hpp>
#include <limits>
#include <random>
#include <vector>

#include "tests/reference/pattern.h"
#include "tests/support/each_target.h"

namespace lanelight {

HWY_EXPORT(NoiseAt);
HWY_EXPORT(OctavesAt);

namespace {

constexpr std::size_t kPoints = 1024;

std::vector<float> RunNoise(const std::vector<float>& xyz) {
  std::vector<float> value(xyz.size() / 3);
  LANELIGHT_ON(TestTarget(), NoiseAt)(xyz.data(), value.data(), value.size());
  return value;
}

std::vector<float> RandomPoints() {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> near(-4, 4), far(-800, 800);
  std::vector<float> xyz(3 * kPoints);
  for (std::size_t i = 0; i < xyz.size(); ++i) {
    xyz[i] = i % 2 == 0 ? near(random) : far(random);
  }
  return xyz;
}

Vec3d PointOf(const std::vector<float>& xyz, std::size_t i) {
  return {xyz[i], xyz[kPoints + i], xyz[2 * kPoints + i]};
}

}  // namespace

TEST_CASE("noise agrees with the sum over the corners of cells", "[noise]") {
  const std::vector<float> xyz = RandomPoints();
  const EachTarget target;
  const std::vector<float> got = RunNoise(xyz);
  double worst = 0, mean = 0;
  for (std::size_t i = 0; i < kPoints; ++i) {
    worst = std::max(worst, std::abs(got[i] - reference::Noise(PointOf(xyz, i))));
    mean += got[i] / kPoints;
  }
  CHECK(worst < 1e-5);
  // Mean 0; the standard deviation of one value is below 0.3: six of the mean's.
  CHECK(std::abs(mean) < 6 * 0.3 / 32);
}

TEST_CASE("noise vanishes on the lattice and has period 256", "[noise]") {
  std::vector<float> xyz(3 * 64);
  for (int i = 0; i < 64; ++i) {
    const bool on_lattice = i < 32;
    for (int k = 0; k < 3; ++k) {
      xyz[k * 64 + i] = on_lattice
                            ? float((i * 37 + k * 11) % 300 - 150)
                            : (i % 16) * 0.375f - 2 + (i >= 48 ? 256 * (k - 1) : 0);
    }
  }
  const EachTarget target;
  const std::vector<float> got = RunNoise(xyz);
  for (int i = 0; i < 32; ++i) CHECK(got[i] == 0);
  for (int i = 32; i < 48; ++i) CHECK(got[i] == Approx(got[i + 16]).margin(1e-6));
}

TEST_CASE("noise of any input is finite or NaN", "[noise]") {
  const float inf = std::numeric_limits<float>::infinity();
  std::vector<float> xyz(3 * 16, 0.5f);
  const float odd[] = {inf, -inf, std::nanf(""), 3e38f, -3e38f, 1e10f, 16777216, 1e-40f};
  for (int i = 0; i < 8; ++i) xyz[i] = odd[i];
  const EachTarget target;
  const std::vector<float> got = RunNoise(xyz);  // must not read outside (asan)
  for (int i = 3; i < 8; ++i) CHECK(std::abs(got[i]) <= 1.5f);
}

TEST_CASE("sums of octaves agree with the reference", "[noise]") {
  const std::vector<float> xyz = RandomPoints();
  std::vector<float> got(2 * kPoints);
  const EachTarget target;
  LANELIGHT_ON(TestTarget(), OctavesAt)(xyz.data(), got.data(), kPoints);
  double fbm = 0, turbulence = 0;
  for (std::size_t i = 0; i < kPoints; ++i) {
    const Vec3d p = PointOf(xyz, i);
    fbm = std::max(fbm, std::abs(got[i] - reference::Fbm(p, 4, 0.6)));
    turbulence =
        std::max(turbulence, std::abs(got[kPoints + i] - reference::Wrinkled(p, 4, 0.6)));
  }
  // A float at 800 * 1.99^3 resolves 5e-4, times slopes of 2 and 0.6^3.
  CHECK(fbm < 1e-3);
  CHECK(turbulence < 1e-3);
}

}  // namespace lanelight

#endif  // HWY_ONCE
