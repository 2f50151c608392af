#include "src/image/regression_film.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "src/core/check.h"

namespace lanelight {
namespace {

constexpr std::uint32_t kLeastBlock = 8;

// For each channel: n times the correlations of f with the functions, and f's deviation.
constexpr int kPerChannel = RegressionFilm::kFunctions + 1;
using Correlations = std::array<float, 3 * kPerChannel>;
// A deviation above this multiple of its neighbourhood's comes from rare bright samples,
// which no polynomial explains.
constexpr double kMostDeviation = 2;

// Sums of a line of values, `stride` apart, over windows of 2 kReach + 1.
void SumWindows(const Correlations* in, Correlations* out, int length, int stride) {
  for (int i = 0; i < length; ++i) {
    Correlations sum = {};
    const int end = std::min(length, i + RegressionFilm::kReach + 1);
    for (int k = std::max(0, i - RegressionFilm::kReach); k < end; ++k) {
      for (std::size_t j = 0; j < sum.size(); ++j) sum[j] += in[k * stride][j];
    }
    out[i * stride] = sum;
  }
}

// Pixels of such a window.
int WindowSize(int i, int length) {
  return std::min(length, i + RegressionFilm::kReach + 1) -
         std::max(0, i - RegressionFilm::kReach);
}

// Positive-part shrinkage of a correlation estimated from n samples, whose variance is
// 1 / n if there is none.
double Shrunk(double r, double n) {
  const double signal = n * r * r;
  return signal > 1 && std::isfinite(signal) ? r * (1 - 1 / signal) : 0;
}

double Deviation(double sum, double squares, double n) {
  const double mean = sum / n;
  return std::sqrt(std::max(0.0, squares / n - mean * mean));
}

}  // namespace

RegressionFilm::RegressionFilm(int x0, int y0, int width, int height,
                               std::uint32_t group_size, double coefficient)
    : x0_(x0),
      y0_(y0),
      width_(width),
      coefficient_(coefficient),
      pixels_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {
  Regroup(group_size);
}

void RegressionFilm::Regroup(std::uint32_t group_size) {
  block_ = (kLeastBlock + group_size - 1) / group_size * group_size;
  for (Pixel& p : pixels_) {
    LL_CHECK_LE(p.samples, block_);
    p.next_fit = block_;
  }
}

void RegressionFilm::Functions(const float* numbers, float* phi) {
  constexpr float kRoot3 = 1.73205081f, kRoot5 = 2.23606798f;
  for (int i = 0; i < 6; ++i) {
    const float u = numbers[i];
    const float linear = u < 0 ? 0 : kRoot3 * (2 * u - 1);
    if (i >= 4) {
      phi[4 + i] = linear;
      continue;
    }
    phi[2 * i] = linear;
    phi[2 * i + 1] = u < 0 ? 0 : kRoot5 * (6 * u * (u - 1) + 1);
  }
}

// Fits grow apart with the samples, so that their cost stays a share of the samples'.
std::uint32_t RegressionFilm::NextFit(std::uint32_t samples) const {
  return samples + std::max(1u, samples / 4 / block_) * block_;
}

void RegressionFilm::Correlate(const Pixel& p, float* out) {
  const double n = p.samples;
  for (int c = 0; c < 3; ++c) {
    const double mean = p.f[c] / n, deviation = Deviation(p.f[c], p.ff[c], n);
    for (int j = 0; j < kFunctions; ++j) {
      const double sum = double(p.products[c][j]) - mean * double(p.phi[j]);
      *out++ = deviation > 0 ? static_cast<float>(sum / deviation) : 0;
    }
    *out++ = static_cast<float>(deviation);
  }
}

void RegressionFilm::Fit(const SampleBlock& block) {
  const int width = block.x1 - block.x0, height = block.y1 - block.y0;
  std::vector<Correlations> sums(static_cast<std::size_t>(width) *
                                 static_cast<std::size_t>(height));
  std::vector<Correlations> rows(sums.size());
  const auto index = [&](int x, int y) {
    return static_cast<std::size_t>(y * width + x);
  };
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      Correlate(At(block.x0 + x, block.y0 + y), sums[index(x, y)].data());
    }
    SumWindows(&sums[index(0, y)], &rows[index(0, y)], width, 1);
  }
  for (int x = 0; x < width; ++x) {
    SumWindows(&rows[index(x, 0)], &sums[index(x, 0)], height, width);
  }
  const std::uint32_t next = NextFit(At(block.x0, block.y0).next_fit);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      Pixel& p = At(block.x0 + x, block.y0 + y);
      p.next_fit = next;
      const int window = WindowSize(x, width) * WindowSize(y, height);
      SetCoefficients(p, sums[index(x, y)].data(), window);
    }
  }
}

