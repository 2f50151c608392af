// What one render of a study is measured to be: the row of study.csv.
#pragma once

#include <cstdint>
#include <limits>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "src/base/core/machine_info.h"

namespace lanelight {

// X(type, name): one column each. Numbers that are not known are NaN. The squared errors
// are those against the reference less the reference's own (they may be negative by
// chance); `raw_relmse` still has it.
#define LANELIGHT_MEASUREMENT(X)                                                         \
  X(std::uint64_t, seed)                                                                 \
  X(std::uint64_t, samples)                                                              \
  X(double, wall_seconds)                                                                \
  X(double, cpu_seconds)                                                                 \
  X(double, pilot_seconds)                                                               \
  X(std::uint64_t, rays_closest)                                                         \
  X(std::uint64_t, rays_shadow)                                                          \
  X(double, mse)                                                                         \
  X(double, rmse)                                                                        \
  X(double, relmse)                                                                      \
  X(double, relmse_trimmed) /* without the worst kTrimmedShare of the pixels */          \
  X(double, relmse_2)       /* of means over squares of 2 x 2 pixels, and so on */       \
  X(double, relmse_4)                                                                    \
  X(double, relmse_8)                                                                    \
  X(double, raw_relmse)                                                                  \
  X(double, worst_share) /* part of raw_relmse in the worst kWorstShare of the pixels */ \
  X(double, mape)                                                                        \
  X(double, mean_r)                                                                      \
  X(double, mean_g)                                                                      \
  X(double, mean_b)                                                                      \
  X(std::uint64_t, invalid)                                                              \
  X(double, self_relmse) /* the render's own estimate and its interval */                \
  X(double, self_low)                                                                    \
  X(double, self_high)                                                                   \
  X(std::uint64_t, worst_x) /* the worst pixel of raw_relmse */                          \
  X(std::uint64_t, worst_y)

inline constexpr double kTrimmedShare = 0.01, kWorstShare = 0.001;

struct Measurement {
#define X(type, name) type name = Unknown<type>();
  LANELIGHT_MEASUREMENT(X)
#undef X
  MachineInfo machine;  // that rendered it

  bool HasSelf() const { return self_low <= self_high; }
  bool SelfHolds() const { return self_low <= relmse && relmse <= self_high; }

 private:
  template <class T>
  static constexpr T Unknown() {
    if constexpr (std::numeric_limits<T>::has_quiet_NaN) {
      return std::numeric_limits<T>::quiet_NaN();
    }
    return {};
  }
};

/// All members by name; NaN is null. The way back takes what it finds.
nlohmann::json ToJson(const Measurement& m);
Measurement MeasurementFromJson(const nlohmann::json& json);

/// Names and values of the numbers, separated by commas; NaN is empty.
std::string CsvHeader();
std::string CsvRow(const Measurement& m);

}  // namespace lanelight
