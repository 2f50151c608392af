#include "src/render/wave/shared_samples.h"

#include <algorithm>
#include <cmath>

#include "src/base/core/check.h"
#include "src/render/wave/light_paths.h"
#include "src/scene/compiled/scene.h"
#include "src/scene/prepare/prepared_scene.h"
#include "src/vocabulary/path/run_parameters.h"

namespace lanelight {
namespace {

constexpr int kSize = CompiledFilter::kSize;

}  // namespace

SampleSharing::Axis::Axis(float radius, bool is_box, const AlignedVector<float>& cdf,
                          const AlignedVector<float>& signs)
    : bins_per_pixel(kSize / (2 * radius)),
      reach(std::max(0, int(std::ceil(2 * radius)) - 1)) {
  for (std::size_t i = 0; i < kSize; ++i) {
    mass[i] = is_box ? 1.0f : (cdf[i + 1] - cdf[i]) * signs[i];
  }
}

// Where the filter is negative, so is the weight of the sample that it has drawn.
void SampleSharing::Axis::WeightsAt(float place, int low, int high, std::size_t step,
                                    float* out) const {
  const auto mass_at = [&](int pixel) {
    const float bin = place - float(pixel) * bins_per_pixel;
    return bin >= 0 && bin < kSize ? mass[std::size_t(bin)] : 0.0f;
  };
  float sum = 0;
  for (int k = -reach; k <= reach; ++k) {
    const float own = k >= low && k <= high ? mass_at(k) : 0.0f;
    out[std::size_t(k + reach) * step] = own;
    sum += std::abs(own);
  }
  const float scale = sum > 0 ? std::copysign(1 / sum, mass_at(0)) : 0;
  for (std::size_t k = 0; k < taps(); ++k) out[k * step] *= scale;
}

SampleSharing::SampleSharing(const CompiledFilter& filter)
    : x_(filter.x_radius, filter.is_box, filter.x_cdf, filter.x_sign),
      y_(filter.y_radius, filter.is_box, filter.y_cdf, filter.y_sign) {}

// Pixels whose reach ends within the tile have the weights of any other one.
void SampleSharing::Prepare(int pixels, std::uint32_t count, const float* places,
                            Axis& axis) {
  const std::size_t each = axis.taps() * count;
  axis.weights.resize(std::size_t(pixels) * each);
  for (int pixel = 0; pixel < pixels; ++pixel) {
    float* const out = &axis.weights[std::size_t(pixel) * each];
    if (pixel > axis.reach && pixel + axis.reach < pixels) {
      std::copy_n(out - each, each, out);
      continue;
    }
    for (std::uint32_t i = 0; i < count; ++i) {
      axis.WeightsAt(places[i], -pixel, pixels - 1 - pixel, count, out + i);
    }
  }
}

void SampleSharing::ShareLine(const Axis& axis, std::uint32_t count, const Line& line) {
  for (int pixel = 0; pixel < line.pixels; ++pixel) {
    const float* const from = line.from + std::size_t(pixel) * line.step;
    const float* weights = &axis.weights[std::size_t(pixel) * axis.taps() * count];
    for (int k = -axis.reach; k <= axis.reach; ++k, weights += count) {
      if (pixel + k < 0 || pixel + k >= line.pixels) continue;
      float* const to = line.to + std::size_t(pixel + k) * line.step;
      for (std::uint32_t i = 0; i < count; ++i) to[i] += weights[i] * from[i];
    }
  }
}

void SampleSharing::FindPlaces(const TilePlanes& planes) {
  const std::vector<std::uint32_t>& pixels = planes.pixels;
  row_order_.resize(pixels.size());
  for (std::size_t i = 0; i < pixels.size(); ++i) row_order_[i] = std::uint32_t(i);
  std::ranges::sort(row_order_, {}, [&](std::uint32_t place) { return pixels[place]; });
  row_position_.resize(pixels.size());
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    row_position_[row_order_[i]] = std::uint32_t(i);
  }
}

