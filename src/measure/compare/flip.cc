#include "src/measure/compare/flip.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "src/base/core/check.h"
#include "src/base/core/parallel.h"
#include "src/measure/compare/flip_filters.h"

namespace lanelight {
namespace {

constexpr std::size_t kPixelsOfTask = 4096;

// The paper's constants, by its names: exponents of colour and feature differences, and
// the knee (kPc, kPt) of the curve for colour differences.
constexpr double kQc = 0.7, kQf = 0.5, kPc = 0.4, kPt = 0.95;
// Width of the detectors of edges and points, in degrees.
constexpr double kFeatureWidth = 0.082;

// A term of the contrast sensitivity: a sqrt(pi / b) exp(-pi^2 x^2 / b), x in
// degrees.
struct Sensitivity {
  double a, b;
};
constexpr Sensitivity kLuminance = {1, 0.0047}, kRedGreen = {1, 0.0053},
                      kBlueYellow[] = {{34.1, 0.04}, {13.5, 0.025}};

Kernel Scaled(std::vector<double> weights, double factor) {
  Kernel out;
  for (double w : weights) out.push_back(float(w * factor));
  return out;
}

// Returns exp(-x^2 / scale) at integer x.
std::vector<double> GaussianKernel(int radius, double scale) {
  std::vector<double> out;
  for (int x = -radius; x <= radius; ++x) out.push_back(std::exp(-double(x) * x / scale));
  return out;
}

double Sum(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

// The filters of an image for one viewing distance.
class EyeFilters {
 public:
  explicit EyeFilters(double pixels_per_degree)
      : ppd_(pixels_per_degree),
        radius_(int(std::ceil(3 * std::sqrt(kBlueYellow[0].b / (2 * kPi * kPi)) * ppd_))),
        deviation_(0.5 * kFeatureWidth * ppd_),
        feature_radius_(int(std::ceil(3 * deviation_))) {}

  Plane Luminance(const Plane& in, int w, int h) const {
    return One(in, w, h, kLuminance);
  }
  Plane RedGreen(const Plane& in, int w, int h) const { return One(in, w, h, kRedGreen); }

  // The one filter that is not separable: a sum of two that are.
  Plane BlueYellow(const Plane& in, int w, int h) const {
    double fraction[2];
    for (int i = 0; i < 2; ++i) {
      const double sum = Sum(BellOf(kBlueYellow[i]));
      fraction[i] = kBlueYellow[i].a * std::sqrt(kPi / kBlueYellow[i].b) * sum * sum;
    }
    Plane out = One(in, w, h, kBlueYellow[0]);
    const Plane second = One(in, w, h, kBlueYellow[1]);
    const float part = float(fraction[0] / (fraction[0] + fraction[1]));
    for (std::size_t i = 0; i < out.size(); ++i) {
      out[i] = part * out[i] + (1 - part) * second[i];
    }
    return out;
  }

  // Returns lengths of gradients of the edge (derivative 1) or point (2) detector.
  Plane Features(const Plane& in, int w, int h, int derivative) const {
    std::vector<double> bell =
        GaussianKernel(feature_radius_, 2 * deviation_ * deviation_);
    const Kernel smooth = Scaled(bell, 1 / Sum(bell)), slope = Slope(bell, derivative);
    Plane across = ConvolveColumns(ConvolveRows(in, w, h, slope), w, h, smooth);
    const Plane down = ConvolveColumns(ConvolveRows(in, w, h, smooth), w, h, slope);
    for (std::size_t i = 0; i < across.size(); ++i) {
      across[i] = std::hypot(across[i], down[i]);
    }
    return across;
  }

 private:
  std::vector<double> BellOf(const Sensitivity& s) const {
    return GaussianKernel(radius_, s.b * ppd_ * ppd_ / (kPi * kPi));
  }

  Plane One(const Plane& in, int w, int h, const Sensitivity& s) const {
    const std::vector<double> bell = BellOf(s);
    const Kernel kernel = Scaled(bell, 1 / Sum(bell));
    return ConvolveColumns(ConvolveRows(in, w, h, kernel), w, h, kernel);
  }

  // Returns a derivative of the bell; positive weights sum to 1, negative ones to -1.
  Kernel Slope(std::vector<double> weights, int derivative) const {
    double above = 0, below = 0;
    for (int i = 0; i < int(weights.size()); ++i) {
      const double x = i - feature_radius_;
      weights[i] *= derivative == 1 ? -x : x * x / (deviation_ * deviation_) - 1;
      (weights[i] > 0 ? above : below) += std::abs(weights[i]);
    }
    // A detector narrower than a pixel detects nothing.
    if (above == 0 || below == 0) return Kernel(weights.size(), 0.0f);
    for (double& w : weights) w /= w > 0 ? above : below;
    return Scaled(weights, 1);
  }

  const double ppd_;
  const int radius_;
  const double deviation_;
  const int feature_radius_;
};

// The filtered colours and features of one image.
struct FilteredImage {
  std::array<Plane, 3> lab;
  Plane edges, points;
};

float Shown(float value) { return value > 0 ? std::min(value, 1.0f) : 0.0f; }

std::array<Plane, 3> OpponentPlanes(const LinearImage& image,
                                    const OpponentColors& colors) {
  std::array<Plane, 3> out;
  for (Plane& plane : out) plane.resize(image.pixels());
  ParallelForRange(image.pixels(), kPixelsOfTask, [&](std::size_t from, std::size_t to) {
    for (std::size_t i = from; i < to; ++i) {
      const Vec3d opponent =
          colors.FromRgb({Shown(image.planes[0][i]), Shown(image.planes[1][i]),
                          Shown(image.planes[2][i])});
      for (int c = 0; c < 3; ++c) out[c][i] = float(opponent[c]);
    }
  });
  return out;
}

FilteredImage FilterImage(const LinearImage& image, const EyeFilters& eye,
                          const OpponentColors& colors) {
  const int w = image.width, h = image.height;
  const std::array<Plane, 3> opponent = OpponentPlanes(image, colors);
  FilteredImage out;
  out.edges = eye.Features(opponent[0], w, h, 1);
  out.points = eye.Features(opponent[0], w, h, 2);
  out.lab = {eye.Luminance(opponent[0], w, h), eye.RedGreen(opponent[1], w, h),
             eye.BlueYellow(opponent[2], w, h)};
  ParallelForRange(image.pixels(), kPixelsOfTask, [&](std::size_t from, std::size_t to) {
    for (std::size_t i = from; i < to; ++i) {
      const Vec3d rgb = colors.ToRgb({out.lab[0][i], out.lab[1][i], out.lab[2][i]});
      const Vec3d lab = colors.HuntLab(Min(Max(rgb, Vec3d{}), Vec3d{1, 1, 1}));
      for (int c = 0; c < 3; ++c) out.lab[c][i] = float(lab[c]);
    }
  });
  return out;
}

// Maps a colour difference to 0 ... 1; frequent differences take most of the range.
double ColorError(double distance, double largest) {
  const double error = std::pow(distance, kQc), knee = kPc * largest;
  if (error < knee) return kPt / knee * error;
  return kPt + (error - knee) / (largest - knee) * (1 - kPt);
}

double FeatureError(const FilteredImage& a, const FilteredImage& b, std::size_t i) {
  const double edges = std::abs(double(a.edges[i]) - b.edges[i]);
  const double points = std::abs(double(a.points[i]) - b.points[i]);
  return std::pow(std::max(edges, points) / std::sqrt(2.0), kQf);
}

}  // namespace

Plane LdrFlip(const LinearImage& reference, const LinearImage& test,
              double pixels_per_degree) {
  LL_CHECK(reference.width == test.width && reference.height == test.height);
  LL_CHECK(pixels_per_degree >= 1 && pixels_per_degree <= 1000);
  const EyeFilters eye(pixels_per_degree);
  const OpponentColors colors;
  const FilteredImage a = FilterImage(reference, eye, colors),
                      b = FilterImage(test, eye, colors);
  // No two colours of a screen are further apart than green and blue.
  const double largest =
      std::pow(HyAb(colors.HuntLab({0, 1, 0}), colors.HuntLab({0, 0, 1})), kQc);
  Plane map(reference.pixels());
  ParallelForRange(map.size(), kPixelsOfTask, [&](std::size_t from, std::size_t to) {
    for (std::size_t i = from; i < to; ++i) {
      const double distance = HyAb({a.lab[0][i], a.lab[1][i], a.lab[2][i]},
                                   {b.lab[0][i], b.lab[1][i], b.lab[2][i]});
      const double color = std::min(1.0, ColorError(distance, largest));
      map[i] = float(std::pow(color, 1 - FeatureError(a, b, i)));
    }
  });
  return map;
}

FlipSummary SummaryOf(const Plane& map) {
  LL_CHECK(!map.empty());
  Plane sorted = map;
  std::ranges::sort(sorted);
  const double sum = std::accumulate(sorted.begin(), sorted.end(), 0.0);
  FlipSummary out;
  out.mean = sum / double(sorted.size());
  out.max = sorted.back();
  double* const quartiles[] = {&out.first_quartile, &out.median, &out.third_quartile};
  double up_to = 0;
  int next = 0;
  for (float value : sorted) {
    up_to += value;
    while (next < 3 && up_to >= 0.25 * (next + 1) * sum) *quartiles[next++] = value;
  }
  return out;
}

}  // namespace lanelight
