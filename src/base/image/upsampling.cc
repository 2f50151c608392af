#include "src/base/image/upsampling.h"

#include <algorithm>
#include <cmath>

#include "src/base/core/parallel.h"
#include "src/base/image/color_spaces.h"

namespace lanelight {
namespace {

using Polynomial = std::array<double, 3>;

// Steeper sigmoids fit no better.
constexpr double kSteepest = 400;
constexpr double kNear = 1e-12;  // squared error of a fit that is good enough

double Sigmoid(double p) { return 0.5 + 0.5 * p / std::sqrt(1 + p * p); }

// Quadrature of a fit, one entry per bin.
struct Quadrature {
  std::array<double, kWavelengthBins> place;
  std::array<Rgb, kWavelengthBins> weight;

  Quadrature() {
    const WavelengthBins& bins = CarriedWavelengths();
    for (int b = 0; b < kWavelengthBins; ++b) {
      place[b] = SigmoidPlace(bins.centre[b]);
      weight[b] = bins.film[b] / kTriples;
    }
  }
};

const Quadrature& Bins() {
  static const Quadrature bins;
  return bins;
}

// Colour of a sigmoid, and its derivatives by the coefficients.
struct Colored {
  Rgb color;
  Rgb slope[3];

  explicit Colored(const Polynomial& c) {
    const Quadrature& q = Bins();
    for (int b = 0; b < kWavelengthBins; ++b) {
      const double t = q.place[b], p = (c[0] * t + c[1]) * t + c[2];
      const double inverse = 1 / std::sqrt(1 + p * p);
      color += q.weight[b] * (0.5 + 0.5 * p * inverse);
      const Rgb change = q.weight[b] * (0.5 * inverse * inverse * inverse);
      slope[0] += change * (t * t);
      slope[1] += change * t;
      slope[2] += change;
    }
  }
};

double Error(Rgb a, Rgb b) { return Dot(a - b, a - b); }

// Levenberg-Marquardt from `c`.
Polynomial Fit(Rgb target, Polynomial c) {
  double damping = 1e-9;
  Colored at(c);
  for (int i = 0; i < 60 && Error(at.color, target) > kNear && damping < 1e3; ++i) {
    ColorMatrix normal;
    Vec3d gradient;
    for (int a = 0; a < 3; ++a) {
      for (int b = 0; b < 3; ++b) {
        normal.row[a][b] = Dot(at.slope[a], at.slope[b]) + (a == b ? damping : 0);
      }
      gradient[a] = Dot(at.slope[a], target - at.color);
    }
    const Vec3d step = Inverse(normal) * gradient;
    Polynomial next;
    for (int a = 0; a < 3; ++a) {
      next[a] = std::clamp(c[a] + step[a], -kSteepest, kSteepest);
    }
    const Colored there(next);
    const bool better = Error(there.color, target) < Error(at.color, target);
    if (better) c = next, at = there;
    damping = better ? std::max(damping * 0.2, 1e-14) : damping * 8;
  }
  return c;
}

double NodeValue(int node) {
  const double end = HalfTangentOfGrey(1 - kMinUpsampled);
  const double h = end * (2.0 * node / (kUpsamplingNodes - 1) - 1);
  return 0.5 + h / (1 + h * h);
}

std::vector<float> MakeUpsamplingTable() {
  constexpr int n = kUpsamplingNodes;
  std::vector<float> table(3 * n * n * n);
  Bins();
  ParallelFor(std::size_t{n} * n, [&](std::size_t row) {
    const int g = static_cast<int>(row) % n, b = static_cast<int>(row) / n;
    SigmoidSpectrum fit;
    for (int r = 0; r < n; ++r) {
      fit =
          FitSigmoid({NodeValue(r), NodeValue(g), NodeValue(b)}, r == 0 ? nullptr : &fit);
      for (int i = 0; i < 3; ++i) {
        const double t = SigmoidPlace(kUpsamplingNm[i]);
        const double p = (fit.c[0] * t + fit.c[1]) * t + fit.c[2];
        table[3 * (row * n + static_cast<std::size_t>(r)) + static_cast<std::size_t>(i)] =
            static_cast<float>(HalfTangent(p));
      }
    }
  });
  return table;
}

}  // namespace

double HalfTangent(double p) { return p / (1 + std::sqrt(1 + p * p)); }

double HalfTangentOfGrey(double v) {
  return (2 * v - 1) / (1 + 2 * std::sqrt(v * (1 - v)));
}

double SigmoidSpectrum::operator()(double nm) const {
  const double t = SigmoidPlace(nm);
  return Sigmoid((c[0] * t + c[1]) * t + c[2]);
}

std::array<std::array<double, 3>, 3> PolynomialThrough() {
  ColorMatrix powers;
  for (int i = 0; i < 3; ++i) {
    const double t = SigmoidPlace(kUpsamplingNm[i]);
    powers.row[i] = {t * t, t, 1};
  }
  const ColorMatrix inverse = Inverse(powers);
  std::array<std::array<double, 3>, 3> rows;
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) rows[i][k] = inverse.row[i][k];
  }
  return rows;
}

