"use strict";
// What the measures mean, in short.

const TERMS = {
  "Relative MSE":
    "Squared difference from the reference, divided by the squared reference " +
      "+ 0.01, averaged over pixels, channels and repetitions. The reference's own error is " +
      "subtracted.",
  Trimmed:
    "The same without the worst 1 % of the pixels of each render. Where it is much " +
      "smaller, a few bright pixels make the error.",
  RMSE: "Root of the mean squared difference, in the image's own units.",
  MAPE: "Mean of the absolute difference relative to the reference.",
  "Variance and bias²":
    "The two parts of the relative MSE: what changes from repetition to " +
      "repetition, and what stays. Bias² is estimated and can be below zero by chance.",
  "Bias and p":
    "Mean of the image less that of the reference, relative to it; p is the " +
      "chance of a difference at least this large if there were none (Welch's test).",
  Efficiency:
    "1 / (relative MSE × processor seconds), relative to the baseline. It does " +
      "not depend on the sample count as long as the error falls like 1 / samples; where " +
      "a budget sets the counts, how sure these are is in the interval.",
  Rank:
    "The places that a strategy may have, given the intervals. Overlapping ranges are " +
      "not distinguishable by this study.",
  Order:
    "Slope of log RMSE over log samples: −0.5 for independent samples, lower where " +
      "well-spread samples pay.",
  "To the target":
    "Samples and time until the relative MSE is the target's, between the " +
      "levels that were measured; beyond them it is marked as extrapolated.",
  Coverage:
    "How often the interval that a render states of its own error held the true " +
      "error. It should be near the stated confidence.",
  "Heavy tails":
    "Rare bright samples carry most of the error, so that a few renders may " +
      "miss them all: errors look smaller than they are and intervals may not hold.",
  "Processor time":
    "Summed over threads, median of the repetitions, without loading and " +
      "building. Runs were interleaved, so that a slow phase of the machine hits all alike.",
};
