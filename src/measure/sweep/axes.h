// The axes of a sweep's grid in the order of cells. Axes that cost most to change come
// first and change slowest.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "src/base/core/error.h"
#include "src/render/job/setting.h"

namespace lanelight {

enum class Axis {
  kScene,
  kResolution,
  kMaxDepth,
  kBuild,
  kTarget,
  kThreads,
  kStrategy,
  kSpp,
  kTime,
  kTargetRelmse,
  kTargetRmse,
  kSeed,
  kCount
};
inline constexpr int kNumAxes = static_cast<int>(Axis::kCount);
inline constexpr std::array<Axis, kNumAxes> kAllAxes = [] {
  std::array<Axis, kNumAxes> axes = {};
  for (int i = 0; i < kNumAxes; ++i) axes[i] = static_cast<Axis>(i);
  return axes;
}();

/// Returns the key of an axis in a sweep file, e.g. "max-depth": the flag of
/// `lanelight render` without its dashes.
const char* Name(Axis axis);
/// Returns the key in JSON.
const char* Key(Axis axis);
/// Returns the axis with that key.
std::optional<Axis> AxisOfKey(const std::string& key);
/// Returns the header of its column in sweep.csv with the unit, e.g. "time_seconds".
const char* Column(Axis axis);
/// Returns its heading on the page, e.g. "Samples per pixel".
const char* Title(Axis axis);
/// Returns all names in order.
std::vector<std::string> AxisNames();
/// Returns the axis with that name. "target" is target-relmse in percent, like the flag.
std::optional<Axis> SweepAxisOf(const std::string& name);

/// Returns the TOML type of values of the axis with that name.
ValueForm AxisFormOf(const std::string& name);
/// Returns a value as in names of cells: "16spp".
std::string ValueInNames(Axis axis, const std::string& value);

/// One text per axis; empty: the value of the scene, or the default.
using AxisValues = std::array<std::optional<std::string>, kNumAxes>;

inline const std::optional<std::string>& Get(const AxisValues& values, Axis axis) {
  return values[static_cast<std::size_t>(axis)];
}

/// Returns the canonical text of a value: "8" for "08", "AVX2" for "avx2". Throws
/// InputError at `where` for values that `lanelight render` refuses. `name`: as for
/// SweepAxisOf().
std::string CanonicalValue(const std::string& name, const std::string& text,
                           const SourceLocation& where);

/// Returns the values that are set, by Key().
std::map<std::string, std::string> ByKey(const AxisValues& values);

/// Sets all values but scene and strategy in the settings of a render.
void ApplyValues(const AxisValues& values, RenderSettings& settings);

}  // namespace lanelight
