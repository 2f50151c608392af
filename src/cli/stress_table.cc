#include "src/cli/texts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "src/cli/progress.h"
#include "src/measure/stress/stress_json.h"

namespace lanelight {
namespace {

using stress::BreakPlace, stress::Fault, stress::Point, stress::SuiteResult;
using stress::Case, stress::CaseResult, stress::JudgedPoint, stress::Outcome;

constexpr const char* kCaseRow =
    "{:<{}}  {:>10} {:>22} {:>6} {:>7} {:>8} {:>6}  {:<10}{}\n";

std::string Significant(double x, int digits) {
  return std::isfinite(x) ? fmt::format("{:.{}g}", x, digits) : "-";
}

// Shows as many digits as the noise leaves.
std::string Measured(const JudgedPoint& judged) {
  const Point& p = judged.point;
  if (!p.refused.empty() || !judged.crash.empty()) return "-";
  if (!(p.standard_error > 0)) return Significant(p.measured, 7);
  const double half = judged.verdict.allowance - p.tolerance;
  const double ratio = std::abs(p.measured) / half;
  const int digits = std::isfinite(ratio) ? 2 + int(std::max(0.0, std::log10(ratio))) : 3;
  return fmt::format("{:.{}g} ±{:.1g}", p.measured, std::clamp(digits, 2, 9), half);
}

std::string DeviationText(const JudgedPoint& judged) {
  if (!judged.point.refused.empty() || !judged.crash.empty()) return "-";
  const double z = judged.verdict.z;
  if (std::isinf(z)) return "inf";
  return z < 9999 ? fmt::format("{:.1f}", z) : fmt::format("{:.0e}", z);
}

std::string RaysPerSample(const CaseResult& result) {
  double rays = 0, samples = 0;
  for (const JudgedPoint& judged : result.points) {
    rays += double(judged.point.rays);
    samples += double(judged.point.samples);
  }
  return samples > 0 ? Significant(rays / samples, 3) : "-";
}

// "1e-16: refused, 1e+17: off by 3 %", the nearest to the promise on either side.
std::string Breaks(const CaseResult& result) {
  std::string text;
  for (const bool above : {false, true}) {
    const BreakPlace* nearest = nullptr;
    for (const BreakPlace& place : result.breaks) {
      if (place.above != above) continue;
      const bool nearer = !nearest || (above ? place.parameter < nearest->parameter
                                             : place.parameter > nearest->parameter);
      if (nearer) nearest = &place;
    }
    if (!nearest) continue;
    const bool is_message =
        nearest->fault == Fault::kRefused || nearest->fault == Fault::kCrashed;
    text += fmt::format("{}{:g}: {}", text.empty() ? "" : ", ", nearest->parameter,
                        is_message ? Name(nearest->fault) : nearest->why);
  }
  return text.empty() ? text : "  " + text;
}

// "weak 3/40": points of all that are promised.
std::string OutcomeText(const CaseResult& result) {
  if (result.outcome != Outcome::kWeak) return Name(result.outcome);
  return fmt::format("weak {}/{}", result.weak, result.promised);
}

std::string Row(const CaseResult& result, std::size_t width) {
  double seconds = 0;
  std::uint64_t invalid = 0;
  for (const JudgedPoint& judged : result.points) {
    seconds += judged.total_seconds;
    if (judged.promised) invalid += judged.point.invalid;
  }
  const JudgedPoint* worst =
      result.worst < 0 ? nullptr : &result.points[std::size_t(result.worst)];
  return fmt::format(fmt::runtime(kCaseRow), result.about.name, width,
                     worst ? Significant(worst->point.expected, 5) : "-",
                     worst ? Measured(*worst) : "-", worst ? DeviationText(*worst) : "-",
                     invalid, DurationText(seconds), RaysPerSample(result),
                     OutcomeText(result), Breaks(result));
}

std::string Where(const Case& about, const JudgedPoint& judged) {
  std::string text = judged.target;
  if (std::isfinite(judged.point.parameter)) {
    text += fmt::format(", {} {:g}{}{}", about.axis.name.empty() ? "at" : about.axis.name,
                        judged.point.parameter, about.axis.unit.empty() ? "" : " ",
                        about.axis.unit);
  }
  if (!judged.point.series.empty()) text += ", " + judged.point.series;
  return text;
}

// The first few points that make a case fail.
std::string Failures(const CaseResult& result) {
  constexpr int kMaxShown = 4;
  if (result.outcome != Outcome::kFailed) return "";
  if (result.promised == 0) return "    " + result.why + "\n";
  std::string text;
  int shown = 0;
  for (const JudgedPoint& judged : result.points) {
    if (!judged.promised || judged.verdict.good()) continue;
    if (++shown > kMaxShown) continue;
    text += fmt::format("    {}: {}\n", Where(result.about, judged), judged.verdict.why);
  }
  if (shown > kMaxShown)
    text += fmt::format("    and {} more points\n", shown - kMaxShown);
  return text;
}

std::size_t NameWidth(const SuiteResult& result) {
  std::size_t width = 4;
  for (const CaseResult& one : result.cases) {
    width = std::max(width, one.about.name.size());
  }
  return width;
}

std::string Summary(const SuiteResult& result) {
  int not_measured = 0;
  for (const CaseResult& one : result.cases) not_measured += one.not_measured;
  const std::string left_out =
      not_measured == 0
          ? ""
          : fmt::format("; {} points were not measured (the report gives reasons)",
                        not_measured);
  return fmt::format(
      "\n{}\n{} points in supported ranges, in {} ({} of processor time){}; false-alarm "
      "rate: 1 in {:.0f} runs\n{}\n",
      Sentence(result), result.promised, DurationText(result.seconds),
      DurationText(result.cpu_seconds), left_out, 1 / result.options.false_alarm,
      MachineText(result.machine));
}

}  // namespace

std::string StressTable(const SuiteResult& result) {
  const std::size_t width = NameWidth(result);
  std::string text =
      fmt::format(fmt::runtime(kCaseRow), "case", width, "expected", "measured", "z",
                  "invalid", "cpu", "rays", "verdict", "  first failures at");
  std::string group;
  for (const CaseResult& one : result.cases) {
    if (one.points.empty()) continue;  // not begun
    if (one.about.group != group) text += "\n" + one.about.group + "\n";
    group = one.about.group;
    text += Row(one, width) + Failures(one);
  }
  return text + Summary(result);
}

std::string StressList(const std::vector<Case>& cases) {
  std::string text, group;
  for (const Case& about : cases) {
    if (about.group != group) text += (group.empty() ? "" : "\n") + about.group + "\n";
    group = about.group;
    text += fmt::format("  {}\n      {}\n      must: {} ({})\n", about.name,
                        about.extreme, about.must, Name(about.truth));
    if (!about.source.empty()) text += fmt::format("      source: {}\n", about.source);
  }
  return text + fmt::format("\n{} case{}\n", cases.size(), cases.size() == 1 ? "" : "s");
}

}  // namespace lanelight
