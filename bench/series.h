// Repeated measurements of one thing.
#pragma once

#include <algorithm>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <vector>

namespace lanelight::bench {

class Series {
 public:
  void Add(double value) { values_.push_back(value); }
  double Median() const { return Quantile(0.5); }
  double Min() const { return Quantile(0); }
  double Max() const { return Quantile(1); }
  nlohmann::json Json() const {
    return {{"median", Median()}, {"least", Min()}, {"most", Max()}};
  }

 private:
  // Between two values where it falls between them.
  double Quantile(double q) const {
    std::vector<double> sorted = values_;
    std::sort(sorted.begin(), sorted.end());
    const double at = q * double(sorted.size() - 1);
    const std::size_t low = static_cast<std::size_t>(at);
    const std::size_t high = std::min(low + 1, sorted.size() - 1);
    return sorted[low] + (at - double(low)) * (sorted[high] - sorted[low]);
  }

  std::vector<double> values_;
};

}  // namespace lanelight::bench
