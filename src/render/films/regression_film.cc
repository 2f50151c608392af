#include "src/render/films/regression_film.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "src/base/core/aligned.h"
#include "src/base/core/check.h"
#include "src/base/core/parallel.h"

namespace lanelight {
namespace {

constexpr int kFunctions = RegressionFilm::kFunctions;
constexpr std::uint32_t kAtOnce = 32;    // samples
constexpr float kNoiseSafetyFactor = 2;  // see Scatter::Fit
constexpr float kNeighbourFreedom = 24;

// Orthonormal P1 in the middle of a cell.
float Linear(std::uint32_t cell, int bits) {
  constexpr float kRoot3 = 1.73205081f;
  const float width = 2 * kRoot3 / float(1 << bits);
  return float(int(cell)) * width + (width / 2 - kRoot3);
}

// Three times 1[u < p] - p: of variance 1 at p = 1/7, between what glass reflects head-on
// and aslant, so that the sample that a fit adds weighs as with the other functions.
float Choice(std::uint32_t code) {
  constexpr float kScale = 3.0f / (1 << kBitsOfProbability);
  const auto p = int(code >> 1), first = int(code & 1);
  return float((first << kBitsOfProbability) - p) * kScale;
}

// Returns 0 for values that would spoil sums.
float Finite(float v) { return std::abs(v) < 1e30f ? v : 0; }

}  // namespace

// Sums of squares and products about the pixels' means, over one half of a pixel's
// samples or all pixels of a block.
struct RegressionFilm::Scatter {
  float freedom = 0, ff[3] = {};  // freedom: samples less one per mean
  Values squares = {}, products[3] = {};
  Values scattered = {};  // sums of (g - its mean)^2 phi^2, g the mean of the channels

  void Add(const Scatter& o) {
    freedom += o.freedom;
    for (int j = 0; j < kFunctions; ++j) {
      const auto i = std::size_t(j);
      squares[i] += o.squares[i];
      scattered[i] += o.scattered[i];
      for (int c = 0; c < 3; ++c) products[c][i] += o.products[c][i];
    }
    for (int c = 0; c < 3; ++c) ff[c] += o.ff[c];
  }

  // Coefficients of a channel. That of noise alone has the variance sum (f - its mean)^2
  // phi^2 / (sum phi^2)^2, whatever f and phi have in common (White 1980): where both
  // live on the same few paths, samples that are neither tell nothing. They are shrunk
  // as if kNoiseSafetyFactor times that had been seen, less the share that the function
  // explains; neighbours weigh in with kNeighbourFreedom degrees of freedom at most. One
  // sample more, with phi = 1 and f at its mean, keeps those of events that have hardly
  // been seen finite.
  void Fit(const Scatter& block, int c, Values& b) const {
    const float around = block.freedom - freedom;
    const float w = around > 0 ? std::min(1.0f, kNeighbourFreedom / around) : 0;
    const auto mix = [w](float of_own, float of_block) {
      return (1 - w) * of_own + w * of_block;
    };
    float g = 0;  // standard deviation, as if channels rose and fell together
    for (int k = 0; k < 3; ++k) g += std::sqrt(mix(ff[k], block.ff[k])) / 3;
    const float f = mix(ff[c], block.ff[c]),
                scale = g > 0 ? kNoiseSafetyFactor * f / (g * g) : 0;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const float square = mix(squares[j], block.squares[j]);
      const float product = mix(products[c][j], block.products[c][j]);
      const float left = std::max(0.0f, 1 - product * product / (square * f));
      const float slope = product / (square + 1), explained = slope * product;
      const float noise =
          scale * left * mix(scattered[j], block.scattered[j]) / (square + 1);
      b[j] = explained > noise ? Finite(slope - slope * noise / explained) : 0;
    }
  }
};

