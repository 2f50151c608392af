// Orders of convergence of the samplers: slope of log RMSE over log N, for one group of N
// points in two dimensions.
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <numbers>

#include "tests/points/draw.h"

namespace lanelight::test {
namespace {

using Integrand = std::function<double(double, double)>;

[[maybe_unused]] double CosineProduct(double x, double y) {
  return std::cos(std::numbers::pi * x) * std::cos(2 * y);
}
[[maybe_unused]] double Disk(double x, double y) { return x * x + y * y < 0.6 ? 1 : 0; }

// Root mean square error over pixels of the mean of n points.
double Rmse(Points points, std::uint32_t n, const Integrand& f, double exact) {
  constexpr std::uint32_t kPixels = 256;
  const std::uint32_t group = points == Points::kIndependent ? 1 : n;
  const Drawn p = Draw({points, 5, 1000, group, 7, 0, n, kPixels});
  double sum = 0;
  for (std::size_t pixel = 0; pixel < kPixels; ++pixel) {
    double mean = 0;
    for (std::size_t i = 0; i < n; ++i) {
      mean += f(p.u0[i * kPixels + pixel], p.u1[i * kPixels + pixel]);
    }
    mean = mean / n - exact;
    sum += mean * mean;
  }
  return std::sqrt(sum / kPixels);
}

double Slope(Points points, const Integrand& f, double exact) {
  const std::uint32_t most = std::min(4096u, MostGroupSize(points));
  const std::uint32_t last = points == Points::kIndependent ? 4096 : most;
  std::vector<double> x, y;
  for (std::uint32_t n = 4; n <= last; n *= 4) {
    x.push_back(std::log(double(n)));
    y.push_back(std::log(Rmse(points, n, f, exact)));
  }
  double mean_x = 0, mean_y = 0, xy = 0, xx = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    mean_x += x[i] / x.size();
    mean_y += y[i] / x.size();
  }
  for (std::size_t i = 0; i < x.size(); ++i) {
    xy += (x[i] - mean_x) * (y[i] - mean_y);
    xx += (x[i] - mean_x) * (x[i] - mean_x);
  }
  return xy / xx;
}

}  // namespace

TEST_CASE("X") {
  const auto xy = [](double x, double y) { return x * y; };
  for (Points points : {Points::kHalton, Points::kLattice, Points::kStratified})
    for (unsigned n : {16,  18,  24,  25,  27,   32,   36,   48,   54,  64,  72,  250,
                       256, 288, 243, 324, 1000, 1009, 1024, 1152, 864, 972, 1296})
      std::printf("%s %d rmse*n %g\n", Name(points), n, Rmse(points, n, xy, 0.25) * n);
  for (Points points : kAllPoints) {
    std::printf("%s: %g %g %g\n", Name(points),
                Slope(
                    points, [](double x, double y) { return x + y; }, 1),
                Slope(
                    points, [](double x, double) { return x; }, 0.5),
                Slope(
                    points,
                    [](double x, double y) {
                      return (std::cos(2 * std::numbers::pi * x) + x * (1 - x) - 1. / 6) *
                             (y * (1 - y) - 1. / 6);
                    },
                    0));
  }
}
}  // namespace lanelight::test
