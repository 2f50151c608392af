// Compares two profiles of the same render, stage by stage.
#pragma once

#include <cstddef>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "src/base/stat/interval.h"

namespace lanelight {

/// The members of a profile's JSON that a comparison reads.
struct KnownProfile {
  struct Row {
    std::string name;
    bool judged = false;                // a stage or part of a task
    std::vector<double> ns_per_sample;  // processor time, of the repeats
  };
  std::string machine, program, scene_hash, target, strategy;
  int threads = 0, width = 0, height = 0;
  std::uint64_t samples = 0;
  std::vector<std::string> busy;  // BusyReasons()
  std::vector<double> ns_per_sample;
  std::vector<Row> rows;
};

KnownProfile ProfileFromJson(const nlohmann::json& json);
/// Reads the output of `lanelight profile --json`. Throws InputError.
KnownProfile ReadProfile(const std::string& path);

struct StageChange {
  std::string name;
  double before = 0, now = 0;  // medians, ns per sample
  Interval difference;         // now - before
  bool slower = false;
};

struct ProfileComparison {
  enum class Verdict { kNotSlower, kSlower, kNotComparable };

  StageChange total;                  // of all rows
  std::vector<StageChange> stages;    // by falling absolute difference
  bool same_render = true;            // else there are no stages
  std::vector<std::string> problems;  // why the profiles are not comparable

  Verdict Judge() const;
};

/// A change of a stage below this fraction of all time is not reported as slower.
inline constexpr double kMinChange = 0.01;

/// Compares processor times per sample. A stage, or the total, is slower if all of this
/// holds: Welch's t-test says so at 5 % for all of them together (Holm). Its median has
/// grown by more than the fraction `tolerance`; a stage's also by kMinChange of all time.
/// Intervals of differences: half widths of the medians' intervals add as squares.
ProfileComparison CompareProfiles(const KnownProfile& before, const KnownProfile& now,
                                  double tolerance);

/// Returns a table of at most `max_stages` differences and the verdict, in lines of at
/// most `width` columns.
std::string ComparisonText(const ProfileComparison& comparison,
                           const KnownProfile& before, double tolerance,
                           std::size_t max_stages, std::size_t width);

nlohmann::json ToJson(const ProfileComparison& comparison);

}  // namespace lanelight
