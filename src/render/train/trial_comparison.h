// Which of two strategies is the more efficient, from short passes with both on the same
// pixels. Variances of short passes have heavy tails, so single pixels must not decide.
#pragma once

#include <cstddef>
#include <vector>

namespace lanelight {

/// What passes with one strategy have shown, by pixel.
struct TrialMeasure {
  double cost = 1;                // of a sample (TrainingSamples::Cost)
  std::vector<double> variances;  // of a sample, relative (RelativeVariances)

  /// Of all pixels.
  double Variance() const;
  /// 1 / efficiency: the mean of the variances without the worst thousandth of them,
  /// times the cost.
  double Score() const;
};

/// Both have the same pixels. `other` is better: its variance times cost is below
/// `margin` of that of `usual`, and that by so many standard errors of the difference
/// pixel by pixel. The worst thousandth of the pixels, by either, counts in neither.
bool IsClearlyBetter(const TrialMeasure& other, const TrialMeasure& usual, double margin,
                     double standard_errors = 2);

/// How many times as efficient another strategy is, by all pixels.
struct TrialGain {
  double log = 0;             // natural
  double standard_error = 0;  // of it, by the scatter of both over the pixels
  /// Without any one of the pixels. One bright sample may be in both measures (copies of
  /// paths tell of both), where it carries them without any scatter.
  double least = 0, most = 0;
};
/// Both have the same pixels. None without error in either; the least number if nothing
/// of the usual error was seen (variances may be negative), and the largest if none of
/// the other's.
TrialGain GainOf(const TrialMeasure& other, const TrialMeasure& usual);
/// The same without the worst thousandth of the pixels, by either.
TrialGain GainWithoutWorst(const TrialMeasure& other, const TrialMeasure& usual);

/// Pixels of equal variance that would scatter as much: 1 if a single one carries all,
/// and 0 of no variance. Its inverse is the square of the relative error of the
/// variances' sum.
double EffectivePixels(const std::vector<double>& variances);

/// How many of n values, sorted, count: all but the worst thousandth, and at least one is
/// left out of 16. A single bright sample would decide alone.
std::size_t KeptOf(std::size_t n);

/// Mean without the worst thousandth.
double RobustMean(std::vector<double> values);

}  // namespace lanelight
