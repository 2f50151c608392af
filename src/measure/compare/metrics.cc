#include "src/measure/compare/metrics.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "src/base/core/error.h"
#include "src/base/image/image.h"
#include "src/base/stat/interval.h"
#include "src/measure/compare/tile_test.h"

namespace lanelight {
namespace {

// Fraction of the largest errors that the trimmed metric leaves out.
constexpr double kTrim = 0.001;
constexpr int kTileSide = 16;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

// One colour channel present in both images, with its variances (-1 = none).
struct Channel {
  std::string name;
  int test, reference, test_variance, reference_variance;
};

std::vector<Channel> CommonChannels(const Image& test, const Image& reference,
                                    bool exact_reference) {
  const auto has_all = [&](const std::vector<std::string>& names) {
    return std::ranges::all_of(names, [&](const std::string& name) {
      return test.FindChannel(name) >= 0 && reference.FindChannel(name) >= 0;
    });
  };
  std::vector<std::string> names = {"R", "G", "B"};
  if (!has_all(names)) names = {"Y"};
  if (!has_all(names)) {
    throw InputError("the images share neither R, G, B nor Y: one has {}, the other {}",
                     fmt::join(test.names, ", "), fmt::join(reference.names, ", "));
  }
  std::vector<Channel> channels;
  for (const std::string& name : names) {
    const std::string variance = "variance." + name;
    channels.push_back({name, test.FindChannel(name), reference.FindChannel(name),
                        test.FindChannel(variance),
                        exact_reference ? -1 : reference.FindChannel(variance)});
  }
  return channels;
}

// Means of the tiles of one channel.
class TileGrid {
 public:
  TileGrid(int width, int height, int tile)
      : layout_{tile, (width + tile - 1) / tile, (height + tile - 1) / tile},
        tiles_(layout_.size()) {}

  void Add(int x, int y, double a, double b) {
    Tile& tile = tiles_[layout_.At(x, y)];
    tile.test += a, tile.reference += b, ++tile.count;
  }
  void AppendErrors(std::vector<double>* errors) const {
    for (const Tile& t : tiles_) {
      if (t.count == 0) continue;
      const double b = t.reference / t.count, d = t.test / t.count - b;
      errors->push_back(d * d / (b * b + kRelativeEpsilon));
    }
  }

 private:
  struct Tile {
    double test = 0, reference = 0, count = 0;
  };
  TileLayout layout_;
  std::vector<Tile> tiles_;
};

// Returns the mean without the largest fraction `fraction` of the values.
double TrimmedMean(std::vector<double> values, double fraction) {
  const std::size_t keep = values.size() - std::size_t(fraction * double(values.size()));
  if (keep == 0) return kNan;
  std::nth_element(values.begin(), values.begin() + (keep - 1), values.end());
  double sum = 0;
  for (std::size_t i = 0; i < keep; ++i) sum += values[i];
  return sum / double(keep);
}

double Ratio(double test, double reference) {
  return test == 0 && reference == 0 ? 1 : test / reference;
}

// Sums over all channels and pixels.
class Comparison {
 public:
  Comparison(const Image& test, const Image& reference, bool exact_reference)
      : test_(test),
        reference_(reference),
        exact_reference_(exact_reference),
        test_unit_(VarianceUnit(test)),
        reference_unit_(VarianceUnit(reference)) {}

  CompareResult Run() {
    result_.width = test_.width;
    result_.height = test_.height;
    for (const Channel& channel : CommonChannels(test_, reference_, exact_reference_)) {
      AddChannel(channel);
    }
    return Finish();
  }

