#include "src/measure/compare/convolve.h"

#include <algorithm>

#include "src/base/core/parallel.h"

namespace lanelight {
namespace {

constexpr std::size_t kRowsOfTask = 16;

int Radius(const Kernel& kernel) { return static_cast<int>(kernel.size() / 2); }

void AddScaled(const float* in, float weight, int count, float* out) {
  for (int i = 0; i < count; ++i) out[i] += weight * in[i];
}

}  // namespace

Plane ConvolveRows(const Plane& in, int width, int height, const Kernel& kernel) {
  const int radius = Radius(kernel);
  Plane out(in.size(), 0.0f);
  ParallelForRange(height, kRowsOfTask, [&](std::size_t begin, std::size_t end) {
    std::vector<float> row(static_cast<std::size_t>(width) + 2 * radius);
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
    for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y) {
      float* target = out.data() + static_cast<std::size_t>(y) * width;
      for (int k = -radius; k <= radius; ++k) {
        const std::size_t from = std::clamp(y + k, 0, height - 1);
        AddScaled(in.data() + from * width, kernel[k + radius], width, target);
      }
    }
  });
  return out;
}

}  // namespace lanelight
