// Order of convergence: least-squares slope of log y over log x.
#pragma once

#include <cmath>
#include <vector>

namespace lanelight::test {

inline double LogSlope(const std::vector<double>& x, const std::vector<double>& y) {
  const double n = double(x.size());
  double mx = 0, my = 0, xy = 0, xx = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    mx += std::log(x[i]) / n;
    my += std::log(y[i]) / n;
  }
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double dx = std::log(x[i]) - mx;
    xy += dx * (std::log(y[i]) - my);
    xx += dx * dx;
  }
  return xy / xx;
}

}  // namespace lanelight::test
