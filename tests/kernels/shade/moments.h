// Moments of what materials scatter, compared between the shading kernels and the scalar
// reference.
#pragma once

#include <algorithm>
#include <cstdint>

#include "src/base/stat/hypothesis.h"
#include "tests/kernels/shade/probe_batch.h"

namespace lanelight::test {

inline constexpr int kMoments = 4;

/// Sums of weights times bounded functions of the direction; together the functions see
/// sides, tilt and spread.
struct Sums {
  double n = 0, sum[kMoments][3] = {}, squares[kMoments][3] = {};

  void Add(Rgb weight, Vec3d w) {
    n += 1;
    if (weight == Rgb{}) return;
    const double shapes[kMoments] = {1, w.z, w.z * w.z, w.x + 0.5 * w.y * w.z};
    for (int m = 0; m < kMoments; ++m) {
      for (int c = 0; c < 3; ++c) {
        const double v = weight[c] == 0 ? 0 : weight[c] * shapes[m];
        sum[m][c] += v;
        squares[m][c] += v * v;
      }
    }
  }
  stat::MeanEstimate Estimate(int m, int c) const {
    const double mean = sum[m][c] / n;
    return {mean, std::max(0., squares[m][c] / n - mean * mean) / (n - 1), n - 1};
  }
};

/// Returns the sums of 2^15 samples of the scalar reference.
inline Sums ReferenceSums(const TestMaterial& material, Vec3d wo) {
  reference::Random random(37);
  Sums sums;
  for (std::uint32_t i = 0; i < 1 << 15; ++i) {
    const auto sample = reference::SampleBsdf(material.local, wo, random);
    sums.Add(sample ? sample->weight : Rgb{}, sample ? sample->wi : Vec3d{0, 0, 1});
  }
  return sums;
}

/// Returns the smallest p-value over moments and channels. Differences of 0.002 do not
/// count: they come from tables and single precision.
inline double LowestP(const Sums& a, const Sums& b) {
  double lowest = 1;
  for (int m = 0; m < kMoments; ++m) {
    for (int c = 0; c < 3; ++c) {
      const double p = stat::WelchPValue(a.Estimate(m, c), b.Estimate(m, c), 2e-3);
      lowest = std::min(lowest, p);
    }
  }
  return lowest;
}

}  // namespace lanelight::test
