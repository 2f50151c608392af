// Measurements of a study's renders, and their files, which allow a study to resume. Each
// strategy and sample count of a scene has a state file (src/base/state/state_file.h),
// which is written after every repetition.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "src/base/core/column.h"
#include "src/base/core/machine_info.h"
#include "src/base/core/vec.h"
#include "src/base/image/pixel_rect.h"
#include "src/base/stat/hypothesis.h"
#include "src/render/run/run.h"

namespace lanelight {

// X(type, name): one column each. Unknown numbers are NaN. Squared errors exclude the
// error of the reference, and may be negative by chance; `raw_relmse` includes it.
#define LANELIGHT_MEASUREMENT(X)                                                    \
  X(std::uint64_t, seed)                                                            \
  X(std::uint64_t, samples)                                                         \
  X(double, wall_seconds)                                                           \
  X(double, cpu_seconds)                                                            \
  X(double, pilot_seconds)                                                          \
  X(std::uint64_t, rays_closest)                                                    \
  X(std::uint64_t, rays_shadow)                                                     \
  X(double, mse)                                                                    \
  X(double, rmse)                                                                   \
  X(double, relmse)                                                                 \
  X(double, relmse_trimmed) /* without the worst kTrimmedFraction of the pixels */  \
  X(double, relmse_2)       /* of means over squares of 2 x 2 pixels, and so on */  \
  X(double, relmse_4)                                                               \
  X(double, relmse_8)                                                               \
  X(double, raw_relmse)                                                             \
  X(double,                                                                         \
    worst_share) /* part of raw_relmse in the worst kWorstFraction of the pixels */ \
  X(double, mape)                                                                   \
  X(double, mean_r)                                                                 \
  X(double, mean_g)                                                                 \
  X(double, mean_b)                                                                 \
  X(std::uint64_t, invalid)                                                         \
  X(double, self_relmse) /* the render's own estimate and its interval */           \
  X(double, self_low)                                                               \
  X(double, self_high)                                                              \
  X(std::uint64_t, worst_x) /* the worst pixel of raw_relmse */                     \
  X(std::uint64_t, worst_y)

inline constexpr double kTrimmedFraction = 0.01;

struct Measurement {
#define X(type, name) type name = Unknown<type>();
  LANELIGHT_MEASUREMENT(X)
#undef X
  MachineInfo machine;

  bool HasSelf() const { return self_low <= self_high; }
  bool SelfIntervalCovers() const { return self_low <= relmse && relmse <= self_high; }

 private:
  template <class T>
  static constexpr T Unknown() {
    if constexpr (std::numeric_limits<T>::has_quiet_NaN) {
      return std::numeric_limits<T>::quiet_NaN();
    }
    return {};
  }
};

/// Converts all members by name; NaN is null. Reading leaves missing members unknown.
void to_json(nlohmann::json& json, const Measurement& m);
void from_json(const nlohmann::json& json, Measurement& m);

/// Return names and values of the numbers, separated by commas; NaN is empty.
std::string CsvHeader();
std::string CsvRow(const Measurement& m);

class Moments {
 public:
  explicit Moments(std::size_t pixels = 0) : pixels_(pixels) {}

  void Add(const std::vector<Rgb>& image);

  std::size_t size() const { return pixels_.size(); }
  std::uint64_t count() const { return count_; }
  Rgb Mean(std::size_t pixel) const;
  /// Returns the variance of one render; zero for fewer than two.
  Rgb Variance(std::size_t pixel) const;
  /// Returns the variance of the mean of the three channels.
  double GreyVariance(std::size_t pixel) const;
  /// Returns the mean of the three channels over the repetitions.
  stat::MeanEstimate GreyEstimate(std::size_t pixel) const;

  /// Factor of path reuse on the variance of a mean of pixels, at most their number.
  double pixels_as_one = 1;

  /// Returns the sums for a state file.
  StateColumn Column() const;
  /// Returns a column that reads the sums of `count` images.
  MutableStateColumn Restore(std::uint64_t count);

 private:
  static constexpr int kPlanes = 4;  // red, green, blue, their mean
  struct Pixel {
    std::array<double, kPlanes> sum{}, squares{};
  };
  double PlaneVariance(const Pixel& pixel, int plane) const;

  std::vector<Pixel> pixels_;
  std::uint64_t count_ = 0;
};

/// The repetitions of one strategy at one sample count.
struct Cells {
  std::vector<Measurement> repetitions;
  std::vector<StageProfile> stages;  // sums over the repetitions
  Moments moments;
  std::vector<Rgb> first;  // image of the first repetition
};

class CellStore {
 public:
  /// Makes `folder` if needed. `window`: the pixels of all images; files of other pixels
  /// are errors.
  CellStore(std::string folder, const PixelRect& window);

  /// Reads the cells of a strategy (complete text form) at a sample count; empty if there
  /// are none. Throws InputError for an invalid file.
  Cells Load(const std::string& strategy, std::uint64_t spp) const;
  void Save(const std::string& strategy, std::uint64_t spp, const Cells& cells) const;

  const std::string& folder() const { return folder_; }

 private:
  std::string Path(const std::string& strategy, std::uint64_t spp) const;

  std::string folder_;
  PixelRect window_;
};

}  // namespace lanelight
