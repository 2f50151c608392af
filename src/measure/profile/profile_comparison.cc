#include "src/measure/profile/profile_comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "src/base/core/error.h"
#include "src/base/core/input_file.h"
#include "src/base/core/json_text.h"
#include "src/base/core/text_layout.h"
#include "src/base/stat/hypothesis.h"
#include "src/base/stat/values.h"
#include "src/render/job/profile_report.h"
#include "src/vocabulary/strategy/strategy_text.h"

namespace lanelight {
namespace {

using Json = nlohmann::json;

constexpr double kFalseAlarms = 0.05;  // of all rows together

stat::MeanEstimate MeanOf(const std::vector<double>& values) {
  const auto n = double(values.size());
  stat::MeanEstimate out{stat::Mean(values), 0, n - 1};
  for (const double v : values) {
    out.variance += (v - out.mean) * (v - out.mean) / (n * (n - 1));
  }
  return out;
}

struct TestedChange {
  StageChange change;
  bool judged = false;
  double p = 1;
};

TestedChange ChangeOf(const std::string& name, bool judged,
                      const std::vector<double>& before, const std::vector<double>& now) {
  const Interval a = MedianOf(before), b = MedianOf(now);
  const double value = b.value - a.value;
  TestedChange tested{{name,
                       a.value,
                       b.value,
                       {value, value - std::hypot(b.value - b.low, a.high - a.value),
                        value + std::hypot(b.high - b.value, a.value - a.low)}},
                      judged};
  if (judged && before.size() > 1 && now.size() > 1) {
    tested.p = stat::WelchPValue(MeanOf(before), MeanOf(now));
  }
  return tested;
}

// Values of a row; zeros where the profile lacks it.
std::vector<double> ValuesOf(const KnownProfile& profile, const std::string& name) {
  const auto row = std::ranges::find(profile.rows, name, &KnownProfile::Row::name);
  if (row != profile.rows.end()) return row->ns_per_sample;
  return std::vector<double>(profile.ns_per_sample.size());
}

std::vector<TestedChange> Changes(const KnownProfile& before, const KnownProfile& now) {
  std::vector<TestedChange> changes = {
      ChangeOf("total", true, before.ns_per_sample, now.ns_per_sample)};
  for (const KnownProfile::Row& row : now.rows) {
    changes.push_back(
        ChangeOf(row.name, row.judged, ValuesOf(before, row.name), row.ns_per_sample));
  }
  for (const KnownProfile::Row& row : before.rows) {
    if (std::ranges::find(now.rows, row.name, &KnownProfile::Row::name) ==
        now.rows.end()) {
      changes.push_back(
          ChangeOf(row.name, false, row.ns_per_sample, ValuesOf(now, row.name)));
    }
  }
  return changes;
}

void FindRenderProblems(const KnownProfile& before, const KnownProfile& now,
                        ProfileComparison& comparison) {
  const auto check = [&](const char* what, const auto& a, const auto& b) {
    if (a == b) return;
    comparison.problems.push_back(fmt::format("{} is {}, before {}", what, b, a));
  };
  if (before.scene_hash != now.scene_hash) {
    comparison.problems.push_back("the scene files differ");
  }
  check("the SIMD target", before.target, now.target);
  if (before.strategy != now.strategy) {
    check("the strategy", ChoicesNotIn(now.strategy, before.strategy),
          ChoicesNotIn(before.strategy, now.strategy));
  }
  check("the number of threads", before.threads, now.threads);
  check("the resolution", fmt::format("{}x{}", before.width, before.height),
        fmt::format("{}x{}", now.width, now.height));
  check("the number of samples", before.samples, now.samples);
  comparison.same_render = comparison.problems.empty();
}

void FindRunProblems(const KnownProfile& profile, const char* when,
                     ProfileComparison& comparison) {
  for (const std::string& reason : profile.busy) {
    comparison.problems.push_back(fmt::format("{}: {}", when, reason));
  }
  const std::size_t repeats = profile.ns_per_sample.size();
  if (repeats < std::size_t(kProfileRepeats)) {
    comparison.problems.push_back(
        fmt::format("{}: intervals need {} repeats, not {} (--repeat {})", when,
                    kProfileRepeats, repeats, kProfileRepeats));
  }
}

std::string Signed(const Interval& v) {
  if (!v.HasBounds()) return fmt::format("{:+.3g}", v.value);
  return fmt::format("{:+.3g} [{:+.3g}, {:+.3g}]", v.value, v.low, v.high);
}

std::string GrowthText(const StageChange& change) {
  return change.before > 0
             ? fmt::format("{:+.1f}%", 100 * (change.now / change.before - 1))
             : "new";
}

std::string VerdictText(const ProfileComparison& comparison, double tolerance) {
  std::vector<std::string> slower;
  for (const StageChange& stage : comparison.stages) {
    if (stage.slower) slower.push_back(stage.name + " " + GrowthText(stage));
  }
  if (comparison.total.slower) {
    slower.push_back("total " + GrowthText(comparison.total));
  }
  switch (comparison.Judge()) {
    case ProfileComparison::Verdict::kNotComparable:
      return fmt::format("not comparable; {}.", fmt::join(comparison.problems, "; "));
    case ProfileComparison::Verdict::kSlower:
      return fmt::format("slower: {}.", fmt::join(slower, ", "));
    case ProfileComparison::Verdict::kNotSlower:
      break;
  }
  return fmt::format("no stage is significantly slower by more than {:.3g} %.",
                     100 * tolerance);
}

Json ChangeJson(const StageChange& change) {
  return {{"name", change.name},
          {"before", change.before},
          {"now", change.now},
          {"difference", IntervalJson(change.difference)},
          {"slower", change.slower}};
}

}  // namespace

ProfileComparison::Verdict ProfileComparison::Judge() const {
  if (!problems.empty()) return Verdict::kNotComparable;
  const bool slower = total.slower || std::ranges::any_of(stages, &StageChange::slower);
  return slower ? Verdict::kSlower : Verdict::kNotSlower;
}

ProfileComparison CompareProfiles(const KnownProfile& before, const KnownProfile& now,
                                  double tolerance) {
  ProfileComparison comparison;
  FindRenderProblems(before, now, comparison);
  FindRunProblems(before, "earlier run", comparison);
  FindRunProblems(now, "this run", comparison);
  if (!comparison.same_render) return comparison;
  std::vector<TestedChange> changes = Changes(before, now);
  std::vector<double> p;
  for (const TestedChange& tested : changes) {
    if (tested.judged) p.push_back(tested.p);
  }
  const auto rejected = stat::HolmRejections(p, kFalseAlarms);
  const double least = kMinChange * changes[0].change.before;
  std::size_t test = 0;
  for (TestedChange& tested : changes) {
    if (!tested.judged) continue;
    const bool significant = std::ranges::binary_search(rejected, test++);
    StageChange& change = tested.change;
    change.slower = significant && change.difference.value > least &&
                    change.difference.value > tolerance * change.before;
  }
  comparison.total = changes[0].change;
  for (std::size_t i = 1; i < changes.size(); ++i) {
    comparison.stages.push_back(changes[i].change);
  }
  std::ranges::sort(comparison.stages, [](const StageChange& a, const StageChange& b) {
    const double x = std::abs(a.difference.value), y = std::abs(b.difference.value);
    return x != y ? x > y : a.name < b.name;
  });
  return comparison;
}

KnownProfile ProfileFromJson(const Json& json) {
  KnownProfile known{json.at("machine").at("text"),
                     json.at("program"),
                     json.at("scene_hash"),
                     json.at("target").at("name"),
                     json.at("strategy_in_force"),
                     json.at("threads"),
                     json.at("resolution").at(0),
                     json.at("resolution").at(1),
                     json.at("samples"),
                     json.at("busy"),
                     json.at("ns_per_sample_of_repeats"),
                     {}};
  for (const Json& row : json.at("rows")) {
    const std::string kind = row.at("kind");
    known.rows.push_back({row.at("name"), kind == "stage" || kind == "task",
                          row.at("ns_per_sample_of_repeats")});
  }
  return known;
}

KnownProfile ReadProfile(const std::string& path) {
  return FromJsonOf(path, [&] {
    const Json json = ParseJson(ReadWholeFile(path));
    if (!json.contains("kind") || json.at("kind") != "profile") {
      throw InputError("'{}' was not written by `lanelight profile --json`", path);
    }
    if (!json.contains("repeats")) {
      throw InputError(
          "'{}' was written by an older version, without repeats; measure again with "
          "`lanelight profile --repeat {} --json`",
          path, kProfileRepeats);
    }
    return ProfileFromJson(json);
  });
}

std::string ComparisonText(const ProfileComparison& comparison,
                           const KnownProfile& before, double tolerance,
                           std::size_t max_stages, std::size_t width) {
  std::string text = LabelledRow("against", before.machine, width) +
                     LabelledRow("", before.program, width) + "\n";
  if (comparison.same_render) {
    std::vector<std::vector<std::string>> lines = {
        {"ns per sample", "before", "now", "difference", "change", ""}};
    const auto add = [&](const StageChange& c) {
      lines.push_back({c.name, fmt::format("{:.3g}", c.before),
                       fmt::format("{:.3g}", c.now), Signed(c.difference), GrowthText(c),
                       c.slower ? "SLOWER" : ""});
    };
    add(comparison.total);
    for (const StageChange& stage : comparison.stages) {
      if (lines.size() < max_stages + 2 || stage.slower) add(stage);
    }
    text += TextTable(lines, {width, 1, 1}) + "\n";
  }
  return text + Wrapped(VerdictText(comparison, tolerance), width) + "\n";
}

Json ToJson(const ProfileComparison& comparison) {
  static constexpr const char* kVerdicts[] = {"not slower", "slower", "not comparable"};
  Json stages = Json::array();
  for (const StageChange& stage : comparison.stages) stages.push_back(ChangeJson(stage));
  return {
      {"verdict", kVerdicts[int(comparison.Judge())]},
      {"problems", comparison.problems},
      {"total", comparison.same_render ? ChangeJson(comparison.total) : Json(nullptr)},
      {"stages", stages}};
}

}  // namespace lanelight
