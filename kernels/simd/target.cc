#include "kernels/simd/each_target-inl.h"

#include "kernels/simd/target.h"

LANELIGHT_BEGIN_KERNELS

const char* NameOfTarget() { return hwy::TargetName(HWY_TARGET); }

int LanesOfTarget() {
  return static_cast<int>(
      hwy::HWY_NAMESPACE::Lanes(hwy::HWY_NAMESPACE::ScalableTag<float>()));
}

LANELIGHT_END_KERNELS

#if HWY_ONCE

#include <fmt/format.h>

#include <fmt/ranges.h>
#include <strings.h>

#include <algorithm>

#include "src/base/core/error.h"

namespace lanelight {

HWY_EXPORT(NameOfTarget);
HWY_EXPORT(LanesOfTarget);

namespace {

// Targets that are compiled in and supported by the machine, best first.
const std::vector<std::int64_t>& UsableTargets() {
  static const std::vector<std::int64_t> targets = hwy::SupportedAndGeneratedTargets();
  return targets;
}

// A table of HWY_EXPORT has one entry if one target is compiled; else an entry that is
// not used here, one for each target that there may be, from the best one on, and the
// last for plain C++.
std::size_t TableIndexOf([[maybe_unused]] std::int64_t target) {
#if (HWY_TARGETS & (HWY_TARGETS - 1)) == 0
  return 0;
#else
  return hwy::Num0BitsBelowLS1Bit_Nonzero64(static_cast<std::uint64_t>(
      HWY_CHOSEN_TARGET_SHIFT(target) | HWY_CHOSEN_TARGET_MASK_SCALAR));
#endif
}

// Where the machine can run none, RequireTarget() has said so before anything runs.
std::int64_t BestTarget() {
  return UsableTargets().empty() ? HWY_STATIC_TARGET : UsableTargets().front();
}

std::int64_t TargetNamed(const std::string& name) {
  if (name.empty()) return BestTarget();
  for (const std::int64_t target : UsableTargets()) {
    if (strcasecmp(hwy::TargetName(target), name.c_str()) == 0) return target;
  }
  throw InputError(
      fmt::format("SIMD target '{}' is not available: {}", name, TargetProblem(name)));
}

// The targets that `./run build` compiles: "all" in cmake/targets.cmake.
constexpr std::int64_t kAllTargets = HWY_AVX3 | HWY_AVX2 | HWY_SSE4 | HWY_NEON;

// Returns the names of the targets whose bits are set.
std::vector<std::string> TargetsOf(std::int64_t targets) {
  std::vector<std::string> names;
  for (std::int64_t bits = targets; bits != 0; bits &= bits - 1) {
    names.push_back(hwy::TargetName(bits & -bits));
  }
  return names;
}

std::vector<std::string> CompiledTargets() {
  return TargetsOf(HWY_TARGETS & ~HWY_DISABLED_TARGETS);
}

}  // namespace

std::vector<std::string> AvailableTargets() {
  std::vector<std::string> names;
  for (std::int64_t target : UsableTargets()) names.push_back(hwy::TargetName(target));
  return names;
}

std::string TargetProblem(const std::string& name) {
  const auto is_named = [&name](const std::string& other) {
    return strcasecmp(other.c_str(), name.c_str()) == 0;
  };
  const std::vector<std::string> compiled = CompiledTargets();
  const std::string usable = fmt::format("{}", fmt::join(AvailableTargets(), ", "));
  if (std::ranges::any_of(compiled, is_named)) {
    return fmt::format("this machine's processor cannot run {}; it can run: {}", name,
                       usable);
  }
  if (std::ranges::any_of(TargetsOf(kAllTargets & hwy::SupportedTargets()), is_named)) {
    return fmt::format("this build has {} only; `./run build` adds the others",
                       fmt::join(compiled, ", "));
  }
  return "the SIMD targets of this machine are: " + usable;
}

void RequireTarget() {
  if (!UsableTargets().empty()) return;
  throw InputError(
      "this machine's processor runs none of the SIMD targets that this "
      "program was built for (" +
      fmt::format("{}", fmt::join(CompiledTargets(), ", ")) +
      "); built with -DLANELIGHT_TARGETS=EMU128 it runs on any");
}

SimdTarget::SimdTarget() : table_index_(TableIndexOf(BestTarget())) {}

SimdTarget::SimdTarget(const std::string& name)
    : table_index_(TableIndexOf(TargetNamed(name))) {}

std::string SimdTarget::name() const { return LANELIGHT_ON(*this, NameOfTarget)(); }

int SimdTarget::lanes() const { return LANELIGHT_ON(*this, LanesOfTarget)(); }

std::string HighwayVersion() {
  return std::to_string(HWY_MAJOR) + "." + std::to_string(HWY_MINOR) + "." +
         std::to_string(HWY_PATCH);
}

}  // namespace lanelight

#endif  // HWY_ONCE
