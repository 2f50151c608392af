#include "src/sweep/axes.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>

#include "src/core/check.h"
#include "src/core/suggest.h"
#include "src/image/image.h"
#include "src/strategy/named_strategy.h"

namespace lanelight {
namespace {

struct AxisInfo {
  const char *name, *column, *title;
  AxisType type;
};

constexpr AxisInfo kAxes[kNumAxes] = {
    {"scene", "scene", "Scene", AxisType::kText},
    {"resolution", "resolution_pixels", "Resolution (pixels)", AxisType::kText},
    {"max-depth", "max_depth", "Maximum depth", AxisType::kInteger},
    {"build", "build", "Build of the trees", AxisType::kText},
    {"target", "simd_target", "SIMD target", AxisType::kText},
    {"threads", "threads", "Threads", AxisType::kInteger},
    {"strategy", "strategy", "Strategy", AxisType::kText},
    {"spp", "spp", "Samples per pixel", AxisType::kInteger},
    {"time", "time_seconds", "Time budget (s)", AxisType::kNumber},
    {"target-relmse", "target_relmse", "Target relative MSE", AxisType::kNumber},
    {"target-rmse", "target_rmse", "Target RMSE", AxisType::kNumber},
    {"seed", "seed", "Seed", AxisType::kInteger},
};

const AxisInfo& Info(Axis axis) { return kAxes[static_cast<std::size_t>(axis)]; }

// What Highway calls the targets of processors; which of them there are is another
// question (AvailableTargets()).
const std::vector<std::string> kTargets = {
    "AVX3_SPR", "AVX3_ZEN4", "AVX3_DL", "AVX3",        "AVX2", "SSE4", "SSSE3",
    "SSE2",     "SVE2_128",  "SVE_256", "SVE2",        "SVE",  "NEON", "NEON_WITHOUT_AES",
    "PPC10",    "PPC9",      "PPC8",    "WASM_EMU256", "WASM", "RVV",  "EMU128",
    "SCALAR"};

template <class T>
std::optional<T> Parse(const std::string& text) {
  T value{};
  const char* const end = text.data() + text.size();
  const auto [next, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || next != end) return std::nullopt;
  return value;
}

[[noreturn]] void Refuse(Axis axis, const SourceLocation& where, const std::string& text,
                         const std::string& right) {
  throw InputError(where, fmt::format("{} {} is not {}", Name(axis), text, right));
}

std::string Integer(Axis axis, const std::string& text, const SourceLocation& where,
                    std::uint64_t low, std::uint64_t high) {
  const auto value = Parse<std::uint64_t>(text);
  if (!value || *value < low || *value > high) {
    Refuse(axis, where, text, fmt::format("an integer from {} to {}", low, high));
  }
  return std::to_string(*value);
}

std::string Number(Axis axis, const std::string& text, const SourceLocation& where,
                   double low, double high) {
  const auto value = Parse<double>(text);
  if (!value || !(*value >= low && *value <= high)) {
    Refuse(axis, where, text, fmt::format("a number from {} to {}", low, high));
  }
  return fmt::format("{}", *value);
}

std::array<int, 2> Sides(const std::string& text) {
  const std::size_t x = text.find('x');
  if (x == std::string::npos) return {0, 0};
  return {Parse<int>(text.substr(0, x)).value_or(0),
          Parse<int>(text.substr(x + 1)).value_or(0)};
}

std::string Resolution(const std::string& text, const SourceLocation& where) {
  const auto [width, height] = Sides(text);
  if (width < 1 || height < 1 || width > kMaxImageSide || height > kMaxImageSide) {
    Refuse(Axis::kResolution, where, Quoted(text),
           fmt::format("WIDTHxHEIGHT with sides of 1 to {} pixels, e.g. \"640x480\"",
                       kMaxImageSide));
  }
  return fmt::format("{}x{}", width, height);
}

std::string OneOf(const char* kind, std::string text, const SourceLocation& where,
                  const std::vector<std::string>& names) {
  if (std::find(names.begin(), names.end(), text) == names.end()) {
    ThrowUnknown(where, kind, text, names);
  }
  return text;
}

std::string UpperCase(std::string text) {
  for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return text;
}

std::string StrategyText(const std::string& text, const SourceLocation& where) {
  StrategyNamed(text, where, {});  // throws
  return text;
}

std::string Scene(const std::string& text, const SourceLocation& where) {
  if (text.empty()) throw InputError(where, "the name of a scene is empty");
  return text;
}

}  // namespace

const char* Name(Axis axis) { return Info(axis).name; }
const char* Column(Axis axis) { return Info(axis).column; }
const char* Title(Axis axis) { return Info(axis).title; }
AxisType TypeOf(Axis axis) { return Info(axis).type; }

std::vector<std::string> AxisNames() {
  std::vector<std::string> names;
  for (const AxisInfo& axis : kAxes) names.push_back(axis.name);
  return names;
}

std::optional<Axis> SweepAxisOf(const std::string& name) {
  for (int i = 0; i < kNumAxes; ++i) {
    if (name == kAxes[i].name) return static_cast<Axis>(i);
  }
  return std::nullopt;
}

std::string CanonicalValue(Axis axis, const std::string& text,
                           const SourceLocation& where) {
  switch (axis) {
    case Axis::kScene:
      return Scene(text, where);
    case Axis::kResolution:
      return Resolution(text, where);
    case Axis::kMaxDepth:
      return Integer(axis, text, where, 0, kMaxDepth);
    case Axis::kBuild:
      return OneOf("build", text, where, {"fast", "high"});
    case Axis::kTarget:
      return OneOf("SIMD target", UpperCase(text), where, kTargets);
    case Axis::kThreads:
      return Integer(axis, text, where, 0, 1024);
    case Axis::kStrategy:
      return StrategyText(text, where);
    case Axis::kSpp:
      return Integer(axis, text, where, 1, kMaxSpp);
    case Axis::kTime:
      return Number(axis, text, where, 1e-3, 1e9);
    case Axis::kTargetRelmse:
    case Axis::kTargetRmse:
      return Number(axis, text, where, 1e-12, 1e12);
    case Axis::kSeed:
      return Integer(axis, text, where, 0, std::uint64_t(INT64_MAX));
    case Axis::kCount:
      break;
  }
  LL_CHECK(false);
  return "";
}

void ApplyValues(const AxisValues& values, RenderSettings& settings) {
  if (const auto& v = Get(values, Axis::kResolution)) settings.resolution = Sides(*v);
  if (const auto& v = Get(values, Axis::kMaxDepth)) settings.max_depth = Parse<int>(*v);
  if (const auto& v = Get(values, Axis::kBuild)) {
    settings.build = *v == "fast" ? BuildQuality::kFast : BuildQuality::kHigh;
  }
  if (const auto& v = Get(values, Axis::kSpp)) settings.spp = Parse<std::uint64_t>(*v);
  if (const auto& v = Get(values, Axis::kTime)) settings.seconds = Parse<double>(*v);
  if (const auto& v = Get(values, Axis::kTargetRelmse)) {
    settings.target_relmse = Parse<double>(*v);
  }
  if (const auto& v = Get(values, Axis::kTargetRmse)) {
    settings.target_rmse = Parse<double>(*v);
  }
  if (const auto& v = Get(values, Axis::kSeed)) settings.seed = Parse<std::uint64_t>(*v);
}

}  // namespace lanelight