RegressionFilm::RegressionFilm(const PixelRect& window, const SampleGroups& groups,
                               double coefficient)
    : window_(window),
      groups_(groups),
      coefficient_(coefficient),
      replicates_(groups.replicates ? kReplicates : 2) {
  LL_CHECK(groups.unit == 1 || groups.replicates);
  const auto pixels = std::size_t(window.pixels());
  ResizeInHugePages(sums_, pixels * replicates_);
  ResizeInHugePages(colors_, pixels);
  ResizeInHugePages(products_, pixels);
  ResizeInHugePages(fitted_, pixels);
}

std::size_t RegressionFilm::BytesPerPixel(const SampleGroups& groups) {
  return (groups.replicates ? kReplicates : 2) * sizeof(Values) + sizeof(Halves<Colors>) +
         sizeof(Halves<Products>) + sizeof(Fitted);
}

void RegressionFilm::Functions(const float* codes, float* phi) {
  for (int k = 0; k < 3; ++k) {
    const auto code = std::bit_cast<std::uint32_t>(codes[k]);
    const float has = code >= kHasPair ? 1 : 0;
    phi[2 * k] = has * Linear(code << 1 >> (kBitsOfSecond + 1), kBitsOfFirst);
    phi[2 * k + 1] = has * Linear(code & ((1u << kBitsOfSecond) - 1), kBitsOfSecond);
    if (k > 0) phi[7 + k] = phi[2 * k] * phi[2 * k + 1];
    for (int i = 2; i < 4 && k == 1; ++i) {  // P2 = (3 (2u - 1)^2 - 1) / 2
      phi[4 + i] = has * std::sqrt(5.0f) / 2 * (phi[i] * phi[i] - 1);
    }
  }
  const auto choices = std::bit_cast<std::uint32_t>(codes[3]);
  phi[10] = Choice(choices & 0xffff);
  phi[11] = Choice(choices >> 16);
}

void RegressionFilm::Add(std::size_t pixel, const ControlledSamples& samples) {
  for (std::uint32_t begin = 0; begin < samples.count; begin += kAtOnce) {
    const std::uint32_t count = std::min(kAtOnce, samples.count - begin);
    float phi[kAtOnce][kFunctions];
    for (std::uint32_t i = 0; i < count; ++i) {
      float codes[kPlanes];
      for (int k = 0; k < kPlanes; ++k) codes[k] = samples.planes[k][begin + i];
      Functions(codes, phi[i]);
    }
    for (std::uint32_t half = 0; half < 2; ++half) {
      AddHalf(pixel, half, samples, begin, {phi, count});
    }
  }
}

// Samples of one half among a few, whose sums then stay in registers.
void RegressionFilm::AddHalf(std::size_t pixel, std::uint32_t half,
                             const ControlledSamples& samples, std::uint32_t begin,
                             std::span<const float[kFunctions]> phi) {
  Colors colors = colors_[pixel][half];
  Products sums = products_[pixel][half];
  for (std::uint32_t i = 0; i < phi.size(); ++i) {
    const std::uint64_t sample = samples.first + begin + i;
    const std::uint32_t replicate = ReplicateOf(sample);
    if (replicate % 2 != half) continue;
    Values& sum = sums_[pixel * replicates_ + replicate];
    for (std::size_t j = 0; j < kFunctions; ++j) sum[j] += phi[i][j];
    for (int c = 0; c < 3; ++c) {
      const double f = double(samples.colors[c][begin + i]);
      colors.f[c] += f;
      colors.ff[c] += f * f;
    }
    if (sample >= kMaxFittedSamples) continue;
    const float g = (samples.colors[0][begin + i] + samples.colors[1][begin + i] +
                     samples.colors[2][begin + i]) /
                    3;
    for (std::size_t j = 0; j < kFunctions; ++j) {
      const float square = phi[i][j] * phi[i][j], once = g * square;
      sums.squares[j] += square;
      sums.once[j] += once;
      sums.twice[j] += g * once;
    }
    for (int c = 0; c < 3; ++c) {
      const float f = samples.colors[c][begin + i];
      for (std::size_t j = 0; j < kFunctions; ++j) sums.products[c][j] += f * phi[i][j];
    }
  }
  colors_[pixel][half] = colors;
  products_[pixel][half] = sums;
}

