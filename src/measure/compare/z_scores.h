// Gathers the z-scores of a comparison.
#pragma once

#include <vector>

#include "src/measure/compare/metrics.h"

namespace lanelight {

class ZCollector {
 public:
  /// A difference and the variance it should have by noise alone. Zero, negative and
  /// invalid variances give no score and are counted apart.
  void Add(double difference, double variance);

  /// Summary of all scores so far.
  ZScores Finish();

 private:
  // Largest gap between the empirical distribution function and the normal one; sorts.
  double KsDistance();

  ZScores scores_;
  std::vector<double> z_;
};

}  // namespace lanelight
