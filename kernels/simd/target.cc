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

#include <strings.h>

#include "src/core/error.h"

namespace lanelight {

HWY_EXPORT(NameOfTarget);
HWY_EXPORT(LanesOfTarget);

namespace {

// Targets that are compiled in and supported by the machine. Found once, before any is
// forced: what is disabled is not listed, and Highway, asked again, would dispatch to the
// best one for a moment.
const std::vector<std::int64_t>& UsableTargets() {
  static const std::vector<std::int64_t> targets = hwy::SupportedAndGeneratedTargets();
  return targets;
}

std::vector<std::string> CompiledTargets() {
  std::vector<std::string> names;
  for (std::int64_t bits = HWY_TARGETS & ~HWY_DISABLED_TARGETS; bits != 0;
       bits &= bits - 1) {
    names.push_back(hwy::TargetName(bits & -bits));
  }
  return names;
}

}  // namespace

std::vector<std::string> AvailableTargets() {
  std::vector<std::string> names;
  for (std::int64_t target : UsableTargets()) names.push_back(hwy::TargetName(target));
  return names;
}

void RequireTarget() {
  if (!UsableTargets().empty()) return;
  std::string names;
  for (const std::string& name : CompiledTargets()) {
    names += (names.empty() ? "" : ", ") + name;
  }
  throw InputError(
      "this machine's processor runs none of the SIMD targets that this "
      "program was built for (" +
      names + "); built with -DLANELIGHT_TARGETS=EMU128 it runs on any");
}

void ForceTarget(const std::string& name) {
  const auto& usable = UsableTargets();
  std::int64_t forced = 0;
  for (std::int64_t target : usable) {
    if (strcasecmp(hwy::TargetName(target), name.c_str()) == 0) forced = target;
  }
  if (forced == 0 && !name.empty()) {
    std::string legal;
    for (const std::string& t : AvailableTargets())
      legal += (legal.empty() ? "" : ", ") + t;
    throw InputError("unknown SIMD target '" + name +
                     "'; this machine can run: " + legal);
  }
  hwy::DisableTargets(forced == 0 ? 0 : ~forced);
  // Left to the first dispatch, a kernel resolved before it would choose in every call.
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

std::string CurrentTarget() { return HWY_DYNAMIC_DISPATCH(NameOfTarget)(); }

int CurrentLanes() { return HWY_DYNAMIC_DISPATCH(LanesOfTarget)(); }

std::string HighwayVersion() {
  return std::to_string(HWY_MAJOR) + "." + std::to_string(HWY_MINOR) + "." +
         std::to_string(HWY_PATCH);
}

}  // namespace lanelight

#endif  // HWY_ONCE