 private:
  void AddChannel(const Channel& channel) {
    result_.channels.push_back(channel.name);
    const bool variances = channel.test_variance >= 0 || channel.reference_variance >= 0;
    has_variance_ |= variances;
    TileGrid tiles(test_.width, test_.height, kTileSide);
    std::vector<TileGrid> squares;
    for (int side : kFilterSides) {
      squares.emplace_back(test_.width, test_.height, side);
    }
    double sum_a = 0, sum_b = 0;
    std::uint64_t count = 0;
    for (int y = 0; y < test_.height; ++y) {
      for (int x = 0; x < test_.width; ++x) {
        const double a = LinearValue(test_, x, y, channel.test);
        const double b = LinearValue(reference_, x, y, channel.reference);
        result_.invalid_test += !std::isfinite(a);
        result_.invalid_reference += !std::isfinite(b);
        if (!std::isfinite(a) || !std::isfinite(b)) continue;
        AddSample(a, b);
        tiles.Add(x, y, a, b);
        for (TileGrid& grid : squares) grid.Add(x, y, a, b);
        if (variances) z_.Add(a - b, Variance(channel, x, y));
        sum_a += a, sum_b += b, ++count;
      }
    }
    tiles.AppendErrors(&tile_errors_);
    for (std::size_t k = 0; k < kFilters; ++k) {
      squares[k].AppendErrors(&filtered_[k]);
    }
    const double n = double(count);
    result_.mean_test.push_back(sum_a / n);
    result_.mean_reference.push_back(sum_b / n);
    result_.mean_ratio.push_back(Ratio(sum_a, sum_b));
  }

  double Variance(const Channel& channel, int x, int y) const {
    double sum = 0;
    if (channel.test_variance >= 0) {
      sum += test_unit_ * LinearValue(test_, x, y, channel.test_variance);
    }
    if (channel.reference_variance >= 0) {
      sum += reference_unit_ * LinearValue(reference_, x, y, channel.reference_variance);
    }
    return sum;
  }

  void AddSample(double a, double b) {
    const double d = a - b;
    squares_ += d * d;
    absolute_ += std::abs(d);
    percentage_ += std::abs(d) / (std::abs(b) + kRelativeEpsilon);
    peak_ = std::max(peak_, b);
    relative_.push_back(d * d / (b * b + kRelativeEpsilon));
  }

  CompareResult Finish() {
    const double n = double(relative_.size());  // 0: every mean becomes NaN
    result_.samples = relative_.size();
    result_.mse = squares_ / n;
    result_.rmse = std::sqrt(result_.mse);
    result_.mae = absolute_ / n;
    result_.mape = percentage_ / n;
    result_.relmse = TrimmedMean(relative_, 0);
    result_.relmse_trimmed = TrimmedMean(std::move(relative_), kTrim);
    for (std::size_t k = 0; k < kFilters; ++k) {
      result_.relmse_filtered[k] = TrimmedMean(std::move(filtered_[k]), 0);
    }
    result_.psnr = result_.mse == 0 ? std::numeric_limits<double>::infinity()
                                    : 10 * std::log10(peak_ * peak_ / result_.mse);
    result_.tile_relmse_max =
        tile_errors_.empty() ? kNan : *std::ranges::max_element(tile_errors_);
    result_.tile_relmse_median = stat::Median(std::move(tile_errors_));
    if (has_variance_) result_.z = z_.Finish();
    return result_;
  }

  const Image& test_;
  const Image& reference_;
  const bool exact_reference_;
  const double test_unit_, reference_unit_;  // of their variances
  CompareResult result_;
  ZCollector z_;
  bool has_variance_ = false;
  std::vector<double> relative_, tile_errors_;
  std::array<std::vector<double>, kFilters> filtered_;
  double squares_ = 0, absolute_ = 0, percentage_ = 0, peak_ = 0;
};

}  // namespace

CompareResult CompareImages(const Image& test, const Image& reference,
                            bool exact_reference) {
  if (test.width != reference.width || test.height != reference.height) {
    throw InputError("the images differ in size: {} x {} and {} x {}", test.width,
                     test.height, reference.width, reference.height);
  }
  return Comparison(test, reference, exact_reference).Run();
}

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(ZScores, available, count, exact, mismatched, invalid,
                                   mean, standard_deviation, beyond_2, beyond_3,
                                   ks_distance)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(CompareResult, width, height, channels, samples,
                                   invalid_test, invalid_reference, mse, rmse, mae,
                                   relmse, relmse_trimmed, relmse_filtered, mape, psnr,
                                   mean_test, mean_reference, mean_ratio,
                                   tile_relmse_median, tile_relmse_max, z)

nlohmann::json ToJson(const CompareResult& result) { return result; }

}  // namespace lanelight
