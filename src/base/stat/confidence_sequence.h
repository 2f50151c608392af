// Intervals that hold at all looks at growing data together, not only at one chosen
// beforehand: a reader who stops when an interval looks good is not misled.
#pragma once

namespace lanelight::stat {

/// How many standard errors either side of an estimate has, so that the intervals hold at
/// all looks from the first one on together, with probability `confidence`. `growth` >=
/// 1: the data over that of the first look, in intrinsic time (the variance of the
/// martingale that the estimate is made of). Grows as the root of the logarithm of
/// `growth`.
///
/// Robbins' normal mixture (1970, "Statistical methods related to the law of the iterated
/// logarithm", Annals of Mathematical Statistics 41), with the variance of the mixture at
/// the first look. For sums that are normal only in the limit it is an asymptotic
/// confidence sequence (Waudby-Smith, Arbour, Sinha, Kennedy and Ramdas 2024,
/// "Time-uniform central limit theory and asymptotic confidence sequences", Annals of
/// Statistics 52).
double TimeUniformQuantile(double growth, double confidence);

}  // namespace lanelight::stat
