#include "src/measure/compare/agreement.h"

#include <algorithm>
#include <cmath>

#include "src/base/image/image.h"

namespace lanelight {
namespace {

using stat::MeanEstimate;

// Sums over pixels.
struct EstimateSum {
  double value = 0, variance = 0, quartic = 0;  // quartic: squares of variances
  std::size_t count = 0;

  void Add(double v, double var) {
    value += v, variance += var, quartic += var * var, ++count;
  }
  void Add(const EstimateSum& o) {
    value += o.value, variance += o.variance, quartic += o.quartic, count += o.count;
  }
  // Path reuse correlates pixels: the variance of the mean is `dependence_factor` times
  // that of independent pixels. `dof`: degrees of freedom of the variance of one pixel.
  MeanEstimate Mean(double dependence_factor, double dof) const {
    if (count == 0) return {};
    const double n = double(count), each = std::min(dependence_factor, n);
    return {
        value / n, each * variance / (n * n),
        quartic > 0 ? dof * std::max(1.0, variance * variance / (quartic * each)) : 1e9};
  }
};

// Values and variances of one channel.
class NoisyValues {
 public:
  explicit NoisyValues(const NoisyChannel& of)
      : image_(of.image),
        color_(of.channels.colors[of.index]),
        variance_(of.is_exact ? -1 : of.channels.variances[of.index]),
        unit_(VarianceUnit(of.image)) {}

  double Value(int x, int y) const { return LinearValue(image_, x, y, color_); }
  double Variance(int x, int y) const {
    return variance_ < 0 ? 0 : unit_ * image_.At(x, y, variance_);
  }

 private:
  const Image& image_;
  const int color_, variance_;
  const double unit_;
};

bool IsVariance(double v) { return std::isfinite(v) && v >= 0; }

}  // namespace

double NumberAttribute(const Image& image, const char* name, double otherwise) {
  const auto found = image.attributes.find(name);
  if (found == image.attributes.end()) return otherwise;
  if (const int* whole = std::get_if<int>(&found->second)) return *whole;
  const double* number = std::get_if<double>(&found->second);
  return number != nullptr ? *number : otherwise;
}

NoisyChannels FindNoisyChannels(const Image& image) {
  const auto colors = ColorChannels(image);
  NoisyChannels out;
  if (!colors) return out;
  out.colors.assign(colors->begin(), colors->end());
  if (out.colors[0] == out.colors[1]) out.colors.resize(1);
  if (image.is_bytes()) return out;
  for (int c : out.colors) {
    const int variance = image.FindChannel("variance." + image.names[c]);
    if (variance < 0) {
      out.variances.clear();
      return out;
    }
    out.variances.push_back(variance);
  }
  return out;
}

ChannelMeans MeansOf(const NoisyChannel& test, const NoisyChannel& reference,
                     const TileLayout& layout) {
  const NoisyValues a(test), b(reference);
  std::vector<EstimateSum> sums_a(layout.size()), sums_b(layout.size());
  for (int y = 0; y < test.image.height; ++y) {
    for (int x = 0; x < test.image.width; ++x) {
      const double value_a = a.Value(x, y), value_b = b.Value(x, y);
      const double variance_a = a.Variance(x, y), variance_b = b.Variance(x, y);
      if (!std::isfinite(value_a) || !std::isfinite(value_b) || !IsVariance(variance_a) ||
          !IsVariance(variance_b)) {
        continue;
      }
      sums_a[layout.At(x, y)].Add(value_a, variance_a);
      sums_b[layout.At(x, y)].Add(value_b, variance_b);
    }
  }
  // A variance needs at least two observations.
  const auto mean_of = [](const Image& image) {
    return [dependence_factor =
                DependenceFactor(NumberAttribute(image, kDependentPixels, 1)),
            dof = std::max(1.0, NumberAttribute(image, kObservations, 2) - 1)](
               const EstimateSum& sum) { return sum.Mean(dependence_factor, dof); };
  };
  const auto mean_a = mean_of(test.image), mean_b = mean_of(reference.image);
  ChannelMeans out;
  EstimateSum all_a, all_b;
  for (std::size_t i = 0; i < layout.size(); ++i) {
    out.test.push_back(mean_a(sums_a[i]));
    out.reference.push_back(mean_b(sums_b[i]));
    out.pixels.push_back(sums_a[i].count);
    all_a.Add(sums_a[i]), all_b.Add(sums_b[i]);
  }
  out.whole_test = mean_a(all_a);
  out.whole_reference = mean_b(all_b);
  return out;
}

}  // namespace lanelight
