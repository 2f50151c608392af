#include "tests/kernels/lights/projected_truth.h"

#include <algorithm>
#include <cmath>

namespace lanelight::test {

double Cosine(Vec3d a, Vec3d b) { return Dot(Normalize(a), Normalize(b)); }

double FartherAlongX(const Flat& f) {
  const auto outside = [&](Vec3d side) {
    const double from = Dot(f.corner, Normalize(side));
    return std::max(from, -from - Length(side));
  };
  return outside(f.x) - outside(f.y);
}

Square Invert(const Flat& f, double a, double b) {
  const Vec3d q = f.At(a, b);
  if (!f.rectangle) {
    const Vec3d v1 = f.At(1, 0), end = f.At(0, b / std::max(1 - a, 1e-12));
    return {TriangleAngle(f.corner, v1, end) / AngleOf(f),
            (1 - Cosine(v1, q)) / (1 - Cosine(v1, end))};
  }
  const bool swap = FartherAlongX(f) > 0;
  const Vec3d side = swap ? f.x : f.y;
  const auto height = [&](double part) {
    const Vec3d on = swap ? f.At(part, b) : f.At(a, part);
    return Cosine(on, side);
  };
  const double low = height(0), high = height(1);
  return {(swap ? PartAngle(f, 0, 0, 1, b) : PartAngle(f, 0, 0, a, 1)) / AngleOf(f),
          (height(swap ? a : b) - low) / (high - low)};
}

CornerCosines::CornerCosines(const Flat& f, Vec3d n) {
  Vec3d at[4] = {f.At(1, 0), f.At(1, 0), f.At(0, 0), f.At(0, 1)};
  if (f.rectangle) {
    const bool swap = FartherAlongX(f) > 0;
    at[0] = f.At(0, 0), at[1] = swap ? f.At(0, 1) : f.At(1, 0);
    at[2] = swap ? f.At(1, 0) : f.At(0, 1), at[3] = f.At(1, 1);
  }
  Vec3d middle;
  for (int i = f.rectangle ? 0 : 1; i < 4; ++i) middle += Normalize(at[i]);
  double maximum = Cosine(n, middle);
  for (int i = 0; i < 4; ++i) maximum = std::max(maximum, w[i] = Cosine(n, at[i]));
  for (double& c : w) c = std::max(c, std::max(maximum / 10, 1e-6));
}

double CornerCosines::Density(Square u) const {
  const double low = w[0] + (w[1] - w[0]) * u.u0, high = w[2] + (w[3] - w[2]) * u.u0;
  return 4 * (low + (high - low) * u.u1) / (w[0] + w[1] + w[2] + w[3]);
}

}  // namespace lanelight::test
