#include "src/image/regression_film.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "src/core/check.h"

namespace lanelight {
namespace {

// Fits come after so many samples and multiples of it: whole turns of the replicates.
constexpr std::uint64_t kLeast = 8;

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

// The first fit after that at `samples`; they grow apart, so that their cost stays a
// share of the samples'.
std::uint64_t NextFit(std::uint64_t samples) {
  return samples + std::max<std::uint64_t>(1, samples / 4 / kLeast) * kLeast;
}

// The first fit at `samples` or after: the same however the samples are cut.
std::uint64_t FitFrom(std::uint64_t samples) {
  std::uint64_t fit = kLeast;
  while (fit < samples) fit = NextFit(fit);
  return fit;
}

}  // namespace

RegressionFilm::RegressionFilm(int x0, int y0, int width, int height,
                               const SampleGroups& groups, double coefficient)
    : x0_(x0), y0_(y0), width_(width), groups_(groups), coefficient_(coefficient) {
  const std::size_t pixels =
      static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  samples_.resize(pixels);
  pixels_.resize(pixels);
  fits_.resize(pixels);
}

std::size_t RegressionFilm::BytesPerPixel() {
  return sizeof(std::uint64_t) + sizeof(Pixel) + sizeof(Fits);
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

void RegressionFilm::Correlate(std::size_t pixel, int half, double n, float* out) const {
  const Moments& moments = pixels_[pixel].moments[half];
  const Half& sums = fits_[pixel].sums[half];
  for (int c = 0; c < 3; ++c) {
    const double mean = moments.f[c] / n;
    const double deviation = Deviation(moments.f[c], moments.ff[c], n);
    for (int j = 0; j < kFunctions; ++j) {
      const double sum = double(sums.products[c][j]) - mean * double(sums.phi[j]);
      *out++ = deviation > 0 ? static_cast<float>(sum / deviation) : 0;
    }
    *out++ = static_cast<float>(deviation);
  }
}

void RegressionFilm::FitAll(const SampleBlock& block, std::uint64_t samples) {
  const double n = static_cast<double>(samples / 2);  // of each half: whole turns
  for (int by = block.y0 / kBlock * kBlock; by < block.y1; by += kBlock) {
    for (int bx = block.x0 / kBlock * kBlock; bx < block.x1; bx += kBlock) {
      for (int half = 0; half < 2; ++half) {
        FitBlock(std::max(bx, block.x0), std::max(by, block.y0),
                 std::min(bx + kBlock, block.x1), std::min(by + kBlock, block.y1), half,
                 n);
      }
    }
  }
}

void RegressionFilm::FitBlock(int x0, int y0, int x1, int y1, int half, double n) {
  const int width = x1 - x0, height = y1 - y0;
  std::vector<Correlations> sums(static_cast<std::size_t>(width) *
                                 static_cast<std::size_t>(height));
  std::vector<Correlations> rows(sums.size());
  const auto index = [&](int x, int y) {
    return static_cast<std::size_t>(y * width + x);
  };
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      Correlate(Index(x0 + x, y0 + y), half, n, sums[index(x, y)].data());
    }
    SumWindows(&sums[index(0, y)], &rows[index(0, y)], width, 1);
  }
  for (int x = 0; x < width; ++x) {
    SumWindows(&rows[index(x, 0)], &sums[index(x, 0)], height, width);
  }
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      SetCoefficients(Index(x0 + x, y0 + y), half, sums[index(x, y)].data(), n,
                      WindowSize(x, width) * WindowSize(y, height));
    }
  }
}

void RegressionFilm::SetCoefficients(std::size_t pixel, int half, const float* sums,
                                     double n, int window) {
  const Moments& moments = pixels_[pixel].moments[half];
  const double all = n * window;
  for (int c = 0; c < 3; ++c, sums += kPerChannel) {
    const double mean_deviation = double(sums[kFunctions]) / window;
    const double deviation = std::min(Deviation(moments.f[c], moments.ff[c], n),
                                      kMostDeviation * mean_deviation);
    for (int j = 0; j < kFunctions; ++j) {
      fits_[pixel].b[half][c][j] =
          static_cast<float>(Shrunk(double(sums[j]) / all, all) * deviation);
    }
  }
}

