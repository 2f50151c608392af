// The SIMD targets that kernels are compiled for, and how one of them is chosen.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace lanelight {

/// A SIMD target: which of its compiled forms a kernel runs in. Whatever runs kernels is
/// given one; none is in force by itself.
class SimdTarget {
 public:
  /// Chooses the best target that this machine can run.
  SimdTarget();
  /// Chooses a target by name (case-insensitive); empty: the best. Throws InputError that
  /// lists the names that this machine can run.
  explicit SimdTarget(const std::string& name);

  /// E.g. "AVX3".
  std::string name() const;
  /// 4-byte lanes of a full vector.
  int lanes() const;
  /// Returns the index in the tables of HWY_EXPORT.
  std::size_t table_index() const { return table_index_; }

  bool operator==(const SimdTarget&) const = default;

 private:
  std::size_t table_index_;
};

/// The function of that name, for which there is a HWY_EXPORT in this file, as it is
/// compiled for `target`.
#define LANELIGHT_ON(target, function) \
  (*HWY_DISPATCH_TABLE(function)[(target).table_index()])

/// Returns the targets compiled in that this machine can run, best first, e.g. {"AVX3",
/// "AVX2", ...}.
std::vector<std::string> AvailableTargets();

/// Says why a target is not available, and what to do: the program was built without it,
/// or the machine cannot run it, or there is none of that name.
std::string TargetProblem(const std::string& name);

/// Throws InputError if there is none. What kernels do then is undefined.
void RequireTarget();

/// Returns the version of the Highway headers, e.g. "1.0.3".
std::string HighwayVersion();

}  // namespace lanelight
