#include "tests/measure/report/synthetic_images.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>

namespace lanelight {
namespace {

using Pixel = std::function<double(double u, double v, int channel, int index)>;

ReportImage FromFormula(const std::string& name, int channels, const Pixel& pixel) {
  ReportImage image{name, kSyntheticWidth, kSyntheticHeight, channels, {}};
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      for (int c = 0; c < channels; ++c) {
        const double u = (x + 0.5) / image.width, v = (y + 0.5) / image.height;
        const int index = (y * image.width + x) * channels + c;
        image.values.push_back(float(pixel(u, v, c, index)));
      }
    }
  }
  return image;
}

// A ball with its shadow before a wall, red on the left and green on the right.
double Room(double u, double v, int c) {
  const double x = (u - 0.5) * 4 / 3, y = v - 0.58;
  const double r2 = (x * x + y * y) / (0.24 * 0.24);
  if (r2 < 1) {
    const double z = std::sqrt(1 - r2);
    const double lit = std::max(0.0, (-0.45 * x - 0.6 * y) / 0.24 + 0.62 * z);
    const double glint = std::pow(std::max(0.0, lit / 1.05), 60) * 8;
    return (0.04 + 0.7 * lit) * (c == 2 ? 1.0 : c == 1 ? 0.82 : 0.66) + glint;
  }
  if (v < 0.06 && std::abs(u - 0.5) < 0.14) return c == 2 ? 9 : 12;
  const double side[3] = {0.2 + 0.5 * (1 - u), 0.2 + 0.35 * u, 0.22};
  const double floor = v > 0.8 ? 0.75 : 1.0;
  const double dx = x - 0.07, dy = (v - 0.85) * 2.6;
  const double shadow = 1 - 0.75 * std::exp(-(dx * dx + dy * dy) / 0.05);
  return side[c] * floor * shadow * (0.35 + 0.65 * std::exp(-1.8 * v)) +
         0.08 * std::exp(-20 * (u - 0.5) * (u - 0.5) - 6 * v);
}

double NoiseScale(double v, double noise) { return noise * (0.35 + 1.1 * v); }

double BiasedFraction(double u, double v, double bias) {
  return u > 0.6 && v > 0.6 ? bias : 0.0;
}

// Close to normal, mean 0, variance 1: twelve uniform numbers would do; four are enough.
double Noise(int seed, int index) {
  double sum = 0;
  for (int i = 0; i < 4; ++i) sum += SyntheticRandom(seed * 4 + i, index) - 0.5;
  return sum * std::sqrt(3.0);
}

}  // namespace

double SyntheticRandom(int seed, int index) {
  std::uint64_t x = std::uint64_t(seed) * 0x9e3779b97f4a7c15u + std::uint64_t(index) + 1;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return double((x ^ (x >> 31)) >> 11) * 0x1p-53;
}

ReportImage SyntheticReference(const std::string& name) {
  return FromFormula(name, 3,
                     [](double u, double v, int c, int) { return Room(u, v, c); });
}

ReportImage SyntheticRender(const std::string& name, double noise, double bias,
                            int seed) {
  return FromFormula(name, 3, [=](double u, double v, int c, int index) {
    const double relative =
        1 + BiasedFraction(u, v, bias) + NoiseScale(v, noise) * Noise(seed, index);
    return std::max(0.0, Room(u, v, c) * relative);
  });
}

ReportImage SyntheticVariance(const std::string& name, double noise) {
  return FromFormula(name, 3, [=](double u, double v, int c, int) {
    const double deviation = Room(u, v, c) * NoiseScale(v, noise);
    return deviation * deviation;
  });
}

ReportImage SyntheticBias(const std::string& name, double noise, double bias, int seed) {
  return FromFormula(name, 3, [=](double u, double v, int c, int index) {
    return Room(u, v, c) *
           (BiasedFraction(u, v, bias) + NoiseScale(v, noise) * Noise(seed, index) / 3);
  });
}

}  // namespace lanelight