SigmoidSpectrum FitSigmoid(Rgb rgb, const SigmoidSpectrum* near) {
  if (near != nullptr) {
    const Polynomial c = Fit(rgb, near->c);
    if (Error(Colored(c).color, rgb) <= kNear) return {c};
  }
  // Steps from grey towards the colour: near the gamut's edge a direct fit gets stuck on
  // the flat parts of the sigmoid.
  Polynomial c = {0, 0, 0};
  const Rgb grey = {0.5, 0.5, 0.5};
  for (double weight : {0.5, 0.8, 0.95, 1.0}) c = Fit(grey + (rgb - grey) * weight, c);
  return {c};
}

Spectrum UpsampledReflectance(Rgb rgb) {
  if (rgb.x == rgb.y && rgb.y == rgb.z) {
    return [value = rgb.x](double) { return value; };
  }
  return FitSigmoid(rgb);
}

Spectrum UpsampledColor(Rgb rgb) {
  const double scale = 2 * std::max({rgb.x, rgb.y, rgb.z});
  if (!(scale > 0)) return [](double) { return 0.0; };
  const Spectrum shape = UpsampledReflectance(rgb / scale);
  return [=](double nm) { return scale * shape(nm); };
}

const std::vector<float>& UpsamplingTable() {
  static const std::vector<float> table = MakeUpsamplingTable();
  return table;
}

SigmoidSpectrum SigmoidByTable(Rgb rgb) {
  static const auto rows = PolynomialThrough();
  static const double end = HalfTangentOfGrey(1 - kMinUpsampled);
  struct Axis {
    double part;
    std::size_t stride;
  };
  std::array<Axis, 3> axes;
  std::size_t at = 0, stride = 3;
  for (int i = 0; i < 3; ++i, stride *= kUpsamplingNodes) {
    const double v = std::clamp(rgb[i], kMinUpsampled, 1 - kMinUpsampled);
    const double x = (HalfTangentOfGrey(v) / end + 1) / 2 * (kUpsamplingNodes - 1);
    const double cell = std::clamp(std::floor(x), 0.0, kUpsamplingNodes - 2.0);
    axes[static_cast<std::size_t>(i)] = {x - cell, stride};
    at += stride * static_cast<std::size_t>(cell);
  }
  // From corner to corner along the axis of the largest part first.
  std::sort(axes.begin(), axes.end(), [](Axis a, Axis b) { return a.part > b.part; });
  const float* node = UpsamplingTable().data() + at;
  double weight = 1 - axes[0].part;
  Vec3d h = Vec3d{node[0], node[1], node[2]} * weight;
  for (std::size_t i = 0; i < 3; ++i) {
    node += axes[i].stride;
    weight = axes[i].part - (i < 2 ? axes[i + 1].part : 0);
    h += Vec3d{node[0], node[1], node[2]} * weight;
  }
  SigmoidSpectrum sigmoid;
  for (std::size_t k = 0; k < 3; ++k) {
    for (int i = 0; i < 3; ++i) {
      sigmoid.c[k] += rows[k][static_cast<std::size_t>(i)] * 2 * h[i] / (1 - h[i] * h[i]);
    }
  }
  return sigmoid;
}

}  // namespace lanelight
