// Compares two profiles of the same render, stage by stage.
#pragma once

#include <algorithm>
#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "src/base/stat/interval.h"

namespace lanelight {

/// Reads the output of `lanelight profile --json`. Throws InputError.
nlohmann::json ReadProfile(const std::string& path);

struct StageChange {
  std::string name;
  double before = 0, now = 0;  // medians, ns per sample
  Interval difference;         // now - before
  bool slower = false;
};

struct ProfileComparison {
  /// The total, then all stages by falling absolute difference. Empty for other renders.
  std::vector<StageChange> changes;
  std::vector<std::string> problems;  // why the profiles are not comparable
  std::vector<std::string> busy;      // why other programs may have changed the times
  double detectable = 0;              // growth of the total above which it is reported

  bool IsSlower() const { return std::ranges::any_of(changes, &StageChange::slower); }
};

/// Compares processor times per sample in two outputs of `profile --json`. A stage, or
/// the total, is slower if all of this holds: Welch's t-test says so at 5 % for all of
/// them together (Holm). Its median has grown by more than the fraction `tolerance`; and
/// by 1 % of all time. If a machine was busy, earlier times count as longer by what other
/// programs can add, and the profiles are not comparable if `detectable` exceeds
/// kMaxDetectable. Intervals of differences: half widths of the medians'
/// intervals add as squares. Throws nlohmann::json::exception for other JSON.
ProfileComparison CompareProfiles(const nlohmann::json& before, const nlohmann::json& now,
                                  double tolerance);

/// Returns what was judged, and the result.
std::string VerdictText(const ProfileComparison& comparison, double tolerance);

/// Returns a table of at most `max_changes` differences and the verdict, in lines of at
/// most `width` columns.
std::string ComparisonText(const ProfileComparison& comparison, double tolerance,
                           std::size_t max_changes, std::size_t width);

}  // namespace lanelight
