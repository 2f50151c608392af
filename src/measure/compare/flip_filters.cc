#include "src/measure/compare/flip_filters.h"

#include <algorithm>
#include <cmath>

#include "src/base/core/parallel.h"

namespace lanelight {
namespace {

constexpr std::size_t kRowsOfTask = 16;

int Radius(const Kernel& kernel) { return int(kernel.size() / 2); }

void AddScaled(const float* in, float weight, int count, float* out) {
  for (int i = 0; i < count; ++i) out[i] += weight * in[i];
}

// CIE 15: cube root, linear near black.
double LabCurve(double t) {
  constexpr double kDelta = 6.0 / 29;
  return t > kDelta * kDelta * kDelta ? std::cbrt(t)
                                      : t / (3 * kDelta * kDelta) + 4.0 / 29;
}

}  // namespace

Plane ConvolveRows(const Plane& in, int width, int height, const Kernel& kernel) {
  const int radius = Radius(kernel);
  Plane out(in.size(), 0.0f);
  ParallelForRange(height, kRowsOfTask, [&](std::size_t begin, std::size_t end) {
    std::vector<float> row(std::size_t(width) + 2 * radius);
    for (std::size_t y = begin; y < end; ++y) {
      const float* source = in.data() + y * width;
      std::fill_n(row.begin(), radius, source[0]);
      std::copy_n(source, width, row.begin() + radius);
      std::fill_n(row.end() - radius, radius, source[width - 1]);
      for (std::size_t k = 0; k < kernel.size(); ++k) {
        AddScaled(row.data() + k, kernel[k], width, out.data() + y * width);
      }
    }
  });
  return out;
}

Plane ConvolveColumns(const Plane& in, int width, int height, const Kernel& kernel) {
  const int radius = Radius(kernel);
  Plane out(in.size(), 0.0f);
  ParallelForRange(height, kRowsOfTask, [&](std::size_t begin, std::size_t end) {
    for (int y = int(begin); y < int(end); ++y) {
      float* target = out.data() + std::size_t(y) * width;
      for (int k = -radius; k <= radius; ++k) {
        const std::size_t from = std::clamp(y + k, 0, height - 1);
        AddScaled(in.data() + from * width, kernel[k + radius], width, target);
      }
    }
  });
  return out;
}

OpponentColors::OpponentColors() : relative_(XyzFromSrgb()) {
  for (Vec3d& row : relative_.row) row = row / (row.x + row.y + row.z);
  inverse_ = Inverse(relative_);
}

Vec3d OpponentColors::FromRgb(Vec3d rgb) const {
  const Vec3d xyz = relative_ * rgb;
  return {xyz.y, xyz.x - xyz.y, xyz.y - xyz.z};
}

Vec3d OpponentColors::ToRgb(Vec3d opponent) const {
  const double y = opponent.x;
  return inverse_ * Vec3d{y + opponent.y, y, y - opponent.z};
}

Vec3d OpponentColors::HuntLab(Vec3d rgb) const {
  const Vec3d xyz = relative_ * rgb;
  const double x = LabCurve(xyz.x), y = LabCurve(xyz.y), z = LabCurve(xyz.z);
  const double lightness = 116 * y - 16;
  return {lightness, 0.01 * lightness * 500 * (x - y), 0.01 * lightness * 200 * (y - z)};
}

double HyAb(Vec3d a, Vec3d b) {
  const Vec3d d = a - b;
  return std::abs(d.x) + std::hypot(d.y, d.z);
}

}  // namespace lanelight