void RegressionFilm::SetCoefficients(Pixel& p, const float* sums, int window) {
  const double n = double(p.samples) * window;
  for (int c = 0; c < 3; ++c, sums += kPerChannel) {
    const double mean_deviation = double(sums[kFunctions]) / window;
    const double deviation =
        std::min(Deviation(p.f[c], p.ff[c], p.samples), kMostDeviation * mean_deviation);
    for (int j = 0; j < kFunctions; ++j) {
      p.b[c][j] = static_cast<float>(Shrunk(double(sums[j]) / n, n) * deviation);
    }
  }
}

void RegressionFilm::CorrectPixel(const SampleBlock& block, int first_plane,
                                  std::uint32_t pixel, std::uint32_t begin,
                                  std::uint32_t end) {
  const std::uint32_t id = block.pixels[pixel];
  Pixel& p = At(static_cast<int>(id % block.image_width),
                static_cast<int>(id / block.image_width));
  for (std::uint32_t i = begin; i < end; ++i) {
    float numbers[kPlanes], phi[kFunctions];
    for (int k = 0; k < kPlanes; ++k) numbers[k] = block.At(first_plane + k, pixel)[i];
    Functions(numbers, phi);
    for (int j = 0; j < kFunctions; ++j) p.phi[j] += phi[j];
    for (int c = 0; c < 3; ++c) {
      float& value = block.At(c, pixel)[i];
      const float f = value;
      float fit = 0;
      for (int j = 0; j < kFunctions; ++j) {
        fit += p.b[c][j] * phi[j];
        p.products[c][j] += f * phi[j];
      }
      p.f[c] += double(f);
      p.ff[c] += double(f) * double(f);
      p.fitted += f * fit;
      p.fitted_squares += fit * fit;
      value = static_cast<float>(double(f) - coefficient_ * double(fit));
    }
  }
  p.samples += end - begin;
}

void RegressionFilm::Correct(const SampleBlock& block, int first_plane) {
  for (std::uint32_t begin = 0; begin < block.count;) {
    const Pixel& first = At(block.x0, block.y0);
    if (first.samples == first.next_fit) Fit(block);
    const std::uint32_t end =
        std::min(block.count, begin + (first.next_fit - first.samples));
    for (std::uint32_t pixel = 0; pixel < block.num_pixels; ++pixel) {
      CorrectPixel(block, first_plane, pixel, begin, end);
    }
    begin = end;
  }
}

ControlReport RegressionFilm::Report() const {
  double products = 0, squares = 0, variance = 0;
  for (const Pixel& p : pixels_) {
    if (p.samples == 0) continue;
    products += double(p.fitted);
    squares += double(p.fitted_squares);
    for (int c = 0; c < 3; ++c) {
      variance += std::max(0.0, p.ff[c] - p.f[c] * p.f[c] / p.samples);
    }
  }
  const double scale = std::sqrt(squares * variance);
  return {coefficient_, scale > 0 ? products / scale : 0};
}

void RegressionFilm::Save(StateWriter& state) const {
  state.Write("regression block", block_);
  state.Write("regression pixels", pixels_.data(), pixels_.size());
}

void RegressionFilm::Restore(StateReader& state) {
  state.Expect("regression block", block_);
  state.Read("regression pixels", pixels_.data(), pixels_.size());
}

}  // namespace lanelight
