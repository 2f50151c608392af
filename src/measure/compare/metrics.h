// Error metrics of an image, and z-scores that show whether noise explains the error.
#pragma once

#include <array>
#include <cstdint>
#include <iterator>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "src/base/image/image.h"
#include "src/base/stat/relative_error.h"

namespace lanelight {

/// Sides in pixels of box filters for relmse_filtered, which shows whether errors of
/// neighbouring pixels are correlated.
inline constexpr int kFilterSides[] = {2, 4, 8};
inline constexpr std::size_t kFilters = std::size(kFilterSides);

/// Errors have heavy tails if the worst kWorstFraction of the pixels carry more than
/// kHeavyTail of the squared error.
inline constexpr double kWorstFraction = 0.001, kHeavyTail = 0.3;

/// Distribution of z = (test - reference) / sqrt(variance of test + variance of
/// reference) over pixels and channels: standard normal if noise alone separates the
/// images and the variances are right.
struct ZScores {
  bool available = false;        // at least one image carries variances
  std::uint64_t count = 0;       // samples with a z-score
  std::uint64_t exact = 0;       // zero variance, equal values: no z-score, no evidence
  std::uint64_t mismatched = 0;  // zero variance, different values: certainly different
  std::uint64_t invalid = 0;     // variance negative or not finite
  double mean = 0, standard_deviation = 0;
  double beyond_2 = 0,
         beyond_3 = 0;     // fractions of |z| > 2 (normal: 0.0455), > 3 (0.0027)
  double ks_distance = 0;  // Kolmogorov-Smirnov distance to the standard normal
};

/// Metrics over pixels and colour channels, without samples that are not finite in either
/// image. Without any finite sample the means are NaN: write a
/// limit as !(relmse <= limit).
struct CompareResult {
  int width = 0, height = 0;
  std::vector<std::string> channels;
  std::uint64_t samples = 0;  // compared: pixels * channels less the invalid ones
  std::uint64_t invalid_test = 0, invalid_reference = 0;  // NaN or infinite samples
  double mse = 0, rmse = 0, mae = 0;
  double relmse = 0;          // mean of (a-b)^2 / (b^2 + kRelativeEpsilon)
  double relmse_trimmed = 0;  // the same without the largest 0.1 %
  /// relMSE of the means of squares with kFilterSides, from the image's corner on. Errors
  /// of independent pixels fall as 1 / side^2.
  std::array<double, kFilters> relmse_filtered = {};
  double mape = 0;  // mean of |a-b| / (|b| + kRelativeEpsilon); 1 = 100 %
  double psnr = 0;  // dB, peak = largest reference value; infinite if equal
  std::vector<double> mean_test, mean_reference;  // per channel
  std::vector<double> mean_ratio;                 // test / reference; 1 if both are 0
  double tile_relmse_median = 0;  // of the means of tiles of 16 x 16 pixels
  double tile_relmse_max = 0;     // over tiles and channels
  ZScores z;
};

/// Compares the colour channels of two images (8-bit ones are decoded as sRGB). Variances
/// are taken from the channels "variance.R", ... of each image that has them. Throws
/// InputError that states both sizes if they differ, and if the colour channels do. An
/// exact reference has no noise: z-scores use the variance of `test` only.
CompareResult CompareImages(const Image& test, const Image& reference,
                            bool exact_reference = false);

/// Writes all members by name; numbers that are not finite become null in texts.
nlohmann::json ToJson(const CompareResult& result);

class ZCollector {
 public:
  /// Adds a difference and its variance by noise alone. Zero, negative and invalid
  /// variances give no score and are counted separately.
  void Add(double difference, double variance);

  /// Returns the summary of all scores.
  ZScores Finish();

 private:
  // Returns the largest gap between the empirical and the normal distribution function.
  double KsDistance();

  ZScores scores_;
  std::vector<double> z_;
};

}  // namespace lanelight
