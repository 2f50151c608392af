#include "src/measure/profile/profile_comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "src/base/core/error.h"
#include "src/base/core/input_file.h"
#include "src/base/core/json_text.h"
#include "src/base/core/machine_info.h"
#include "src/base/core/text_layout.h"
#include "src/base/stat/hypothesis.h"
#include "src/base/stat/values.h"
#include "src/render/job/profile_report.h"
#include "src/vocabulary/strategy/strategy_text.h"

namespace lanelight {
namespace {

using Json = nlohmann::json;

constexpr double kFalseAlarms = 0.05;  // of all stages together
constexpr double kMinChange = 0.01;    // of all time
constexpr const char* kRepeats = "ns_per_sample_of_repeats";

stat::MeanEstimate MeanOf(const std::vector<double>& values) {
  const auto n = double(values.size());
  stat::MeanEstimate out{stat::Mean(values), 0, n - 1};
  for (const double v : values) {
    out.variance += (v - out.mean) * (v - out.mean) / (n * (n - 1));
  }
  return out;
}

// Returns the change between two medians; half widths add as squares.
StageChange ChangeOf(const std::string& name, const std::vector<double>& before,
                     const std::vector<double>& now) {
  const Interval a = MedianOf(before), b = MedianOf(now);
  const double value = b.value - a.value;
  return {name,
          a.value,
          b.value,
          {value, value - std::hypot(b.value - b.low, a.high - a.value),
           value + std::hypot(b.high - b.value, a.value - a.low)}};
}

// Returns whether both are of the same render.
bool FindProblems(const Json& before, const Json& now, ProfileComparison& comparison) {
  std::vector<std::string>& out = comparison.problems;
  const std::string strategy = now.at("strategy_in_force");
  const std::string old_strategy = before.at("strategy_in_force");
  const auto check = [&](const char* what, const Json& a, const Json& b) {
    if (a != b)
      out.push_back(fmt::format("{}: {}, before {}", what, DumpJson(b), DumpJson(a)));
  };
  check("other scene files", before.at("scene_hash"), now.at("scene_hash"));
  check("SIMD target", before.at("target").at("name"), now.at("target").at("name"));
  check("strategy", ChoicesNotIn(strategy, old_strategy),
        ChoicesNotIn(old_strategy, strategy));
  for (const char* member : {"threads", "resolution", "samples"}) {
    check(member, before.at(member), now.at(member));
  }
  const bool same = out.empty();
  for (const Json* profile : {&before, &now}) {
    const char* when = profile == &now ? "this run" : "earlier run";
    for (const std::string reason : profile->at("busy")) {
      comparison.busy.push_back(fmt::format("{}: {}", when, reason));
    }
    if (const auto repeats = int(profile->at(kRepeats).size());
        repeats < kProfileRepeats) {
      out.push_back(fmt::format("{}: {} repeats, intervals need {} (--repeat {})", when,
                                repeats, kProfileRepeats, kProfileRepeats));
    }
  }
  return same;
}

std::string GrowthText(const StageChange& change) {
  if (!(change.before > 0)) return "new";
  return fmt::format("{:+.1f}%", 100 * (change.now / change.before - 1));
}

// Returns the growth of the total, or of a stage, that other programs explain.
double MarginOf(const ProfileComparison& comparison, bool total) {
  if (comparison.busy.empty()) return 0;
  return total ? kBusySlowdown : kBusyStageSlowdown;
}

}  // namespace

std::string VerdictText(const ProfileComparison& comparison, double tolerance) {
  if (!comparison.problems.empty()) {
    return fmt::format("not comparable; {}.", fmt::join(comparison.problems, "; "));
  }
  std::string judged = ".", slower;
  if (!comparison.busy.empty()) {
    judged = fmt::format(
        ". Judged by processor time, to which other programs can add {:.0f} % (one "
        "stage: {:.0f} %), since the machine was busy ({}).",
        100 * kBusySlowdown, 100 * kBusyStageSlowdown, fmt::join(comparison.busy, "; "));
  }
  for (const StageChange& change : comparison.changes) {
    if (!change.slower) continue;
    slower +=
        (slower.empty() ? "slower: " : ", ") + change.name + " " + GrowthText(change);
  }
  if (!slower.empty()) return slower + judged;
  const auto limit = [&](bool total) {
    return 100 * (MarginOf(comparison, total) + tolerance);
  };
  return fmt::format(
      "the total is not slower by more than {:.3g} %, and no stage by more than {:.3g} "
      "%{}",
      limit(true), limit(false), judged);
}

ProfileComparison CompareProfiles(const Json& before, const Json& now, double tolerance) {
  ProfileComparison comparison;
  if (!FindProblems(before, now, comparison)) return comparison;
  // A stage has no time in a profile that lacks it.
  std::map<std::string, std::array<std::vector<double>, 2>> stages;
  const std::array profiles = {&before, &now};
  for (const std::size_t i : {0, 1}) {
    for (const Json& row : profiles[i]->at("rows")) {
      if (row.at("kind") != "stage" && row.at("kind") != "task") continue;
      stages[row.at("name")][i] = row.at(kRepeats).get<std::vector<double>>();
    }
  }
  std::vector<StageChange>& changes = comparison.changes;
  std::vector<double> p;
  const auto add = [&](const std::string& name, std::array<std::vector<double>, 2> ns) {
    for (const std::size_t i : {0, 1}) ns[i].resize(profiles[i]->at(kRepeats).size());
    changes.push_back(ChangeOf(name, ns[0], ns[1]));
    for (double& x : ns[0]) x *= 1 + MarginOf(comparison, p.empty());
    p.push_back(stat::WelchPValue(MeanOf(ns[0]), MeanOf(ns[1])));
  };
  add("total", {before.at(kRepeats).get<std::vector<double>>(),
                now.at(kRepeats).get<std::vector<double>>()});
  for (const auto& [name, ns] : stages) add(name, ns);
  const StageChange& total = changes[0];
  comparison.detectable =
      MarginOf(comparison, true) +
      std::max(tolerance,
               (total.difference.high - total.difference.value) / total.before);
  if (!comparison.busy.empty() && comparison.detectable > kMaxDetectable) {
    comparison.problems.push_back(
        fmt::format("{}; only a total longer by more than {:.0f} % could have been found",
                    fmt::join(comparison.busy, "; "), 100 * comparison.detectable));
  }
  if (!comparison.problems.empty()) p.clear();  // nothing is judged
  for (const std::size_t i : stat::HolmRejections(p, kFalseAlarms)) {
    StageChange& c = changes[i];
    c.slower = c.difference.value - MarginOf(comparison, i == 0) * c.before >
               std::max(kMinChange * total.before, tolerance * c.before);
  }
  std::sort(changes.begin() + 1, changes.end(), [](const auto& a, const auto& b) {
    return std::abs(a.difference.value) > std::abs(b.difference.value);
  });
  return comparison;
}

Json ReadProfile(const std::string& path) {
  return FromJsonOf(path, [&] {
    Json json = ParseJson(ReadWholeFile(path));
    if (json.contains("bounces") && json.contains(kRepeats)) return json;
    throw InputError("'{}' was not written by `lanelight profile --json` of this version",
                     path);
  });
}

std::string ComparisonText(const ProfileComparison& comparison, double tolerance,
                           std::size_t max_changes, std::size_t width) {
  std::vector<std::vector<std::string>> lines = {
      {"ns per sample", "before", "now", "difference", "change", ""}};
  for (const StageChange& c : comparison.changes) {
    if (lines.size() > max_changes && !c.slower) continue;
    lines.push_back({c.name, fmt::format("{:.3g}", c.before),
                     fmt::format("{:.3g}", c.now), EstimateText(c.difference),
                     GrowthText(c), c.slower ? "SLOWER" : ""});
  }
  return (lines.size() > 1 ? TextTable(lines, {width, 1, 1}) + "\n" : "") +
         Wrapped(VerdictText(comparison, tolerance), width) + "\n";
}

}  // namespace lanelight
