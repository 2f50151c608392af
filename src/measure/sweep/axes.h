// The axes of a sweep's grid, in the order in which cells are counted: what changes
// slowest, and costs most to change, comes first.
#pragma once

#include <array>
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

/// What the sweep file writes in front of an axis' values, e.g. "max-depth": the flag of
/// `lanelight render` without its dashes.
const char* Name(Axis axis);
/// In JSON.
const char* Key(Axis axis);
/// The axis of that key, if there is one.
std::optional<Axis> AxisOfKey(const std::string& key);
/// The header of its column in sweep.csv, with its unit, e.g. "time_seconds".
const char* Column(Axis axis);
/// Its heading on the page, e.g. "Samples per pixel".
const char* Title(Axis axis);
/// All names, in order.
std::vector<std::string> AxisNames();
/// The axis of that name, if there is one; "target" writes target-relmse in percent, as
/// the flag does.
std::optional<Axis> SweepAxisOf(const std::string& name);

/// What values are in a TOML file, of the axis of that name.
ValueForm AxisFormOf(const std::string& name);
/// A value as it stands in the names of cells: "16spp".
std::string ValueInNames(Axis axis, const std::string& value);

/// One text per axis; empty: the scene, or the program, decides.
using AxisValues = std::array<std::optional<std::string>, kNumAxes>;

inline const std::optional<std::string>& Get(const AxisValues& values, Axis axis) {
  return values[static_cast<std::size_t>(axis)];
}

/// The one text by which equal values are known: "08" is "8", "avx2" is "AVX2". Throws
/// InputError at `where` for what `lanelight render` would not take either. `name`: of
/// SweepAxisOf.
std::string CanonicalValue(const std::string& name, const std::string& text,
                           const SourceLocation& where);

/// Puts these values into the settings of a render. The scene and the strategy are not
/// among them.
void ApplyValues(const AxisValues& values, RenderSettings& settings);

}  // namespace lanelight
