#include "src/image/regression_film.h"

#include <algorithm>
#include <cmath>

namespace lanelight {
namespace {

constexpr std::uint32_t kLeastBlock = 8;

// Sums of a neighbourhood, each pixel about its own mean.
struct Moments {
  double samples = 0;
  double variance[3] = {};  // times samples
  double products[3][RegressionFilm::kFunctions] = {};
};

// Positive-part shrinkage of a mean whose variance is variance / n.
double Shrunk(double mean, double variance, double n) {
  const double square = n * mean * mean;
  if (!(square > variance) || !std::isfinite(square)) return 0;
  return mean * (1 - variance / square);
}

}  // namespace

RegressionFilm::RegressionFilm(int x0, int y0, int width, int height,
                               std::uint32_t group_size, double coefficient)
    : x0_(x0),
      y0_(y0),
      width_(width),
      block_((kLeastBlock + group_size - 1) / group_size * group_size),
      coefficient_(coefficient),
      pixels_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {
  for (Pixel& p : pixels_) p.next_fit = block_;
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

void RegressionFilm::FitPixel(const SampleBlock& block, int x, int y,
                              std::uint32_t next_fit) {
  Moments m;
  for (int ny = std::max(block.y0, y - kReach); ny < std::min(block.y1, y + kReach + 1);
       ++ny) {
    for (int nx = std::max(block.x0, x - kReach); nx < std::min(block.x1, x + kReach + 1);
         ++nx) {
      const Pixel& p = At(nx, ny);
      const double n = p.samples;
      m.samples += n;
      for (int c = 0; c < 3; ++c) {
        const double mean = p.f[c] / n;
        m.variance[c] += std::max(0.0, p.ff[c] - mean * p.f[c]);
        for (int j = 0; j < kFunctions; ++j) {
          m.products[c][j] += double(p.products[c][j]) - mean * double(p.phi[j]);
        }
      }
    }
  }
  Pixel& p = At(x, y);
  p.next_fit = next_fit;
  for (int c = 0; c < 3; ++c) {
    const double variance = m.variance[c] / m.samples;
    for (int j = 0; j < kFunctions; ++j) {
      p.b[c][j] =
          static_cast<float>(Shrunk(m.products[c][j] / m.samples, variance, m.samples));
    }
  }
}

void RegressionFilm::Fit(const SampleBlock& block) {
  const std::uint32_t next = NextFit(At(block.x0, block.y0).next_fit);
  for (int y = block.y0; y < block.y1; ++y) {
    for (int x = block.x0; x < block.x1; ++x) FitPixel(block, x, y, next);
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

}  // namespace lanelight