void RegressionFilm::CorrectPixel(const SampleBlock& block, int first_plane,
                                  std::uint32_t pixel, std::uint32_t begin,
                                  std::uint32_t end) {
  const std::uint32_t id = block.pixels[pixel];
  const std::size_t index = Index(static_cast<int>(id % block.image_width),
                                  static_cast<int>(id / block.image_width));
  Pixel& p = pixels_[index];
  Fits& fits = fits_[index];
  const std::uint64_t first = samples_[index];
  for (std::uint32_t i = begin; i < end; ++i) {
    const std::uint64_t sample = first + (i - begin);
    const int half = HalfOf(sample);
    const bool learns = sample < kMostFitted;
    float numbers[kPlanes], phi[kFunctions];
    for (int k = 0; k < kPlanes; ++k) numbers[k] = block.At(first_plane + k, pixel)[i];
    Functions(numbers, phi);
    Half& sums = fits.sums[half];
    for (int j = 0; j < kFunctions && learns; ++j) sums.phi[j] += phi[j];
    for (int c = 0; c < 3; ++c) {
      float& value = block.At(c, pixel)[i];
      const float f = value;
      float fit = 0;
      for (int j = 0; j < kFunctions; ++j) {
        fit += fits.b[1 - half][c][j] * phi[j];
        if (learns) sums.products[c][j] += f * phi[j];
      }
      if (learns) {
        p.moments[half].f[c] += double(f);
        p.moments[half].ff[c] += double(f) * double(f);
        p.fitted += double(f) * double(fit);
        p.fitted_squares += double(fit) * double(fit);
      }
      value = static_cast<float>(double(f) - coefficient_ * double(fit));
    }
  }
  samples_[index] += end - begin;
}

void RegressionFilm::Correct(const SampleBlock& block, int first_plane) {
  for (std::uint32_t begin = 0; begin < block.count;) {
    const std::uint64_t samples = samples_[Index(block.x0, block.y0)];
    std::uint64_t next = FitFrom(samples);
    if (samples == next) {
      if (samples <= kMostFitted) FitAll(block, samples);
      next = NextFit(next);
    }
    const auto end = static_cast<std::uint32_t>(
        std::min<std::uint64_t>(block.count, begin + (next - samples)));
    for (std::uint32_t pixel = 0; pixel < block.num_pixels; ++pixel) {
      CorrectPixel(block, first_plane, pixel, begin, end);
    }
    begin = end;
  }
}

ControlReport RegressionFilm::Report() const {
  double products = 0, squares = 0, variance = 0;
  for (std::size_t i = 0; i < pixels_.size(); ++i) {
    if (samples_[i] == 0) continue;
    const Pixel& p = pixels_[i];
    const auto n = static_cast<double>(std::min(samples_[i], kMostFitted));
    products += p.fitted;
    squares += p.fitted_squares;
    for (int c = 0; c < 3; ++c) {
      const double f = p.moments[0].f[c] + p.moments[1].f[c];
      const double ff = p.moments[0].ff[c] + p.moments[1].ff[c];
      variance += std::max(0.0, ff - f * f / n);
    }
  }
  const double scale = std::sqrt(squares * variance);
  return {coefficient_, scale > 0 ? products / scale : 0};
}

std::vector<MutableStateColumn> RegressionFilm::Columns() {
  return {MakeStateColumn<std::uint64_t>("regression_samples", "samples corrected",
                                         samples_, {}),
          MakeStateColumn<double>(
              "regression_moments",
              "for each half, sums of f and of its square by channel; then "
              "sums of f times the fit and of the fit's square",
              pixels_, {14}),
          MakeStateColumn<float>(
              "regression_fits",
              "for each half, sums of the functions and of f times them by "
              "channel; then the coefficients by half, channel and function",
              fits_, {140})};
}

}  // namespace lanelight