void SampleSharing::Share(const TilePlanes& planes, const float* places) {
  const int width = planes.tile.width(), height = planes.tile.height();
  const std::uint32_t count = planes.count;
  LL_CHECK_EQ(planes.pixels.size(), std::size_t(planes.tile.pixels()));
  FindPlaces(planes);
  Prepare(width, count, places, x_);
  Prepare(height, count, places + count, y_);
  const std::size_t size = planes.pixels.size() * count;
  const std::size_t row = std::size_t(width) * count;
  for (std::size_t c = 0; c < kColorPlanes; ++c) {
    float* const values = planes.values + c * planes.stride;
    rows_.resize(size);
    for (std::size_t i = 0; i < row_order_.size(); ++i) {
      std::copy_n(values + std::size_t{row_order_[i]} * count, count, &rows_[i * count]);
    }
    along_x_.assign(size, 0.0f);
    for (int y = 0; y < height; ++y) {
      const std::size_t first = std::size_t(y) * row;
      ShareLine(x_, count, {&rows_[first], &along_x_[first], count, width});
    }
    std::ranges::fill(rows_, 0.0f);
    for (int x = 0; x < width; ++x) {
      const std::size_t first = std::size_t(x) * count;
      ShareLine(y_, count, {&along_x_[first], &rows_[first], row, height});
    }
    for (std::size_t i = 0; i < row_order_.size(); ++i) {
      std::copy_n(&rows_[i * count], count, values + std::size_t{row_order_[i]} * count);
    }
  }
}

void SampleSharing::Add(const TilePlanes& planes, const Target& of, float x, float y,
                        const std::array<double, 3>& light) {
  if (light == std::array<double, 3>{}) return;
  const PixelRect& tile = planes.tile;
  const int own = int(row_position_[of.place]);
  const int column = own % tile.width(), line = own / tile.width();
  x_.weights.resize(x_.taps());
  y_.weights.resize(y_.taps());
  x_.WeightsAt(x, -column, tile.width() - 1 - column, 1, x_.weights.data());
  y_.WeightsAt(y, -line, tile.height() - 1 - line, 1, y_.weights.data());
  for (int b = -y_.reach; b <= y_.reach; ++b) {
    const auto along_y = double(y_.weights[std::size_t(b + y_.reach)]);
    if (along_y == 0) continue;  // as outside the tile
    for (int a = -x_.reach; a <= x_.reach; ++a) {
      const double weight = along_y * double(x_.weights[std::size_t(a + x_.reach)]);
      if (weight == 0) continue;
      const auto to = std::size_t{row_order_[std::size_t(own + b * tile.width() + a)]};
      for (std::size_t c = 0; c < kColorPlanes; ++c) {
        planes.values[c * planes.stride + to * planes.count + of.sample] +=
            float(weight * light[c]);
      }
    }
  }
}

// A sample at x in bins adds with the weight w_p(x) to pixel p.
std::vector<double> SampleSharing::Axis::Covariances() const {
  // Places within a bin, since bins of pixels overlap in part.
  constexpr int kPlaces = 8;
  std::vector<double> sums(taps());
  std::vector<float> weights(taps());
  double total = 0;
  for (int i = 0; i < kSize * kPlaces; ++i) {
    const double density = std::abs(double(mass[std::size_t(i / kPlaces)]));
    WeightsAt((float(i) + 0.5f) / kPlaces, -reach, reach, 1, weights.data());
    total += density;
    for (std::size_t distance = 0; distance < taps(); ++distance) {
      for (std::size_t k = 0; k + distance < taps(); ++k) {
        sums[distance] += density * double(weights[k]) * double(weights[k + distance]);
      }
    }
  }
  for (double& sum : sums) sum /= total;
  return sums;
}

FilterReach SampleSharing::Reach() const {
  // What all samples of a tile miss of an edge or a gradient, since they lie at the same
  // places, is common too: with 64 samples the sum is up to 1.8 times as large (blinds;
  // 0.8 to 1 in cornell-box, 1.4 in coffee).
  FilterReach reach;
  reach.shared = x_.reach + y_.reach > 0 ? 2 : 1;
  for (const Axis* axis : {&x_, &y_}) {
    const std::vector<double> covariances = axis->Covariances();
    double sum = 1;
    for (std::size_t i = 1; i < covariances.size(); ++i) {
      sum += 2 * std::pow(covariances[i] / covariances[0], 2);
    }
    reach.shared *= sum;
    reach.shared_variance *= covariances[0];
  }
  return reach;
}

FilterReach ReachOfFilter(const PreparedScene& scene) {
  FilterReach reach = SampleSharing(scene.compiled->filter).Reach();
  reach.splats = SplatPixels(scene);
  return reach;
}

}  // namespace lanelight
