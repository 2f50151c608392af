#include "src/measure/sweep/axes.h"

#include "src/base/core/source_location.h"
#include "src/render/job/setting.h"
#include "src/vocabulary/strategy/strategy_text.h"

namespace lanelight {
namespace {

// Properties of an axis that its setting does not have. Names of cells have the value
// between `before` and `after`.
struct AxisInfo {
  const char *name, *column, *title, *before = "", *after = "", *key = name;
};

constexpr AxisInfo kAxes[kNumAxes] = {
    {"scene", "scene", "Scene"},
    {"resolution", "resolution_pixels", "Resolution (pixels)"},
    {"max-depth", "max_depth", "Maximum depth", "depth"},
    {"build", "build", "BVH build"},
    {"simd", "simd_target", "SIMD target", "", "", "target"},
    {"threads", "threads", "Threads", "", "threads"},
    {"strategy", "strategy", "Strategy"},
    {"spp", "spp", "Samples per pixel", "", "spp"},
    {"time", "time_seconds", "Time budget (s)", "", "s"},
    {"target-relmse", "target_relmse", "Target relative MSE", "relmse"},
    {"target-rmse", "target_rmse", "Target RMSE", "rmse"},
    {"seed", "seed", "Seed", "seed"},
};

const AxisInfo& Info(Axis axis) { return kAxes[std::size_t(axis)]; }

// Highway's names of SIMD targets, available or not (AvailableTargets()).
const std::vector<std::string> kTargets = {
    "AVX3_SPR", "AVX3_ZEN4", "AVX3_DL", "AVX3",        "AVX2", "SSE4", "SSSE3",
    "SSE2",     "SVE2_128",  "SVE_256", "SVE2",        "SVE",  "NEON", "NEON_WITHOUT_AES",
    "PPC10",    "PPC9",      "PPC8",    "WASM_EMU256", "WASM", "RVV",  "EMU128",
    "SCALAR"};

std::string Canonical(const std::string& name, const std::string& text) {
  const Axis axis = *SweepAxisOf(name);
  switch (axis) {
    case Axis::kScene:
      return ReadValue(TextType{"the name of a scene"}, text);
    case Axis::kTarget:  // of any machine
      return ReadValue(TargetType(kTargets), text);
    default:
      RenderSettings settings;
      SettingNamed(name).read(settings, text);
      return *SettingNamed(Name(axis)).text(settings);
  }
}

}  // namespace

const char* Name(Axis axis) { return Info(axis).name; }
const char* Key(Axis axis) { return Info(axis).key; }
const char* Column(Axis axis) { return Info(axis).column; }
const char* Title(Axis axis) { return Info(axis).title; }

ValueForm AxisFormOf(const std::string& name) {
  return SweepAxisOf(name) == Axis::kScene ? ValueForm::kText : SettingNamed(name).form;
}

std::string ValueInNames(Axis axis, const std::string& value) {
  return Info(axis).before + value + Info(axis).after;
}

std::vector<std::string> AxisNames() {
  std::vector<std::string> names;
  for (const AxisInfo& axis : kAxes) names.push_back(axis.name);
  return names;
}

std::optional<Axis> SweepAxisOf(const std::string& name) {
  for (const Axis axis : kAllAxes) {
    if (name == Name(axis)) return axis;
  }
  if (name == WrittenBy(SettingNamed(Name(Axis::kTargetRelmse)))) {
    return Axis::kTargetRelmse;
  }
  return std::nullopt;
}

std::optional<Axis> AxisOfKey(const std::string& key) {
  for (const Axis axis : kAllAxes) {
    if (key == Key(axis)) return axis;
  }
  return std::nullopt;
}

std::map<std::string, std::string> ByKey(const AxisValues& values) {
  std::map<std::string, std::string> by_key;
  for (const Axis axis : kAllAxes) {
    if (const auto& value = Get(values, axis)) by_key[Key(axis)] = *value;
  }
  return by_key;
}

std::string CanonicalValue(const std::string& name, const std::string& text,
                           const SourceLocation& where) {
  if (SweepAxisOf(name) == Axis::kStrategy) {
    StrategyNamed(text, where, {});  // throws
    return text;
  }
  return ReadAt(where, name, [&] { return Canonical(name, text); });
}

void ApplyValues(const AxisValues& values, RenderSettings& settings) {
  for (const Axis axis : kAllAxes) {
    const auto& value = Get(values, axis);
    if (!value || axis == Axis::kScene || axis == Axis::kStrategy) continue;
    if (axis == Axis::kTarget) {
      settings.target = *value;  // may be unavailable on this machine
    } else {
      SettingNamed(Name(axis)).read(settings, *value);
    }
  }
}

}  // namespace lanelight