double RegressionFilm::SamplesOfHalf(std::uint64_t samples, int half) const {
  const auto of = std::uint64_t(half);
  if (!groups_.replicates) return double((samples + 1 - of) / 2);
  std::uint64_t n = 0;
  for (auto r = std::uint32_t(half); r < kReplicates; r += 2) {
    n += groups_.InReplicate(samples, r);
  }
  return double(n);
}

RegressionFilm::Scatter RegressionFilm::ScatterOf(const ControlledColors& colors,
                                                  std::size_t pixel, int half) const {
  Scatter out;
  const std::uint64_t samples = colors.samples[pixel];
  const double all = SamplesOfHalf(samples, half);
  if (all < 2) return out;
  // Beyond kMaxFittedSamples colours and functions know more than their products do.
  const double n = SamplesOfHalf(std::min(samples, kMaxFittedSamples), half),
               fraction = n / all;
  const auto side = std::size_t(half);
  const Colors& own = colors_[pixel][side];
  const Products& sums = products_[pixel][side];
  out.freedom = float(n - 1);
  Values phi = {};
  for (std::size_t t = side; t < replicates_; t += 2) {
    for (std::size_t j = 0; j < phi.size(); ++j) phi[j] += Sums(pixel, t)[j];
  }
  const auto inverse = float(fraction * fraction / n);
  const auto g = float((own.f[0] + own.f[1] + own.f[2]) / (3 * all));
  for (std::size_t j = 0; j < phi.size(); ++j) {
    out.squares[j] = std::max(0.0f, sums.squares[j] - phi[j] * phi[j] * inverse);
    const float about = sums.twice[j] - g * (2 * sums.once[j] - g * sums.squares[j]);
    out.scattered[j] = std::max(0.0f, about);
  }
  for (int c = 0; c < 3; ++c) {
    const double mean = own.f[c] / all;
    out.ff[c] = float(std::max(0.0, own.ff[c] - own.f[c] * mean) * fraction);
    const auto scale = float(mean * fraction);
    for (std::size_t j = 0; j < phi.size(); ++j) {
      out.products[c][j] = sums.products[c][j] - scale * phi[j];
    }
  }
  return out;
}

// Corrects one half with coefficients of the other.
void RegressionFilm::StoreCoefficients(const Values (&b)[3], std::size_t pixel,
                                       std::uint64_t samples, int half) {
  Fitted& out = fitted_[pixel];
  const auto side = std::size_t(half);
  const Products& sums = products_[pixel][side];
  const double fitted = SamplesOfHalf(std::min(samples, kMaxFittedSamples), half);
  const double more = fitted > 0 ? SamplesOfHalf(samples, half) / fitted : 0;
  for (int c = 0; c < 3; ++c) {
    for (std::size_t t = side; t < replicates_; t += 2) {
      float sum = 0;
      for (std::size_t j = 0; j < b[c].size(); ++j) sum += b[c][j] * Sums(pixel, t)[j];
      out.corrections[t][c] = sum;
    }
    float product = 0, square = 0;
    for (std::size_t j = 0; j < b[c].size(); ++j) {
      product += b[c][j] * sums.products[c][j];
      square += b[c][j] * b[c][j] * sums.squares[j];
    }
    out.products[c] += product * float(more);
    out.squares[c] += square * float(more);
  }
}

void RegressionFilm::FitBlock(const ControlledColors& colors,
                              std::span<const std::size_t> pixels) {
  Scatter own[kBlock * kBlock];
  for (int half = 0; half < 2; ++half) {
    Scatter block;
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      own[i] = ScatterOf(colors, pixels[i], half);
      block.Add(own[i]);
    }
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      Values b[3];
      for (int c = 0; c < 3; ++c) own[i].Fit(block, c, b[c]);
      StoreCoefficients(b, pixels[i], colors.samples[pixels[i]], 1 - half);
    }
  }
}

