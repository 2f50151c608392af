// Random numbers at the ends of their range, and sample points far along.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <vector>

#include "kernels/probe/points_probe.h"
#include "kernels/probe/warp_probe.h"
#include "src/measure/stress/cases/cases.h"
#include "src/measure/stress/cases/points.h"
#include "src/measure/stress/cases/scene_text.h"
#include "src/vocabulary/path/dimensions.h"
#include "src/vocabulary/strategy/choice_names.h"

namespace lanelight::stress {
namespace {

constexpr std::uint32_t kCount = 4096, kRoom = 64;

// Points of a sampler: outside of [0, 1) is a failure, and so is a mean that is off by
// more than six deviations of independent points (false alarms: 2e-9 each).
Point Check(const std::string& series, SimdTarget target, const PointsQuery& query) {
  std::vector<float> u0(kCount + kRoom), u1(kCount + kRoom);
  ProbePoints(target, query, u0.data(), u1.data());
  std::uint64_t failures = 0;
  std::array<double, 2> sum{};
  for (std::uint32_t i = 0; i < kCount; ++i) {
    failures += !(u0[i] >= 0 && u0[i] < 1) + !(u1[i] >= 0 && u1[i] < 1);
    sum[0] += u0[i];
    sum[1] += u1[i];
  }
  for (double s : sum) {
    failures += !(std::abs(s / kCount - 0.5) < 6 / std::sqrt(12.0 * kCount));
  }
  return Named(series, NoFailures(failures, 2 * kCount + 2));
}

std::vector<Point> BySample(double sample, const Effort& effort) {
  std::vector<Point> points;
  for (int i = 0; i < kNumPoints; ++i) {
    // The last block ends at 2^31: what comes later begins again under another seed.
    const auto first = static_cast<std::uint32_t>(std::min(sample, 0x1p31 - kCount));
    points.push_back(
        Check(kPointsNames[i], effort.target,
              {static_cast<Points>(i), static_cast<std::uint32_t>(effort.seed), 7, 3,
               first, kCount}));
  }
  return points;
}

std::vector<Point> ByPixel(double pixel, const Effort& effort) {
  std::vector<Point> points;
  for (int i = 0; i < kNumPoints; ++i) {
    const auto at = static_cast<std::uint32_t>(std::min(pixel, 0x1p32 - 1));
    points.push_back(Check(kPointsNames[i], effort.target,
                           {static_cast<Points>(i),
                            static_cast<std::uint32_t>(effort.seed), at, 3, 5, kCount}));
  }
  return points;
}

std::vector<Point> ByDepth(double depth, const Effort& effort) {
  std::vector<Point> points;
  const std::uint32_t key = static_cast<std::uint32_t>(depth) << kDepthShift;
  for (int i = 0; i < kNumPoints; ++i) {
    points.push_back(
        Check(kPointsNames[i], effort.target,
              {static_cast<Points>(i), static_cast<std::uint32_t>(effort.seed), 11,
               key + static_cast<std::uint32_t>(Dimension::kBsdf), 0, kCount}));
  }
  return points;
}

// All pairs of numbers at the ends and in the middle.
std::vector<float> Ends() {
  return {0,    0x1p-24f,        0x1p-12f, 0.25f,        0.5f - 0x1p-24f,
          0.5f, 0.5f + 0x1p-24f, 0.75f,    1 - 0x1p-12f, 1 - 0x1p-24f};
}

// Finite, of length 1 (on the disk: at most), above the ground, with a density.
bool Good(WarpId id, double x, double y, double z, double pdf) {
  const double length = std::sqrt(x * x + y * y + z * z);
  const bool place =
      id == WarpId::kDisk ? length < 1 + 1e-6 : std::abs(length - 1) < 1e-3 && z > 0;
  return place && pdf > 0 && std::isfinite(pdf);
}

std::vector<Point> Warps(double, const Effort& effort) {
  const std::vector<float> ends = Ends();
  const std::size_t n = ends.size() * ends.size();
  std::vector<Point> points;
  const char* names[] = {"disk", "cosine", "uniform hemisphere", "in sphere"};
  for (WarpId id : kWarpIds) {
    std::vector<std::vector<float>> v(8, std::vector<float>(n + kWarpPadding, 0.5f));
    for (std::size_t i = 0; i < n; ++i) {
      v[0][i] = ends[i % ends.size()];
      v[1][i] = ends[i / ends.size()];
    }
    ProbeWarp(effort.target, id,
              {static_cast<int>(n), v[0].data(), v[1].data(), v[2].data(), v[3].data(),
               v[4].data(), v[5].data(), v[6].data(), v[7].data()});
    std::uint64_t failures = 0;
    for (std::size_t i = 0; i < n; ++i) {
      failures += !Good(id, v[2][i], v[3][i], v[4][i], v[5][i]);
    }
    points.push_back(Named(names[static_cast<int>(id)], NoFailures(failures, n)));
  }
  return points;
}

}  // namespace

void AddSampleCases(std::vector<Case>& cases) {
  const CaseAdder add{cases, "sampling", Truth::kRate};
  add({"points-by-sample", "samples up to number 2^31 of every sampler",
       "numbers in [0, 1) with mean 1/2",
       LogAxis("sample", "", {0, 0x1p31}, {1, 1e3, 1e5, 1e7, 0x1p31}, Decades(0, 9)),
       BySample});
  add({"points-by-pixel", "pixels up to number 2^32 - 1, every sampler",
       "numbers in [0, 1) with mean 1/2",
       LogAxis("pixel", "", {0, 0x1p32}, {1, 65535, 65536, 0x1p32}), ByPixel});
  add({"points-by-depth", "dimensions of events 1 to 2^20, every sampler",
       "numbers in [0, 1) with mean 1/2",
       LogAxis("event", "", {0, 0x1p20}, {1, 100, 1e4, 0x1p20 - 1}), ByDepth});
  add({"warps-at-ends",
       "random numbers 0, 2^-24, 1/2 and 1 - 2^-24 in every sampling routine",
       "finite unit directions above the ground, with densities",
       {},
       Warps});
}

}  // namespace lanelight::stress
