#include "src/cli/error_words.h"

#include <fmt/format.h>

#include <cmath>

namespace lanelight {
namespace {

constexpr const char* kBlack = "unknown: every sample is black";
constexpr const char* kUnknown = "unknown: needs two samples per pixel, or two pairs";

// Three digits, and no more zeros than these.
std::string Percent(double relative_mse) {
  const double percent = 100 * std::sqrt(relative_mse);
  return percent < 99.95 && percent >= 0.0001 ? fmt::format("{:#.3g}", percent)
                                              : fmt::format("{:.3g}", percent);
}

std::string IntervalText(const Interval& v) {
  if (!v.HasBounds())
    return fmt::format("at least {:.4g} (estimate {:.4g})", v.low, v.value);
  return fmt::format("{:.4g} [{:.4g}, {:.4g}]", v.value, v.low, v.high);
}

std::string WithReason(std::string text, const ErrorEstimate& e) {
  if (!e.why.empty()) text += "; how large it may be cannot be told: " + e.why;
  return text;
}

}  // namespace

std::string PercentOf(double relative_mse) { return Percent(relative_mse) + " %"; }

std::string PercentText(const ErrorEstimate& e) {
  if (!e.available) return e.why.empty() ? kUnknown : "unknown: " + e.why;
  if (e.why == kNoLight) return kBlack;
  const Interval& v = e.relmse;
  if (v.HasBounds()) {
    return fmt::format("{} [{}, {}]", PercentOf(v.value), Percent(v.low),
                       Percent(v.high));
  }
  return WithReason(
      fmt::format("at least {} (estimate {})", PercentOf(v.low), PercentOf(v.value)), e);
}

std::string BriefPercentText(const ErrorEstimate& e) {
  if (!e.available || e.why == kNoLight) return "unknown";
  return e.relmse.HasBounds() ? PercentText(e) : "at least " + PercentOf(e.relmse.low);
}

std::string ErrorText(const ErrorEstimate& e) {
  if (!e.available) return e.why.empty() ? kUnknown : "unknown: " + e.why;
  if (e.why == kNoLight) return kBlack;
  return WithReason(fmt::format("RMSE {}, relative MSE {} (95 % confidence)",
                                IntervalText(e.rmse), IntervalText(e.relmse)),
                    e);
}

}  // namespace lanelight
