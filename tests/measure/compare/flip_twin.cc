#include "tests/measure/compare/flip_twin.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace lanelight {
namespace {

using Color = std::array<double, 3>;
using Weights = std::vector<std::vector<double>>;

// IEC 61966-2-1 (sRGB, D65), and its inverse, to four and five digits.
constexpr double kXyz[3][3] = {{0.4124564, 0.3575761, 0.1804375},
                               {0.2126729, 0.7151522, 0.0721750},
                               {0.0193339, 0.1191920, 0.9503041}};
constexpr double kRgb[3][3] = {{3.2404542, -1.5371385, -0.4985314},
                               {-0.9692660, 1.8760108, 0.0415560},
                               {0.0556434, -0.2040259, 1.0572252}};
constexpr double kWhite[3] = {0.95047, 1, 1.08883};

Color Times(const double (&m)[3][3], const Color& v) {
  Color out;
  for (int i = 0; i < 3; ++i) {
    out[i] = m[i][0] * v[0] + m[i][1] * v[1] + m[i][2] * v[2];
  }
  return out;
}

Color ToYcxcz(const Color& rgb) {
  const Color xyz = Times(kXyz, rgb);
  const double x = xyz[0] / kWhite[0], y = xyz[1] / kWhite[1], z = xyz[2] / kWhite[2];
  return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

Color FromYcxcz(const Color& c) {
  const double y = (c[0] + 16) / 116, x = c[1] / 500 + y, z = y - c[2] / 200;
  return Times(kRgb, {x * kWhite[0], y * kWhite[1], z * kWhite[2]});
}

Color HuntedLab(const Color& rgb) {
  const Color xyz = Times(kXyz, rgb);
  const auto f = [](double t) {
    return t > 216.0 / 24389 ? std::cbrt(t) : t * 841 / 108 + 4.0 / 29;
  };
  const double x = f(xyz[0] / kWhite[0]), y = f(xyz[1]), z = f(xyz[2] / kWhite[2]);
  const double lightness = 116 * y - 16;
  return {lightness, 0.01 * lightness * 500 * (x - y), 0.01 * lightness * 200 * (y - z)};
}

double Distance(const Color& a, const Color& b) {
  return std::abs(a[0] - b[0]) +
         std::sqrt(std::pow(a[1] - b[1], 2) + std::pow(a[2] - b[2], 2));
}

double Spread(double distance) {
  const double largest =
      std::pow(Distance(HuntedLab({0, 1, 0}), HuntedLab({0, 0, 1})), 0.7);
  const double error = std::pow(distance, 0.7);
  return error < 0.4 * largest ? 0.95 * error / (0.4 * largest)
                               : 0.95 + 0.05 * (error - 0.4 * largest) / (0.6 * largest);
}

double SensitivityAt(int channel, double degrees2) {
  const auto term = [&](double a, double b) {
    return a * std::sqrt(M_PI / b) * std::exp(-M_PI * M_PI * degrees2 / b);
  };
  if (channel == 0) return term(1, 0.0047);
  if (channel == 1) return term(1, 0.0053);
  return term(34.1, 0.04) + term(13.5, 0.025);
}

Weights SensitivityWeights(int channel, double ppd) {
  const int r =
      static_cast<int>(std::ceil(3 * std::sqrt(0.04 / (2 * M_PI * M_PI)) * ppd));
  Weights w(2 * r + 1, std::vector<double>(2 * r + 1));
  double sum = 0;
  for (int y = -r; y <= r; ++y) {
    for (int x = -r; x <= r; ++x) {
      w[y + r][x + r] = SensitivityAt(channel, (x * x + y * y) / (ppd * ppd));
      sum += w[y + r][x + r];
    }
  }
  for (auto& row : w) {
    for (double& v : row) v /= sum;
  }
  return w;
}

Weights DetectorWeights(bool edges, bool transposed, double ppd) {
  const double sd = 0.5 * 0.082 * ppd;
  const int r = static_cast<int>(std::ceil(3 * sd));
  Weights w(2 * r + 1, std::vector<double>(2 * r + 1));
  double above = 0, below = 0;
  for (int y = -r; y <= r; ++y) {
    for (int x = -r; x <= r; ++x) {
      const int along = transposed ? y : x;
      const double bell = std::exp(-(x * x + y * y) / (2 * sd * sd));
      const double v = (edges ? -along : along * along / (sd * sd) - 1) * bell;
      w[y + r][x + r] = v;
      (v > 0 ? above : below) += std::abs(v);
    }
  }
  for (auto& row : w) {
    for (double& v : row) v /= v > 0 ? above : below;
  }
  return w;
}

template <class Value>
double Filtered(const LinearImage& image, int x, int y, const Weights& w,
                const Value& value) {
  const int r = static_cast<int>(w.size() / 2);
  double sum = 0;
  for (int dy = -r; dy <= r; ++dy) {
    for (int dx = -r; dx <= r; ++dx) {
      const int px = std::clamp(x + dx, 0, image.width - 1);
      const int py = std::clamp(y + dy, 0, image.height - 1);
      sum += w[dy + r][dx + r] * value(static_cast<std::size_t>(py) * image.width + px);
    }
  }
  return sum;
}

Color ShownAt(const LinearImage& image, std::size_t i) {
  Color out;
  for (int c = 0; c < 3; ++c) out[c] = std::clamp<double>(image.planes[c][i], 0, 1);
  return out;
}

class PlainEye {
 public:
  explicit PlainEye(double ppd) {
    for (int c = 0; c < 3; ++c) sensitivity_[c] = SensitivityWeights(c, ppd);
    for (int edges = 0; edges < 2; ++edges) {
      for (int t = 0; t < 2; ++t) detectors_[edges][t] = DetectorWeights(edges, t, ppd);
    }
  }

  Color Lab(const LinearImage& image, int x, int y) const {
    Color filtered;
    for (int c = 0; c < 3; ++c) {
      filtered[c] = Filtered(image, x, y, sensitivity_[c], [&](std::size_t i) {
        return ToYcxcz(ShownAt(image, i))[c];
      });
    }
    Color rgb = FromYcxcz(filtered);
    for (double& v : rgb) v = std::clamp(v, 0.0, 1.0);
    return HuntedLab(rgb);
  }

  double Feature(const LinearImage& image, int x, int y, bool edges) const {
    const auto grey = [&](std::size_t i) {
      return (ToYcxcz(ShownAt(image, i))[0] + 16) / 116;
    };
    return std::hypot(Filtered(image, x, y, detectors_[edges][0], grey),
                      Filtered(image, x, y, detectors_[edges][1], grey));
  }

 private:
  Weights sensitivity_[3], detectors_[2][2];
};

}  // namespace

std::vector<double> PlainFlip(const LinearImage& reference, const LinearImage& test,
                              double pixels_per_degree) {
  const PlainEye eye(pixels_per_degree);
  std::vector<double> map;
  for (int y = 0; y < test.height; ++y) {
    for (int x = 0; x < test.width; ++x) {
      const double color =
          Spread(Distance(eye.Lab(reference, x, y), eye.Lab(test, x, y)));
      double feature = 0;
      for (bool edges : {false, true}) {
        feature = std::max(feature, std::abs(eye.Feature(reference, x, y, edges) -
                                             eye.Feature(test, x, y, edges)));
      }
      map.push_back(std::pow(color, 1 - std::sqrt(feature / std::sqrt(2.0))));
    }
  }
  return map;
}

double PlainColorError(const double (&a)[3], const double (&b)[3]) {
  return Spread(Distance(HuntedLab({a[0], a[1], a[2]}), HuntedLab({b[0], b[1], b[2]})));
}

}  // namespace lanelight
