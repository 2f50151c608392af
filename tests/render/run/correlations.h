// Correlations of the errors of pixels, measured from renders with different seeds.
#pragma once

#include <cmath>
#include <vector>

namespace lanelight::test {

/// Returns the mean over all pixels of the sum of the squared correlations of a pixel
/// with all of them; renders[i][p]: pixel p of render i. Over renders, the variance of
/// the mean of squared z-scores of n normal pixels is 2 / n times that.
inline double SquaredCorrelations(const std::vector<std::vector<double>>& renders) {
  const double n = double(renders.size()), pixels = double(renders[0].size());
  std::vector<double> squares(renders.size());
  for (std::size_t p = 0; p < renders[0].size(); ++p) {
    double sum = 0, scatter = 0;
    for (const auto& render : renders) sum += render[p];
    for (const auto& render : renders) scatter += std::pow(render[p] - sum / n, 2);
    for (std::size_t i = 0; i < renders.size(); ++i) {
      squares[i] += std::pow(renders[i][p] - sum / n, 2) / scatter * (n - 1) / pixels;
    }
  }
  double variance = 0;
  for (const double s : squares) variance += std::pow(s - (n - 1) / n, 2) / (n - 1);
  return pixels / 2 * variance;
}

}  // namespace lanelight::test
