#include "src/prepare/guide_horizon.h"

#include <algorithm>
#include <array>

#include "src/image/octahedral.h"

namespace lanelight {
namespace {

// Length of the mean of the normals, at least: cos 25 degrees.
constexpr double kFlat = 0.9;
// Share of the records that may go behind: shading normals send a few there.
constexpr double kMostBehind = 0.01;
// Cosine between normal and the middle of a square, below which nothing, and above which
// all of it is left: a square is about 6 degrees wide, and the cell is bent a little.
constexpr double kNothing = -0.1, kAll = 0.05;

const std::array<Vec3d, kGuideSquares>& Middles() {
  static const std::array<Vec3d, kGuideSquares> middles = [] {
    std::array<Vec3d, kGuideSquares> all;
    for (std::size_t s = 0; s < kGuideSquares; ++s) {
      all[s] = OctahedralToDirection((double(s % kGuideGrid) + 0.5) / kGuideGrid,
                                     (double(s / kGuideGrid) + 0.5) / kGuideGrid);
    }
    return all;
  }();
  return middles;
}

Vec3d Direction(const GuideRecord& r) {
  return Middles()[(std::size_t{r.v} >> 11) * kGuideGrid + (std::size_t{r.u} >> 11)];
}

}  // namespace

void LeaveOutBehind(std::span<const GuideRecord> records,
                    std::span<double, kGuideSquares> masses) {
  Vec3d sum;
  double behind = 0;
  for (const GuideRecord& r : records) {
    const Vec3d n = VecCast<double>(r.normal);
    sum += n;
    behind += Dot(n, Direction(r)) < kNothing ? 1 : 0;
  }
  const double count = double(records.size());
  if (records.empty() || behind > kMostBehind * count || Length(sum) < kFlat * count) {
    return;
  }
  const Vec3d normal = Normalize(sum);
  for (std::size_t s = 0; s < kGuideSquares; ++s) {
    const double cosine = Dot(normal, Middles()[s]);
    masses[s] *= std::clamp((cosine - kNothing) / (kAll - kNothing), 0.0, 1.0);
  }
}

}  // namespace lanelight