void RegressionFilm::Fit(const ControlledColors& colors) {
  std::ranges::fill(fitted_, Fitted());
  const int first = window_.y0 / kBlock, last = (window_.y1 - 1) / kBlock;
  ParallelFor(static_cast<std::size_t>(last - first + 1), [&](std::size_t row) {
    const int top = (first + int(row)) * kBlock;
    for (int left = window_.x0 / kBlock * kBlock; left < window_.x1; left += kBlock) {
      std::size_t pixels[kBlock * kBlock], count = 0;
      for (int y = std::max(top, window_.y0); y < std::min(top + kBlock, window_.y1);
           ++y) {
        for (int x = std::max(left, window_.x0); x < std::min(left + kBlock, window_.x1);
             ++x) {
          pixels[count++] = std::size_t(y - window_.y0) * std::size_t(window_.width()) +
                            std::size_t(x - window_.x0);
        }
      }
      FitBlock(colors, {pixels, count});
    }
  });
}

Rgb RegressionFilm::Correction(std::size_t pixel, std::uint64_t) const {
  Rgb sum;
  for (const auto& correction : fitted_[pixel].corrections) {
    for (int c = 0; c < 3; ++c) sum[c] += coefficient_ * double(correction[c]);
  }
  return sum;
}

void RegressionFilm::CorrectReplicates(std::size_t pixel, ReplicateSums& sums) const {
  for (std::uint32_t r = 0; r < kReplicates; ++r) {
    for (int c = 0; c < 3; ++c) {
      sums.of[r][c] -= coefficient_ * double(fitted_[pixel].corrections[r][c]);
    }
  }
}

// The square of a fit is known but for products of different functions, whose mean is 0
// and which the coefficients, being of other samples, know nothing of.
Rgb RegressionFilm::ResidualSquares(std::size_t pixel, std::uint64_t samples) const {
  const Halves<Colors>& of = colors_[pixel];
  const Rgb correction = Correction(pixel, samples);
  Rgb out;
  for (int c = 0; c < 3; ++c) {
    const double product = double(fitted_[pixel].products[c]);
    const double square = double(fitted_[pixel].squares[c]);
    const double sum = of[0].f[c] + of[1].f[c] - correction[c];
    const double squares =
        of[0].ff[c] + of[1].ff[c] - coefficient_ * (2 * product - coefficient_ * square);
    out[c] = std::max(0.0, squares - sum * sum / double(samples));
  }
  return out;
}

ControlReport RegressionFilm::Report(const ControlledColors& colors) const {
  double products = 0, squares = 0, variance = 0;
  for (std::size_t i = 0; i < colors_.size(); ++i) {
    if (colors.samples[i] == 0) continue;
    for (int c = 0; c < 3; ++c) {
      products += double(fitted_[i].products[c]);
      squares += double(fitted_[i].squares[c]);
      const Halves<Colors>& of = colors_[i];
      const double f = of[0].f[c] + of[1].f[c], n = double(colors.samples[i]);
      variance += std::max(0.0, of[0].ff[c] + of[1].ff[c] - f * f / n);
    }
  }
  const double scale = std::sqrt(squares * variance);
  return {coefficient_, scale > 0 ? products / scale : 0};
}

std::vector<MutableStateColumn> RegressionFilm::Columns() {
  return {MakeStateColumn<float>("regression_sums",
                                 "sums of the functions, by replicate or half", sums_,
                                 {replicates_, kFunctions}),
          MakeStateColumn<double>("regression_colors",
                                  "sums of f, then of its square, by half and channel",
                                  colors_, {2, 2, 3}),
          MakeStateColumn<float>("regression_products",
                                 "sums of the functions' squares, then of f times the "
                                 "functions by channel, of their squares times the mean "
                                 "channel and its square, for each half",
                                 products_, {2, 6, kFunctions})};
}

}  // namespace lanelight
