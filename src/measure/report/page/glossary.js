"use strict";
// What the measures mean, in short.

const TERMS = {
  "Relative MSE":
    "Squared difference from the reference, divided by the squared reference " +
      "+ 0.01, averaged over pixels, channels and repetitions. The reference's own error is " +
      "subtracted.",
  Trimmed:
    "Relative MSE without the worst 1 % of the pixels of each render. If it is much " +
      "smaller than the relative MSE, a few bright pixels dominate the error.",
  RMSE: "Root of the mean squared difference, in the image's own units.",
  MAPE: "Mean absolute percentage error: mean of |image − reference| / reference.",
  "Variance and bias²":
    "The two parts of the relative MSE: variance differs between repetitions, " +
      "bias² does not. Bias² is an estimate and can be negative by chance.",
  "Bias and p":
    "Bias: (mean of the image − mean of the reference) / mean of the reference. p: " +
      "probability of a bias at least this large by chance (Welch's test).",
  Efficiency:
    "1 / (relative MSE × processor seconds), relative to the baseline. It does " +
      "not depend on the sample count while the relative MSE falls as 1 / samples. With " +
      "--budget, the interval includes the uncertainty of the sample counts.",
  Rank:
    "Range of ranks that the intervals allow. Strategies with equal ranges are " +
      "not significantly different in this study.",
  Order:
    "Slope of log RMSE over log samples: −0.5 for independent samples, more negative " +
      "where a low-discrepancy sampler converges faster.",
  "To the target":
    "Samples and processor time needed to reach the target relative MSE. Values " +
      "beyond the measured sample counts are marked as extrapolated (*).",
  Coverage:
    "Percentage of renders whose own confidence interval contains the true error. " +
      "It should be near the stated confidence level.",
  "Heavy tails":
    "Rare bright samples cause most of the error, and a few renders may miss " +
      "them. The measured error is then too small and the intervals are unreliable.",
  "Processor time":
    "Sum over threads, median of the repetitions, excluding scene loading and " +
      "BVH build. Runs are interleaved, so a slow phase of the machine affects all equally.",
};
