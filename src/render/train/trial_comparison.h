// Compares two strategies by short passes on the same pixels. Variances of short passes
// have heavy tails, so single pixels must not decide.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace lanelight {

/// Results of passes with one strategy, by pixel.
struct TrialMeasure {
  double cost = 1;                // of a sample (TrainingSamples::Cost)
  std::vector<double> variances;  // of a sample, relative (RelativeVariances)

  /// Returns the sum over all pixels.
  double Variance() const;
  /// Returns 1 / efficiency: the mean of the variances without the worst thousandth,
  /// times the cost.
  double Score() const;
};

/// Returns whether `other` is better on the same pixels: its variance times cost is below
/// `margin` times that of `baseline`, by so many standard errors of the difference pixel
/// by pixel. Omits the worst thousandth of the pixels, by either.
bool IsClearlyBetter(const TrialMeasure& other, const TrialMeasure& baseline,
                     double margin, double standard_errors = 2);

/// Relative efficiency of a strategy, by all pixels.
struct TrialGain {
  double log = 0;             // natural
  double standard_error = 0;  // of it, by the scatter of both over the pixels
  /// Least gain when any one pixel is omitted: one bright sample may be in both measures
  /// (copies of paths) and carry them without any scatter.
  double minimum = 0;
};
/// Returns the gain on the same pixels: none without error in either, the least number if
/// none of the baseline error was seen (variances may be negative), the largest if none
/// of the other's was.
TrialGain GainOf(const TrialMeasure& other, const TrialMeasure& baseline);
/// Returns the gain without the worst pixels, by either: the worst thousandth, or so
/// many.
TrialGain GainWithoutWorst(const TrialMeasure& other, const TrialMeasure& baseline,
                           std::optional<std::size_t> omitted = std::nullopt);

/// Returns the effective number of pixels: 1 if a single one carries all variance, 0
/// without variance. Its inverse is the squared relative error of the variances' sum.
double EffectivePixels(const std::vector<double>& variances);

/// Returns how many of n sorted values count: all but the worst thousandth, and at least
/// one of 16 is omitted.
std::size_t KeptOf(std::size_t n);

/// Returns the mean without the worst thousandth.
double RobustMean(std::vector<double> values);

}  // namespace lanelight
